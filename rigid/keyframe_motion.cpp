#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "rigid/motion.hpp"

// Monotone piecewise cubic interpolation: F. N. Fritsch and R. E. Carlson, "Monotone piecewise cubic
// interpolation", SIAM J. Numer. Anal. 17 (1980) 238-246, with zero slope at both ends so that the velocity
// is continuous with the rest before and after.
namespace sluice::rigid {
namespace {

using Channels = Eigen::Vector4d;  // x, y, z [m], angle [rad]

double secant(const std::vector<Key>& keys, const std::vector<Channels>& values, std::size_t k, int c) {
  return (values[k + 1][c] - values[k][c]) / (keys[k + 1].time - keys[k].time);
}

std::vector<Channels> slopes_of(const std::vector<Key>& keys, const std::vector<Channels>& values) {
  std::vector<Channels> slopes(keys.size(), Channels::Zero());
  for (int c = 0; c < 4; ++c) {
    for (std::size_t k = 1; k + 1 < keys.size(); ++k) {
      const double left = secant(keys, values, k - 1, c), right = secant(keys, values, k, c);
      slopes[k][c] = left * right > 0 ? (left + right) / 2 : 0;
    }
    for (std::size_t k = 0; k + 1 < keys.size(); ++k) {
      const double delta = secant(keys, values, k, c);
      if (delta == 0) continue;  // both slopes are zero already
      const double alpha = slopes[k][c] / delta, beta = slopes[k + 1][c] / delta;
      const double radius = std::hypot(alpha, beta);
      if (radius <= 3) continue;
      slopes[k][c] = 3 / radius * alpha * delta;
      slopes[k + 1][c] = 3 / radius * beta * delta;
    }
  }
  return slopes;
}

class KeyframeMotion final : public Motion {
 public:
  explicit KeyframeMotion(std::vector<Key> keys) : keys_(std::move(keys)) {
    for (const Key& key : keys_)
      values_.emplace_back(key.position.x(), key.position.y(), key.position.z(), key.angle);
    slopes_ = slopes_of(keys_, values_);
  }

  Offset at(double t) const override {
    if (t <= keys_.front().time) return at_rest(values_.front());
    if (t >= keys_.back().time) return at_rest(values_.back());
    const auto after = std::upper_bound(keys_.begin(), keys_.end(), t,
                                        [](double time, const Key& key) { return time < key.time; });
    return between(static_cast<std::size_t>(after - keys_.begin()) - 1, t);
  }

 private:
  static Offset at_rest(const Channels& value) {
    Offset offset;
    offset.position = value.head<3>();
    offset.rotation.z() = value[3];
    return offset;
  }

  Offset between(std::size_t k, double t) const {
    const double h = keys_[k + 1].time - keys_[k].time, s = (t - keys_[k].time) / h;
    const Channels rise = values_[k + 1] - values_[k], m0 = h * slopes_[k], m1 = h * slopes_[k + 1];
    // p(s) = p0 + s (m0 + s (c2 + s c3)), the cubic through both values and slopes.
    const Channels c2 = 3 * rise - 2 * m0 - m1, c3 = m0 + m1 - 2 * rise;
    Offset offset = at_rest(values_[k] + s * (m0 + s * (c2 + s * c3)));
    const Channels velocity = (m0 + s * (2 * c2 + 3 * s * c3)) / h,
                   acceleration = (2 * c2 + 6 * s * c3) / (h * h);
    offset.velocity = velocity.head<3>();
    offset.angular_velocity.z() = velocity[3];
    offset.acceleration = acceleration.head<3>();
    offset.angular_acceleration.z() = acceleration[3];
    return offset;
  }

  std::vector<Key> keys_;
  std::vector<Channels> values_, slopes_;
};

}  // namespace

MotionPtr keyframe_motion(std::vector<Key> keys) {
  if (keys.empty()) throw MotionError("", "keyframes without a key; give at least one");
  for (std::size_t k = 0; k < keys.size(); ++k) {
    const double before = k == 0 ? 0 : keys[k - 1].time;
    if (!std::isfinite(keys[k].time) || (k == 0 ? keys[k].time < 0 : keys[k].time <= before))
      throw MotionError(fmt::format("key[{}].time", k),
                        fmt::format("{} s {}; times must increase strictly from 0 or later", keys[k].time,
                                    k == 0 ? "is before 0" : fmt::format("is not after {} s", before)));
  }
  return std::make_shared<KeyframeMotion>(std::move(keys));
}

}  // namespace sluice::rigid
