#pragma once

#include <functional>

#include "tests/unit/fluid/setups.hpp"

namespace sluice::fluid {

// A block of water thrown into the corner of a tank, at a thick box and a thin plate that move and turn:
// everything that exerts a force takes part within a few dozen steps.
class Splash {
 public:
  using Choice = std::function<void(Formulation&)>;

  Splash(
      int dimension, double viscosity, int threads, const Choice& choose = [](Formulation&) {})
      : scene_(dimension, 0.1, 9.81, 30.0) {
    Setup& setup = scene_.setup;
    choose(setup.formulation);
    setup.liquid.viscosity = viscosity;
    setup.measure_wall_force = true;
    setup.threads = threads;
    // Boundary forces have no thin plates.
    const double half = setup.formulation.boundary == BoundaryTreatment::forces ? 0.16 : 0.05;
    // Spacings are 0.1; the tank is two metres wide, in space one metre deep.
    scene_.add_tank({0, 0, 0}, dimension == 2 ? Eigen::Vector3d(2, 2, 0) : Eigen::Vector3d(2, 1, 2));
    if (dimension == 2) {
      scene_.add_block({0.05, 0.05, 0}, {1.25, 0.85, 0}, {3, -2, 0});
      scene_.add_body(BoxShape{{0.31, 0.33, 0}});
      scene_.add_body(BoxShape{{half, 0.4, 0}});
    } else {
      scene_.add_block({0.05, 0.05, 0.05}, {1.25, 0.65, 0.65}, {3, 1, -2});
      scene_.add_body(BoxShape{{0.31, 0.32, 0.33}});
      scene_.add_body(BoxShape{{half, 0.3, 0.4}});
    }
    solver_ = make_solver(setup);
    solver_->start(bodies());
    dt_ = 0.7 * solver_->largest_step(5.0);
  }

  void step() {
    time_ += dt_;
    solver_->step(dt_, bodies());
  }

  // The same splash at a later time, in a solver that was never started.
  void go_on(double time, std::span<const std::byte> state) {
    solver_ = make_solver(scene_.setup);
    solver_->read_state(state);
    time_ = time;
  }
  [[nodiscard]] double time() const { return time_; }
  void set_time(double time) { time_ = time; }

  [[nodiscard]] const Solver& solver() const { return *solver_; }
  [[nodiscard]] Solver& solver() { return *solver_; }
  [[nodiscard]] const Scene& scene() const { return scene_; }
  [[nodiscard]] double dt() const { return dt_; }
  [[nodiscard]] std::span<const Kinematics> bodies() {
    bodies_[0] = moved({1.7, 0.45, 0.5}, {-1.0, 0.2, 0.1}, 2.0);
    bodies_[1] = moved({0.7, 1.3, 1.3}, {0.1, -1.5, -1.5}, -1.0);
    if (scene_.setup.dimension == 2)
      for (Kinematics& body : bodies_) body.position.z() = body.velocity.z() = 0.0;
    return bodies_;
  }

 private:
  // Uniform motion and rotation, about z in the plane and a slanted axis in space.
  [[nodiscard]] Kinematics moved(const Eigen::Vector3d& from, const Eigen::Vector3d& velocity,
                                 double rate) const {
    const bool planar = scene_.setup.dimension == 2;
    const Eigen::Vector3d axis =
        planar ? Eigen::Vector3d(0, 0, 1) : Eigen::Vector3d(2.0 / 3, 1.0 / 3, 2.0 / 3);
    Kinematics k;
    k.position = from + time_ * velocity;
    k.orientation = Eigen::AngleAxisd(0.3 + rate * time_, axis);
    k.velocity = velocity;
    k.angular_velocity = rate * axis;
    return k;
  }

  Scene scene_;
  std::unique_ptr<Solver> solver_;
  std::array<Kinematics, 2> bodies_;
  double dt_ = 0, time_ = 0;
};

}  // namespace sluice::fluid
