#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "rigid/motion.hpp"

// Motions whose derivatives are known in closed form.
namespace sluice::rigid {
namespace {

struct Scalar {
  double value, first, second;  // derivatives by the same argument
};

// r(s) = 10 s^3 - 15 s^4 + 6 s^5, 0 before and 1 after.
Scalar smooth_step(double s) {
  if (s <= 0) return {0, 0, 0};
  if (s >= 1) return {1, 0, 0};
  return {s * s * s * (10 + s * (6 * s - 15)), 30 * s * s * (1 - s) * (1 - s),
          60 * s * (1 - s) * (1 - 2 * s)};
}

// The argument is t / duration; back to t.
Scalar per_second(const Scalar& f, double duration) {
  return {f.value, f.first / duration, f.second / (duration * duration)};
}

Scalar product(const Scalar& f, const Scalar& g) {
  return {f.value * g.value, f.first * g.value + f.value * g.first,
          f.second * g.value + 2 * f.first * g.first + f.value * g.second};
}

Offset scaled(const Scalar& f, const Eigen::Vector3d& position, double angle) {
  Offset offset;
  offset.position = f.value * position;
  offset.velocity = f.first * position;
  offset.acceleration = f.second * position;
  offset.rotation.z() = f.value * angle;
  offset.angular_velocity.z() = f.first * angle;
  offset.angular_acceleration.z() = f.second * angle;
  return offset;
}

class SinusoidMotion final : public Motion {
 public:
  explicit SinusoidMotion(const Sinusoid& sinusoid) : sinusoid_(sinusoid) {}

  Offset at(double t) const override {
    const double tau = t - sinusoid_.start, omega = 2 * std::numbers::pi * sinusoid_.frequency;
    if (tau < 0) return {};
    const double sine = std::sin(omega * tau), cosine = std::cos(omega * tau);
    Scalar swing{sine, omega * cosine, -omega * omega * sine};
    if (sinusoid_.build_up > 0)
      swing = product(per_second(smooth_step(tau / sinusoid_.build_up), sinusoid_.build_up), swing);
    return scaled(swing, sinusoid_.position, sinusoid_.angle);
  }

 private:
  Sinusoid sinusoid_;
};

class RampMotion final : public Motion {
 public:
  explicit RampMotion(const Ramp& ramp) : ramp_(ramp) {}

  Offset at(double t) const override {
    const Scalar share = per_second(smooth_step((t - ramp_.start) / ramp_.duration), ramp_.duration);
    return scaled(share, ramp_.position, ramp_.angle);
  }

 private:
  Ramp ramp_;
};

void require(bool condition, const char* part, double value, const char* what) {
  if (!condition) throw MotionError(part, fmt::format("{} {}", value, what));
}

}  // namespace

MotionPtr sinusoid_motion(const Sinusoid& sinusoid) {
  require(sinusoid.frequency > 0, "frequency", sinusoid.frequency, "1/s is not positive; give the frequency");
  require(sinusoid.start >= 0, "start", sinusoid.start, "s is before 0; start the motion at 0 or later");
  require(sinusoid.build_up >= 0, "build_up", sinusoid.build_up, "s is negative; give 0 or more");
  return std::make_shared<SinusoidMotion>(sinusoid);
}

MotionPtr ramp_motion(const Ramp& ramp) {
  require(ramp.duration > 0, "duration", ramp.duration, "s is not positive; give the time that it takes");
  require(ramp.start >= 0, "start", ramp.start, "s is before 0; start the motion at 0 or later");
  return std::make_shared<RampMotion>(ramp);
}

}  // namespace sluice::rigid
