#include "rigid/motion.hpp"
#include "rigid/shape.hpp"

// Motions whose rotation is led elsewhere: about another axis, about another point.
namespace sluice::rigid {
namespace {

class AboutAxis final : public Motion {
 public:
  AboutAxis(MotionPtr motion, const Eigen::Vector3d& axis) : motion_(std::move(motion)), axis_(axis) {}

  Offset at(double t) const override {
    Offset offset = motion_->at(t);
    offset.rotation = offset.rotation.z() * axis_;
    offset.angular_velocity = offset.angular_velocity.z() * axis_;
    offset.angular_acceleration = offset.angular_acceleration.z() * axis_;
    return offset;
  }

 private:
  MotionPtr motion_;
  Eigen::Vector3d axis_;
};

// With the arm d = R d0:  X = X_offset + d - d0,  V = V_offset + w x d,
//                         A = A_offset + dw/dt x d + w x (w x d)
class AboutPivot final : public Motion {
 public:
  AboutPivot(MotionPtr motion, const Eigen::Vector3d& arm) : motion_(std::move(motion)), arm_(arm) {}

  Offset at(double t) const override {
    Offset offset = motion_->at(t);
    const Eigen::Vector3d d = rotation(offset.rotation) * arm_, swing = offset.angular_velocity.cross(d);
    offset.position += d - arm_;
    offset.velocity += swing;
    offset.acceleration += offset.angular_acceleration.cross(d) + offset.angular_velocity.cross(swing);
    return offset;
  }

 private:
  MotionPtr motion_;
  Eigen::Vector3d arm_;
};

}  // namespace

MotionPtr about_axis(MotionPtr motion, const Eigen::Vector3d& axis) {
  return std::make_shared<AboutAxis>(std::move(motion), axis);
}

MotionPtr about_pivot(MotionPtr motion, const Eigen::Vector3d& arm) {
  return std::make_shared<AboutPivot>(std::move(motion), arm);
}

}  // namespace sluice::rigid
