#include "rigid/motion.hpp"

#include <fmt/format.h>

namespace sluice::rigid {
namespace {

class ConstantVelocity final : public Motion {
 public:
  ConstantVelocity(const Eigen::Vector3d& velocity, const Eigen::Vector3d& angular_velocity, double start)
      : velocity_(velocity), angular_velocity_(angular_velocity), start_(start) {}

  Offset at(double t) const override {
    Offset offset;
    if (t < start_) return offset;
    offset.position = velocity_ * (t - start_);
    offset.rotation = angular_velocity_ * (t - start_);
    offset.velocity = velocity_;
    offset.angular_velocity = angular_velocity_;
    return offset;
  }

 private:
  Eigen::Vector3d velocity_, angular_velocity_;
  double start_;
};

}  // namespace

MotionPtr constant_velocity(const Eigen::Vector3d& velocity, const Eigen::Vector3d& angular_velocity,
                            double start) {
  if (!(start >= 0))
    throw MotionError("start", fmt::format("{} s is before 0; start the motion at 0 or later", start));
  return std::make_shared<ConstantVelocity>(velocity, angular_velocity, start);
}

void check_starts_at_zero(const Motion& motion) {
  constexpr double kTolerance = 1e-12;
  const Offset offset = motion.at(0);
  const Eigen::Vector3d& x = offset.position;
  if (x.cwiseAbs().maxCoeff() <= kTolerance && offset.rotation.cwiseAbs().maxCoeff() <= kTolerance) return;
  throw MotionError(
      "", fmt::format("the motion starts at offset ({:g}, {:g}, {:g}) m, {:g} rad at t = 0, where it "
                      "must be zero; subtract this from it and move the body's initial pose instead",
                      x.x(), x.y(), x.z(), offset.rotation.norm()));
}

}  // namespace sluice::rigid
