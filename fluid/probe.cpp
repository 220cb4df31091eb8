#include "fluid/probe.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

#include "fluid/kernel.hpp"

namespace sluice::fluid {

namespace {

// Smallest eigenvalue of the moments over the largest, lengths in h, below which the fit is by constants.
constexpr double kLinear = 0.02;
constexpr double kAtSurface = 0.5;  // wetness
constexpr int kSearch = 8;          // samples of the surface's line per h
constexpr int kBisections = 16;

Eigen::Map<const Eigen::Vector3d> vector_at(const std::vector<double>& values, std::size_t i) {
  return Eigen::Map<const Eigen::Vector3d>(values.data() + 3 * i);
}

double kernel(const ProbedFluid& fluid, const Eigen::Vector3d& r) {
  if (fluid.dimension == 2) return WendlandC2<2>(fluid.smoothing).value(narrow<2>(r));
  return WendlandC2<3>(fluid.smoothing).value(narrow<3>(r));
}

// Particles within the support of the line through x along `up`; of x alone where `up` is zero.
std::vector<std::size_t> near_line(const ProbedFluid& fluid, const Eigen::Vector3d& x,
                                   const Eigen::Vector3d& up) {
  const double support = 2 * fluid.smoothing;
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < fluid.state.density.size(); ++i) {
    const Eigen::Vector3d r = vector_at(fluid.state.position, i) - x;
    if ((r - r.dot(up) * up).squaredNorm() < support * support) found.push_back(i);
  }
  return found;
}

double volume(const ProbedFluid& fluid, std::size_t i) {
  const std::size_t liquid = fluid.state.liquid.empty() ? 0 : fluid.state.liquid[i];
  return fluid.particle_mass[liquid] / fluid.state.density[i];
}

double wetness(const ProbedFluid& fluid, const std::vector<std::size_t>& particles,
               const Eigen::Vector3d& x) {
  double sum = 0;
  for (const std::size_t i : particles)
    sum += volume(fluid, i) * kernel(fluid, vector_at(fluid.state.position, i) - x);
  return sum;
}

}  // namespace

PointSample sample_point(const ProbedFluid& fluid, const Eigen::Vector3d& x) {
  const Eigen::Index size = fluid.dimension + 1;
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(size, size), b = Eigen::MatrixXd::Zero(size, 4);
  for (const std::size_t i : near_line(fluid, x, Eigen::Vector3d::Zero())) {
    const Eigen::Vector3d r = vector_at(fluid.state.position, i) - x;
    const double VW = volume(fluid, i) * kernel(fluid, r);
    Eigen::VectorXd basis(size);
    basis << 1, r.head(fluid.dimension) / fluid.smoothing;
    A += VW * basis * basis.transpose();
    const Eigen::Vector3d v = vector_at(fluid.state.velocity, i);
    b += VW * basis * Eigen::RowVector4d(fluid.state.pressure[i], v.x(), v.y(), v.z());
  }
  PointSample sample;
  sample.wetness = A(0, 0);
  if (sample.wetness == 0) return sample;
  const Eigen::VectorXd eigenvalues =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(A, Eigen::EigenvaluesOnly).eigenvalues();
  const bool linear = eigenvalues[0] > kLinear * eigenvalues[size - 1];
  const Eigen::RowVector4d value =
      linear ? Eigen::RowVector4d(A.ldlt().solve(b).row(0)) : Eigen::RowVector4d(b.row(0) / A(0, 0));
  sample.pressure = value[0];
  sample.velocity = value.tail<3>().transpose();
  return sample;
}

double surface_height(const ProbedFluid& fluid, const Eigen::Vector3d& x, const Eigen::Vector3d& up) {
  const std::vector<std::size_t> particles = near_line(fluid, x, up);
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const std::size_t i : particles) {
    const double z = vector_at(fluid.state.position, i).dot(up);
    low = std::min(low, z);
    high = std::max(high, z);
  }
  const auto is_wet = [&](double z) {
    return wetness(fluid, particles, x + (z - x.dot(up)) * up) >= kAtSurface;
  };
  const double step = fluid.smoothing / kSearch;
  for (double z = high + 2 * fluid.smoothing; z > low - step; z -= step) {
    if (!is_wet(z)) continue;
    double wet = z, dry = z + step;
    for (int i = 0; i < kBisections; ++i) {
      const double middle = (wet + dry) / 2;
      (is_wet(middle) ? wet : dry) = middle;
    }
    return (wet + dry) / 2;
  }
  return -std::numeric_limits<double>::infinity();
}

}  // namespace sluice::fluid
