#include "validation/floating_body/floating_body.hpp"

#include <fmt/format.h>

#include <cmath>

#include "validation/support/files.hpp"
#include "validation/support/scene_run.hpp"

namespace sluice::validation {

namespace {

constexpr double kSize = 0.4, kBoxWidth = 0.6, kWidth = 1.6, kLevel = 0.8, kGravity = 9.81;

// Area below the water of a body that reaches `draft` into it.
double immersed(const std::string& scene, double draft) {
  if (draft <= 0) return 0;
  if (scene == "floating_box") return kBoxWidth * std::min(draft, kSize);
  const double R = 0.5 * kSize, cosine = std::clamp(1 - draft / R, -1.0, 1.0), half = std::acos(cosine);
  return R * R * (half - cosine * std::sin(half));
}

double bisect(const auto& rising, double low, double high) {
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    (rising(middle) > 0 ? high : low) = middle;
  }
  return 0.5 * (low + high);
}

// How deep the body whose lowest point is at `bottom` reaches below the level, which it raises itself, of
// liquid of that area.
double draft_at(const std::string& scene, double bottom, double liquid_area) {
  const auto excess = [&](double draft) {
    return (bottom + draft) * kWidth - immersed(scene, draft) - liquid_area;
  };
  return bisect(excess, 0, kLevel);
}

}  // namespace

double archimedes_draft(const std::string& scene, double density) {
  const double share = density / 1000, whole = immersed(scene, kSize);
  return bisect([&](double draft) { return immersed(scene, draft) - share * whole; }, 0, kSize);
}

FloatResult float_body(const Float& what) {
  FloatResult result;
  result.level = archimedes_draft(what.scene, what.density);
  std::vector<std::string> overrides = what.overrides;
  overrides.push_back(fmt::format("body[0].density={}", what.density));
  overrides.push_back(
      fmt::format("body[0].position=[0.8, {}]", kLevel - result.level + 0.5 * kSize + what.lift));
  overrides.push_back(fmt::format("duration={}", what.duration));
  SceneRun run(case_file("floating_body/" + what.scene + ".scene"), overrides);
  double area = 0;
  for (const double mass : run.masses()) area += mass;
  area /=
      1000.0 * (1 + 0.5 * 1000 * kGravity * kLevel /
                        (1000.0 * run.scene().liquid().sound_speed() * run.scene().liquid().sound_speed()));
  result.weight = what.density * immersed(what.scene, kSize) * kGravity;
  const auto note = [&] {
    const double y = run.body(0).position.y();
    result.draft.x.push_back(run.time());
    result.draft.y.push_back(draft_at(what.scene, y - 0.5 * kSize, area));
    result.height.x.push_back(run.time());
    result.height.y.push_back(y);
  };
  const auto force = [&] {
    result.force.x.push_back(run.time());
    result.force.y.push_back(run.wrench(0).force.y());
  };
  note();
  force();
  while (run.next_step()) {
    force();
    if (run.is_output()) note();
  }
  result.iterations = static_cast<double>(run.iterations()) /
                      static_cast<double>(std::max<std::uint64_t>(run.exchanges(), 1));
  return result;
}

}  // namespace sluice::validation
