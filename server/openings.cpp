#include "server/openings.hpp"

#include <fmt/format.h>

#include <memory>

#include "protocol/formula.hpp"
#include "server/geometry.hpp"
#include "server/stop.hpp"

namespace sluice::server {

namespace {

using TimeAndPlace = std::function<double(double, const Eigen::Vector3d&)>;

// Empty where there is no formula.
TimeAndPlace to_function(const std::string& opening, const std::string& text) {
  if (text.empty()) return {};
  const auto formula = std::make_shared<protocol::Formula>(text, true);
  return [opening, formula](double time, const Eigen::Vector3d& x) {
    try {
      return formula->at({x.x(), x.y(), x.z()}, time);
    } catch (const protocol::FormulaError& error) {
      throw Stop(End::UNSTABLE, fmt::format("opening \"{}\": {}", opening, error.what()));
    }
  };
}

std::function<double(double)> of_time(const TimeAndPlace& function) {
  if (!function) return {};
  return [function](double time) { return function(time, Eigen::Vector3d::Zero()); };
}

// A corner of the rectangle, of its coordinates along the side.
Eigen::Vector3d corner(const google::protobuf::RepeatedField<double>& along, int axis, double plane,
                       unsigned dimension) {
  Eigen::Vector3d x = Eigen::Vector3d::Zero();
  int entry = 0;
  for (int a = 0; a < static_cast<int>(dimension); ++a) x[a] = a == axis ? plane : along[entry++];
  return x;
}

fluid::Opening to_opening(const Opening& opening, const Scene& scene) {
  const int side = opening.side() - X_MIN, axis = side / 2;
  const double plane = side % 2 == 0 ? scene.domain().min(axis) : scene.domain().max(axis);
  const Inflow& in = opening.inflow();
  const Outflow& out = opening.outflow();
  const bool inflow = opening.has_inflow();
  return {.side = side,
          .min = corner(opening.min(), axis, plane, scene.dimension()),
          .max = corner(opening.max(), axis, plane, scene.dimension()),
          .inflow = inflow,
          .speed = to_function(opening.name(), in.speed()),
          .pressure = to_function(opening.name(), inflow ? in.pressure() : out.pressure()),
          .level = of_time(to_function(opening.name(), inflow ? in.level() : out.level()))};
}

}  // namespace

std::vector<fluid::Opening> to_openings(const Scene& scene) {
  std::vector<fluid::Opening> openings;
  for (const Opening& opening : scene.opening()) openings.push_back(to_opening(opening, scene));
  return openings;
}

}  // namespace sluice::server
