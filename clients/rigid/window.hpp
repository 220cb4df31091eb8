#pragma once

#include <span>
#include <vector>

#include "clients/rigid/aitken.hpp"
#include "rigid/world.hpp"
#include "scene.pb.h"

namespace sluice::clients {

// An exchange from the bodies' side: the fluid steps between two answers of the fluid, with the bodies'
// motion at every one of them (README.md, "Exchange"). After begin: predict, send, accept the answer; again
// as long as accept says that the answer does not agree with the guess.
//
// Bodies integrate every fluid step, under a guess of the wrenches to come; what the answer's impulse has
// more than the guess's is given to them at the end, so that momentum closes whatever the guess was.
//
//   explicit   F_k, for k > 0, the last answer, extrapolated
//   implicit   F_k iterated, and a body moves in step k under (F_{k-1} + F_k)/2, which makes it answer within
//              the step
class Window {
 public:
  // A fluid step: when it ends and how long it is [s].
  struct Step {
    double end, length;
  };
  using Wrenches = std::vector<rigid::Wrench>;    // per body
  using Motion = std::vector<rigid::Kinematics>;  // per body

  // `indicators` of the bodies, see BodyStability, for the first guess of the relaxation; gravity [m/s^2].
  // `initial` is the fluid's action at time 0.
  Window(rigid::World& world, const Coupling& coupling, const Eigen::Vector3d& gravity,
         std::span<const double> indicators, Wrenches initial);

  void begin(std::vector<Step> steps);
  // The bodies over every step, with the present guess.
  std::vector<Motion> predict();
  // The fluid's action at the end of every step. True when the exchange is done and the bodies have what the
  // fluid gave; false when it is to be predicted again.
  bool accept(const std::vector<Wrenches>& answer);

  // Between two exchanges: the bodies' state and what the next exchange takes from this one, as numbers; and
  // back, for bodies whose `initial` wrenches were those of that time. read_state throws
  // std::invalid_argument when the numbers are not those of such bodies.
  [[nodiscard]] std::vector<double> write_state();
  void read_state(std::span<const double> row);

  [[nodiscard]] int iterations() const { return iterations_; }
  [[nodiscard]] double residual() const { return residual_; }

 private:
  [[nodiscard]] rigid::Wrench mean_guess(std::size_t step, std::size_t body) const;
  [[nodiscard]] rigid::Wrench missing_impulse(const std::vector<Wrenches>& answer, std::size_t body) const;
  [[nodiscard]] double relative(const rigid::Wrench& missing, std::size_t body) const;
  void finish(const std::vector<Wrenches>& answer, const Wrenches& missing);
  void relax(const std::vector<Wrenches>& answer);

  rigid::World& world_;
  bool is_implicit_;
  double tolerance_;
  int most_iterations_;
  Eigen::Vector3d gravity_;
  std::vector<Aitken> aitken_;  // per body
  std::vector<Step> steps_;
  std::vector<Wrenches> guess_;      // at the end of every step; entry 0 is known: that of the last exchange
  std::vector<Wrenches> residuals_;  // answer less guess, of the last iteration; empty at the first
  Wrenches mean_;                    // of the last answer
  int iterations_ = 0;
  double residual_ = 0;
};

}  // namespace sluice::clients
