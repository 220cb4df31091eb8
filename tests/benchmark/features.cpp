#include <fmt/format.h>

#include "benchmark/instructions.hpp"

namespace sluice::benchmark {

namespace {

// A column of water that collapses, with what is added to its liquid, tank, regions and the scene.
std::string dam(const std::string& liquid = "", const std::string& domain = "max: [2, 2] open: Y_MAX",
                const std::string& rest = "",
                const std::string& fluid = "fluid { box { min: [0, 0] max: [1, 1] } }") {
  return fmt::format("dimension: 2 liquid {{ density: 1000 {} }} domain {{ {} }} {} {}", liquid, domain,
                     fluid, rest);
}

std::string with_body(const std::string& body) {
  return dam("", "max: [2, 2] open: Y_MAX", "body { name: 'b' position: [1.5, 1] " + body + " }");
}

}  // namespace

const std::vector<Feature>& all_features() {
  static const std::string two_regions =
      "fluid { box { min: [0, 0] max: [1, 0.5] } } fluid { box { min: [0, 0.5] max: [1, 1] } ";
  static const std::string tank = "max: [2, 2] open: Y_MAX";
  static const std::string at_rest = "box { size: [0.3, 0.6] } prescribed { constant {} }";
  static const std::vector<Feature> features{
      {"viscosity", dam(), dam("viscosity: 1e-3")},
      {"sticking_walls", dam("viscosity: 1e-3"), dam("viscosity: 1e-3", tank + " surface: NO_SLIP")},
      {"second_liquid", dam("", tank, "", two_regions + "}"),
       dam("", tank, "other_liquid { name: 'oil' density: 800 }", two_regions + "liquid: 'oil' }")},
      {"surface_tension", dam(), dam("surface_tension: 0.07")},
      {"wider_tank", dam(), dam("", "max: [8, 8] open: Y_MAX")},
      {"periodic_axis", dam(), dam("", "max: [2, 2] open: Y_MAX periodic: X_AXIS")},
      {"shifting", dam("", tank, "formulation { shifting: 0 }"),
       dam("", tank, "formulation { shifting: 6 }")},
      {"tension_control", dam(), dam("", tank, "formulation { tension_control: true }")},
      {"body_at_rest", dam(), with_body(at_rest)},
      {"body_that_moves", with_body(at_rest),
       with_body("box { size: [0.3, 0.6] } prescribed { constant { velocity: [0, 0.01] } }")},
      {"free_body", with_body(at_rest), with_body("box { size: [0.3, 0.6] } density: 500")},
      {"thin_plate", with_body(at_rest), with_body("box { size: [0.1, 0.6] } prescribed { constant {} }")}};
  return features;
}

}  // namespace sluice::benchmark
