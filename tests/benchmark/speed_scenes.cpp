#include "benchmark/speed_scenes.hpp"

#include <google/protobuf/text_format.h>

#include <cmath>
#include <stdexcept>

namespace sluice::benchmark {

namespace {

// The liquid's own size, over the number of particles in it, gives the spacing.
Scene parse(double size, double particles, int dimension, const std::string& rest) {
  const double spacing = std::pow(size / particles, 1.0 / dimension);
  Scene scene;
  if (!google::protobuf::TextFormat::ParseFromString(rest, &scene))
    throw std::logic_error("not a scene: " + rest);
  scene.set_name("speed");
  scene.set_dimension(dimension);
  scene.set_spacing(spacing);
  scene.set_duration(100);
  scene.mutable_output()->set_rate(1);
  return scene;
}

Scene still_tank(double particles) {
  return parse(2.0, particles, 2, R"(
    liquid { density: 1000 } domain { max: [2, 1.5] open: Y_MAX } fluid { box { min: [0, 0] max: [2, 1] } })");
}

Scene dam_break(double particles) {
  return parse(2.0, particles, 2, R"(
    liquid { density: 1000 } domain { max: [4, 3] open: Y_MAX } fluid { box { min: [0, 0] max: [1, 2] } })");
}

Scene rising_gate(double particles) {
  return parse(0.01, particles, 2, R"(
    liquid { density: 1000 } domain { max: [0.4, 0.35] open: Y_MAX }
    fluid { box { min: [0, 0] max: [0.1, 0.1] } }
    body { name: "gate" box { size: [0.004, 0.12] } position: [0.102, 0.06]
           prescribed { constant { velocity: [0, 0.7] } } })");
}

Scene floating_body(double particles) {
  return parse(2.0, particles, 2, R"(
    liquid { density: 1000 } domain { max: [2, 2] open: Y_MAX } fluid { box { min: [0, 0] max: [2, 1] } }
    body { name: "box" box { size: [0.4, 0.4] } position: [1, 1] density: 500 displaces_fluid: true })");
}

Scene dam_break_3d(double particles) {
  return parse(1.0, particles, 3, R"(
    liquid { density: 1000 } domain { max: [3, 1, 2] open: Z_MAX } fluid { box { min: [0, 0, 0] max: [1, 1, 1] } })");
}

Scene floating_box_3d(double particles) {
  return parse(1.0, particles, 3, R"(
    liquid { density: 1000 } domain { max: [1.25, 1.25, 1.4] open: Z_MAX }
    fluid { box { min: [0, 0, 0] max: [1.25, 1.25, 0.64] } }
    body { name: "box" box { size: [0.4, 0.4, 0.4] } position: [0.625, 0.625, 0.64] density: 500
           displaces_fluid: true })");
}

}  // namespace

const std::vector<SpeedScene>& all_speed_scenes() {
  static const std::vector<SpeedScene> scenes{
      {"still_tank", "Water at rest", 2, {1e4, 1e5, 1e6}, still_tank},
      {"dam_break", "A dam break", 2, {1e4, 1e5, 1e6}, dam_break},
      {"rising_gate", "Water running out under a rising gate", 2, {1e4, 1e5, 1e6}, rising_gate},
      {"floating_body", "A floating box", 2, {1e4, 1e5, 1e6}, floating_body},
      {"dam_break_3d", "A dam break in space", 3, {1e5, 1e6}, dam_break_3d},
      {"floating_box_3d", "A floating box in space", 3, {1e5, 1e6}, floating_box_3d}};
  return scenes;
}

}  // namespace sluice::benchmark
