#include "fluid/body_step.hpp"

#include <algorithm>
#include <limits>

namespace sluice::fluid {

namespace {

constexpr double kLargestShare = 0.5;

// Largest cross-section [m^2], [m] in two dimensions, across one of the body's own axes.
double cross_section(const Boundary& body, int dimension) {
  Eigen::Vector3d low = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (std::size_t w = 0; w < body.position.size(); ++w) {
    const Eigen::Vector3d surface = body.position[w] + body.to_surface[w];
    low = low.cwiseMin(surface);
    high = high.cwiseMax(surface);
  }
  const Eigen::VectorXd size = (high - low).head(dimension);
  return size.prod() / size.minCoeff();
}

}  // namespace

double body_impedance(const Setup& setup, std::size_t body) {
  return 2.0 * setup.liquid.density * setup.liquid.sound_speed *
         cross_section(setup.bodies[body], setup.dimension);
}

double largest_body_step(const Setup& setup) {
  double largest = std::numeric_limits<double>::infinity();
  for (std::size_t b = 0; b < setup.bodies.size(); ++b) {
    const double mass = setup.bodies[b].free_mass;
    if (mass > 0.0) largest = std::min(largest, kLargestShare * mass / body_impedance(setup, b));
  }
  return largest;
}

}  // namespace sluice::fluid
