#include <fmt/format.h>

#include "protocol/field_check.hpp"

namespace sluice::protocol {
namespace {

constexpr double kHighestRate = 1e6;  // [1/s]
constexpr double kMostFrames = 1e7;

void check_rate(const Scene& scene, FieldCheck& check) {
  const Output& output = scene.output();
  if (output.has_particles_every() && output.particles_every() == 0)
    check.report("output.particles_every", "0 is not positive; leave it out for particles in every output");
  if (!output.has_rate()) return;
  const double rate = output.rate();
  check.positive(rate, "output.rate", "frames per second", "leave it out for 100 frames over the run");
  if (rate > kHighestRate || rate * scene.duration() > kMostFrames)
    check.report("output.rate",
                 fmt::format("{} frames per second over {} s; at most {} per second and {} in all", rate,
                             scene.duration(), kHighestRate, kMostFrames));
}

void check_fields(const Scene& scene, FieldCheck& check) {
  const Output& output = scene.output();
  for (int i = 0; i < output.field_size(); ++i) {
    const std::string field = fmt::format("output.field[{}]", i);
    if (output.field(i) < POSITION || output.field(i) > LIQUID)
      check.report(field, fmt::format("{} is none; give POSITION, VELOCITY, DENSITY, PRESSURE or LIQUID",
                                      static_cast<int>(output.field(i))));
    if (output.field(i) == LIQUID && scene.other_liquid().empty())
      check.report(field, "LIQUID is the same for all particles of a scene with one liquid; leave it out");
  }
  if (output.precision() < PRECISION_UNSPECIFIED || output.precision() > FLOAT64)
    check.report("output.precision",
                 fmt::format("{} is none; give FLOAT32 or FLOAT64", static_cast<int>(output.precision())));
}

void check_region(const Span& region, FieldCheck& check) {
  const bool is_whole = check.vector(region.min(), "output.region.min", "the lower corner");
  if (!check.vector(region.max(), "output.region.max", "the upper corner") || !is_whole) return;
  for (int axis = 0; axis < check.dimension(); ++axis)
    if (!(region.min(axis) < region.max(axis)))
      check.report(fmt::format("output.region.max[{}]", axis),
                   fmt::format("{} m is not above min[{}], {} m; give two opposite corners", region.max(axis),
                               axis, region.min(axis)));
}

}  // namespace

void check_output(const Scene& scene, FieldCheck& check) {
  check_rate(scene, check);
  check_fields(scene, check);
  const bool is_plane_or_space = check.dimension() == 2 || check.dimension() == 3;
  if (scene.output().has_region() && is_plane_or_space) check_region(scene.output().region(), check);
}

}  // namespace sluice::protocol
