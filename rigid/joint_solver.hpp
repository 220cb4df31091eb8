#pragma once

#include <span>
#include <vector>

#include "rigid/free_body.hpp"
#include "rigid/joint_geometry.hpp"

namespace sluice::rigid {

// A body as joints see it.
struct JointedBody {
  FreeBody* free = nullptr;  // null: it moves as prescribed
  // Of prescribed bodies: at the start and end of the step, and the velocities at its end.
  Pose start, end;
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero(), angular_velocity = Eigen::Vector3d::Zero();
  // Of free bodies: what contact changes of the velocities of the drift.
  Eigen::Vector3d contact = Eigen::Vector3d::Zero(), contact_turn = Eigen::Vector3d::Zero();
};

// All joints of a world. Holds no state from step to step.
class JointSolver {
 public:
  JointSolver(std::span<const JointSpec> joints, std::span<const BodySpec> bodies);

  [[nodiscard]] bool empty() const { return joints_.empty(); }
  [[nodiscard]] bool has_dampers() const;
  // Whether the body is held by hinge, slider or fixed.
  [[nodiscard]] bool holds(std::size_t body) const;

  // Impulses along the joints at the start of a drift after which they hold (SHAKE: J.-P. Ryckaert, G.
  // Ciccotti, H. J. C. Berendsen, J. Comput. Phys. 23 (1977) 327), motors have turned by their speed and
  // limits are kept. Throws std::runtime_error naming the bodies when none are found.
  void hold(double dt, std::span<JointedBody> bodies) const;

  // Takes out of the velocities at the end of a step what the joints do not allow (RATTLE: H. C. Andersen, J.
  // Comput. Phys. 52 (1983) 24).
  void project(std::span<JointedBody> bodies) const;

  // Forces of springs and dampers now, with the velocities of this instant; one for every body.
  [[nodiscard]] std::vector<Wrench> loads(std::span<const JointedBody> bodies) const;

 private:
  struct Joint {
    JointSpec spec;
    JointGeometry geometry;
    double rest;
  };

  std::vector<Joint> joints_;
  std::vector<std::string> names_;  // of the bodies held, for messages
};

}  // namespace sluice::rigid
