#pragma once

#include <random>
#include <vector>

#include "fluid/types.hpp"

namespace sluice::fluid {

// Uniform in the cube [-1, 1]^Dim.
template <int Dim>
Vec<Dim> random_vector(std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Vec<Dim> v;
  for (int a = 0; a < Dim; ++a) v[a] = uniform(random);
  return v;
}

// On the unit sphere.
template <int Dim>
Vec<Dim> random_direction(std::mt19937_64& random) {
  for (;;) {
    const Vec<Dim> v = random_vector<Dim>(random);
    const double length = v.norm();
    if (length > 0.1 && length <= 1.0) return v / length;
  }
}

template <int Dim>
Mat<Dim> random_matrix(std::mt19937_64& random) {
  Mat<Dim> m;
  for (int a = 0; a < Dim; ++a) m.col(a) = random_vector<Dim>(random);
  return m;
}

// A block of cells^Dim lattice points, the first at half a spacing, each moved by up to `jitter` spacings
// along every axis.
template <int Dim>
std::vector<Vec<Dim>> jittered_lattice(int cells, double spacing, double jitter, std::mt19937_64& random) {
  std::vector<Vec<Dim>> points;
  for (int c = 0; c < (Dim == 3 ? cells : 1); ++c)
    for (int b = 0; b < cells; ++b)
      for (int a = 0; a < cells; ++a) {
        Vec<Dim> x;
        x[0] = a + 0.5;
        x[1] = b + 0.5;
        if constexpr (Dim == 3) x[2] = c + 0.5;
        points.push_back(spacing * (x + jitter * random_vector<Dim>(random)));
      }
  return points;
}

// Particles on the edges of such a block: the corners in the plane.
template <int Dim>
std::size_t edge_particles(int cells) {
  return Dim == 2 ? 4u : 12u * static_cast<std::size_t>(cells - 2) + 8u;
}

}  // namespace sluice::fluid
