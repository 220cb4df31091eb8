#include "protocol/scene_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "protocol/field_check.hpp"
#include "protocol/framing.hpp"

namespace sluice::protocol {
namespace {

constexpr std::size_t kLongestSceneName = 200;
constexpr double kLongestRun = 1e9;  // [s]
constexpr int kMostRegions = 10'000;

bool printable(const std::string& text) {
  return std::none_of(text.begin(), text.end(), [](unsigned char c) { return c < ' ' || c == 127; });
}

void check_run(const Scene& scene, FieldCheck& check) {
  if (scene.name().size() > kLongestSceneName || !printable(scene.name()))
    check.report("name", fmt::format("needs at most {} characters and none of control", kLongestSceneName));
  check.positive(scene.spacing(), "spacing", "m", "give the distance between particles");
  check.positive(scene.duration(), "duration", "s", "give the time to simulate");
  if (scene.duration() > kLongestRun)
    check.report("duration", fmt::format("{} s is beyond {} s", scene.duration(), kLongestRun));
  check.optional_vector(scene.gravity(), "gravity", "the acceleration of gravity");
}

void check_liquid(const Liquid& liquid, FieldCheck& check) {
  if (liquid.has_density())
    check.positive(liquid.density(), "liquid.density", "kg/m^3", "leave it out for water, 1000");
  if (liquid.has_viscosity()) check.not_negative(liquid.viscosity(), "liquid.viscosity", "Pa s");
  if (liquid.has_surface_tension())
    check.not_negative(liquid.surface_tension(), "liquid.surface_tension", "N/m");
  if (liquid.has_sound_speed())
    check.positive(liquid.sound_speed(), "liquid.sound_speed", "m/s", "leave it out for ten times max_speed");
  if (liquid.has_max_speed())
    check.positive(liquid.max_speed(), "liquid.max_speed", "m/s",
                   "give the largest speed expected in the flow");
  if (liquid.has_sound_speed() && liquid.has_max_speed() && liquid.sound_speed() < liquid.max_speed())
    check.report("liquid.sound_speed",
                 fmt::format("{} m/s is below max_speed, {} m/s; ten times max_speed keeps "
                             "the density within 1 %",
                             liquid.sound_speed(), liquid.max_speed()));
}

void check_regions(const Scene& scene, FieldCheck& check) {
  const bool is_fed = std::any_of(scene.opening().begin(), scene.opening().end(),
                                  [](const Opening& opening) { return opening.has_inflow(); });
  if (scene.fluid().empty() && !is_fed)
    check.report("fluid",
                 "is missing; give at least one region, e.g. fluid { box { min: [0, 0] max: [1, 0.5] } }");
  if (!check.count(scene.fluid_size(), kMostRegions, "fluid")) return;
  for (int i = 0; i < scene.fluid_size(); ++i) {
    const std::string field = fmt::format("fluid[{}]", i);
    check_fluid(scene.fluid(i), field, check);
    if (scene.fluid(i).has_velocity_field() && !scene.liquid().has_max_speed())
      check.report(field + ".velocity_field",
                   "needs liquid.max_speed: give the largest speed expected in the flow [m/s]");
  }
}

// Of scenes that are right in every field.
void check_speed(const Scene& scene, FieldCheck& check) {
  if (with_defaults(scene).liquid().max_speed() <= 0)
    check.report(
        "liquid.max_speed",
        "follows neither from gravity nor from an initial speed; give the largest speed expected [m/s]");
}

void check_size(const Scene& scene, FieldCheck& check) {
  const std::size_t most = Limits{}.header_bytes / 2;
  if (scene.ByteSizeLong() > most)
    check.report(
        "", fmt::format("the scene takes {} bytes as a message, at most {} are sent; use fewer vertices or "
                        "keyframes",
                        scene.ByteSizeLong(), most));
}

}  // namespace

std::vector<Problem> check_fields(const Scene& scene) {
  FieldCheck check(static_cast<int>(scene.dimension()));
  check_numbers(scene, "", check);
  check_size(scene, check);
  check_run(scene, check);
  check_liquid(scene.liquid(), check);
  check_other_liquids(scene, check);
  check_output(scene, check);
  check_formulation(scene, check);
  check_coupling(scene, check);
  if (scene.dimension() == 2 || scene.dimension() == 3) {
    check_domain(scene, check);
    check_openings(scene, check);
    check_regions(scene, check);
    check_bodies(scene, check);
    check_joints(scene, check);
    check_probes(scene, check);
    check_contact(scene.contact(), "contact", check);
  } else {
    check.report("dimension", fmt::format("{} is neither 2 nor 3; give one of them", scene.dimension()));
  }
  if (check.problems().empty()) check_counts(scene, check);
  if (check.problems().empty()) check_speed(scene, check);
  return check.problems();
}

}  // namespace sluice::protocol
