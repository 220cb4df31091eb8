#include <fmt/format.h>

#include <algorithm>

#include "clients/preflight/checks.hpp"
#include "protocol/liquids.hpp"

namespace sluice::clients {
namespace {

constexpr int kSamples = 4000;        // of a motion over the run
constexpr double kLargestMach = 0.1;  // prescribed speed over the speed of sound
constexpr int kBisections = 60;

// Evenly over the run, and where the motion changes its course.
std::vector<double> instants(const BodyLayout& body, double duration) {
  std::vector<double> times;
  for (int i = 0; i <= kSamples; ++i) times.push_back(duration * i / kSamples);
  for (const double t : body.key_times)
    if (t > 0 && t < duration) times.push_back(t);
  std::sort(times.begin(), times.end());
  return times;
}

double beyond_at(const BodyLayout& body, const Layout& layout, int side, double t) {
  const rigid::Offset offset = body.motion->at(t);
  const rigid::Pose pose{body.placed.pose.position + offset.position,
                         rigid::rotation(offset.rotation) * body.placed.pose.orientation};
  return beyond(rigid::extent(body.placed.shape, pose, Eigen::Vector3d::Unit(side / 2), layout.dimension),
                layout.tank, side);
}

// The first time at which the body is through the side, given that it is at `after` and is not at `before`.
double crossing(const BodyLayout& body, const Layout& layout, int side, double before, double after) {
  for (int i = 0; i < kBisections; ++i) {
    const double middle = (before + after) / 2;
    (beyond_at(body, layout, side, middle) > layout.tolerance ? after : before) = middle;
  }
  return after;
}

void check_stays_inside(const BodyLayout& body, const Layout& layout, const std::vector<double>& times,
                        Findings& findings) {
  for (int side = 0; side < 2 * layout.dimension; ++side) {
    // A body that starts in the wall is an error of its position.
    if (!layout.tank.closed[side] || beyond_at(body, layout, side, 0) > layout.tolerance) continue;
    const auto outside = std::find_if(times.begin(), times.end(), [&](double t) {
      return beyond_at(body, layout, side, t) > layout.tolerance;
    });
    if (outside == times.end()) continue;
    const double t = crossing(body, layout, side, *(outside - 1), *outside);
    findings.error(
        body.field + ".prescribed",
        fmt::format(
            "body '{}' leaves the domain through the wall at {} at t = {:.6g} s; shorten the motion or "
            "the run, enlarge the domain, or open that side",
            body.name, side_name(side), t));
  }
}

void check_speed(const BodyLayout& body, const Layout& layout, const std::vector<double>& times,
                 Findings& findings) {
  const double radius = rigid::bounding_radius(body.placed.shape, layout.dimension);
  const double sound = protocol::slowest_sound(layout.scene);
  double fastest = 0, when = 0;
  for (const double t : times) {
    const rigid::Offset offset = body.motion->at(t);
    const double speed = offset.velocity.norm() + offset.angular_velocity.norm() * radius;
    if (speed > fastest) fastest = speed, when = t;
  }
  if (fastest > kLargestMach * sound * (1 + 1e-9))
    findings.warning(
        body.field + ".prescribed",
        fmt::format("body '{}' moves at up to {:.4g} m/s (t = {:.4g} s), above a tenth of the speed of sound "
                    "{:.4g} m/s: the liquid will compress; set liquid.max_speed to {:.3g} m/s or more",
                    body.name, fastest, when, sound, fastest));
}

// Only formulas fail at a time, and name their component.
std::string field_of(const BodyLayout& body, const rigid::MotionError& error) {
  const std::string motion = body.field + ".prescribed";
  return error.part().empty() ? motion : motion + ".expression." + error.part();
}

}  // namespace

void check_motions(const Layout& layout, Findings& findings) {
  for (const BodyLayout& body : layout.bodies) {
    if (!body.motion) continue;
    const std::vector<double> times = instants(body, body.motion_end);
    try {
      rigid::check_starts_at_zero(*body.motion);
      check_stays_inside(body, layout, times, findings);
      check_speed(body, layout, times, findings);
    } catch (const rigid::MotionError& error) {
      findings.error(field_of(body, error), fmt::format("body '{}': {}", body.name, error.what()));
    }
  }
}

}  // namespace sluice::clients
