#pragma once

#include <cstring>
#include <functional>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <tuple>
#include <vector>

#include "fluid/solver.hpp"

namespace sluice::testing {

// What a FakeSolver was asked, and how it shall misbehave.
struct SolverScript {
  double largest_step = 1e-3;  // [s]
  // Called at the end of every step with its number and the state.
  std::function<void(std::uint64_t, fluid::Snapshot&)> spoil;
  std::vector<fluid::Kinematics> started;
  std::vector<std::vector<fluid::Kinematics>> stepped;
};

// Particles in free fall. The wrench on body b after step n is (n, b, 1) N and (0, 0, n) N m; at time 0, n =
// 0.
class FakeSolver : public fluid::Solver {
 public:
  FakeSolver(const fluid::Setup& setup, SolverScript& script) : setup_(setup), script_(script) {
    for (const Eigen::Vector3d& x : setup.fluid.position)
      state_.position.insert(state_.position.end(), x.begin(), x.end());
    for (const Eigen::Vector3d& v : setup.fluid.velocity)
      state_.velocity.insert(state_.velocity.end(), v.begin(), v.end());
    state_.density.assign(setup.fluid.position.size(), setup.liquid.density);
    state_.pressure = setup.fluid.pressure;
    state_.id.resize(setup.fluid.position.size());
    std::iota(state_.id.begin(), state_.id.end(), 0u);
  }

  void start(std::span<const fluid::Kinematics> bodies) override {
    script_.started.assign(bodies.begin(), bodies.end());
    push();
  }

  void step(double dt, std::span<const fluid::Kinematics> bodies) override {
    ++steps_;
    script_.stepped.emplace_back(bodies.begin(), bodies.end());
    for (std::size_t i = 0; i < state_.position.size(); ++i) {
      state_.velocity[i] += dt * setup_.gravity[static_cast<Eigen::Index>(i % 3)];
      state_.position[i] += dt * state_.velocity[i];
    }
    if (script_.spoil) script_.spoil(steps_, state_);
    push();
  }

  void save() override { saved_ = {steps_, state_, wrenches_}; }
  void restore() override { std::tie(steps_, state_, wrenches_) = saved_; }

  // The step alone: whoever asks looks at what is done with it.
  void write_state(std::vector<std::byte>& bytes) override {
    bytes.resize(sizeof steps_);
    std::memcpy(bytes.data(), &steps_, sizeof steps_);
  }
  void read_state(std::span<const std::byte> bytes) override {
    if (bytes.size() != sizeof steps_) throw std::invalid_argument("state: 8 bytes are needed");
    std::memcpy(&steps_, bytes.data(), sizeof steps_);
    push();
  }

  [[nodiscard]] std::span<const fluid::Wrench> wrenches() const override { return wrenches_; }
  [[nodiscard]] std::vector<fluid::WrenchParts> wrench_parts() const override {
    std::vector<fluid::WrenchParts> parts;
    for (const fluid::Wrench& wrench : wrenches_)
      parts.push_back({.pressure = wrench, .viscous = {}, .guard = {}});
    return parts;
  }
  [[nodiscard]] fluid::Wrench wall_wrench() const override { return {}; }
  [[nodiscard]] double largest_step(double) const override { return script_.largest_step; }
  [[nodiscard]] fluid::Snapshot snapshot() const override { return state_; }
  [[nodiscard]] fluid::StageTimes stage_times() const override { return {}; }
  [[nodiscard]] fluid::Diagnostics diagnostics() const override {
    fluid::Diagnostics diagnostics;
    diagnostics.kinetic = static_cast<double>(steps_);
    return diagnostics;
  }

 private:
  void push() {
    wrenches_.clear();
    const auto n = static_cast<double>(steps_);
    for (std::size_t b = 0; b < setup_.bodies.size(); ++b) {
      wrenches_.push_back({{n, static_cast<double>(b), 1}, {0, 0, n}});
    }
  }

  fluid::Setup setup_;
  SolverScript& script_;
  std::uint64_t steps_ = 0;
  fluid::Snapshot state_;
  std::vector<fluid::Wrench> wrenches_;
  std::tuple<std::uint64_t, fluid::Snapshot, std::vector<fluid::Wrench>> saved_;
};

}  // namespace sluice::testing
