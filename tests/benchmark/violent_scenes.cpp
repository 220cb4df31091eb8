#include "benchmark/violent_scenes.hpp"

#include <fmt/format.h>

#include <cmath>

namespace sluice::benchmark {

namespace {

constexpr double kG = 9.81;  // [m/s^2]
constexpr double kA = 1;     // width of a column, diameter of a drop [m]

using Lengths = std::vector<double>;  // by axis, the last one up [m]

// A tank with open top.
Scene tank(const Lengths& size, int cells, double time) {
  Scene scene;
  const bool plane = size.size() == 2;
  scene.set_dimension(static_cast<unsigned>(size.size()));
  scene.set_spacing(kA / cells);
  scene.set_duration(time * std::sqrt(kA / (2 * kG)));
  for (const double length : size) scene.mutable_domain()->add_max(length);
  scene.mutable_domain()->add_open(plane ? Y_MAX : Z_MAX);
  return scene;
}

void add_block(const Lengths& min, const Lengths& max, Scene& scene) {
  Span& box = *scene.add_fluid()->mutable_box();
  for (const double x : min) box.add_min(x);
  for (const double x : max) box.add_max(x);
}

// A column a wide and 2a high, in space a deep, 3a from the far wall.
Scene breaking_column(int dimension, int cells) {
  Scene scene = dimension == 2 ? tank({4, 4}, cells, 15) : tank({3, 1, 4}, cells, 8);
  if (dimension == 2)
    add_block({0, 0}, {kA, 2 * kA}, scene);
  else
    add_block({0, 0, 0}, {kA, kA, 2 * kA}, scene);
  return scene;
}

// Two columns at the ends of a tank that meet in its middle.
Scene meeting_columns(int dimension, int cells) {
  Scene scene = dimension == 2 ? tank({4, 5}, cells, 15) : tank({4, 1, 5}, cells, 8);
  for (const double from : {0.0, 3.0}) {
    if (dimension == 2)
      add_block({from, 0}, {from + kA, 2 * kA}, scene);
    else
      add_block({from, 0, 0}, {from + kA, kA, kA}, scene);
  }
  return scene;
}

// A drop at 6 m/s on a pool.
Scene drop_on_pool(int dimension, int cells) {
  constexpr double kSpeed = 6;
  Scene scene = dimension == 2 ? tank({4, 4}, cells, 15) : tank({2, 2, 4}, cells, 8);
  if (dimension == 2)
    add_block({0, 0}, {4, 0.5}, scene);
  else
    add_block({0, 0, 0}, {2, 2, 0.5}, scene);
  FluidRegion& drop = *scene.add_fluid();
  for (int a = 0; a < dimension; ++a) {
    drop.mutable_ball()->add_center(a + 1 < dimension ? scene.domain().max(a) / 2 : 1.5);
    drop.add_velocity(a + 1 < dimension ? 0 : -kSpeed);
  }
  drop.mutable_ball()->set_radius(kA / 2);
  return scene;
}

struct Kind {
  const char* name;
  Scene (*make)(int dimension, int cells);
  std::vector<int> plane, space;  // spacings in a
};

}  // namespace

std::vector<ViolentScene> violent_scenes(int dimension, bool quick) {
  const std::vector<Kind> kinds{
      {"breaking column", breaking_column, {12, 14, 16, 18, 20, 22, 25, 28}, {6, 7, 8, 10}},
      {"meeting columns", meeting_columns, {10, 12, 14, 16}, {6, 8}},
      {"drop on a pool", drop_on_pool, {12, 16, 20, 24}, {8, 10}}};
  std::vector<ViolentScene> scenes;
  for (const Kind& kind : kinds)
    for (const int cells : dimension == 2 ? kind.plane : kind.space) {
      scenes.push_back({fmt::format("{}, a/{}", kind.name, cells), kind.make(dimension, cells)});
      scenes.back().scene.set_name(scenes.back().name);
      if (quick) break;
    }
  return scenes;
}

}  // namespace sluice::benchmark
