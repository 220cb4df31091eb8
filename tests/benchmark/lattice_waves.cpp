#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "benchmark/checks.hpp"
#include "benchmark/lattice.hpp"

// Waves of displacement u of a lattice under uniform pressure p (fluid/README.md, "The lattice under
// pressure"). The density follows the displacement, as the solver's own divergence makes it:
//   rho a = K(k) u,  s = (largest eigenvalue of K)/(p k^2).
// A wave with s > 0 grows. K has two parts, the response to the places and to the pressures, both taken from
// one short step of the solver.

namespace sluice::benchmark {

namespace {

using Eigen::Vector3d;

constexpr int kCells = 24;

struct Wave {
  int m, n;  // wavelengths in the square along x and y

  [[nodiscard]] Vector3d number() const { return 2 * M_PI * Vector3d(m, n, 0); }
  // Its phase at a place; the shift keeps a lattice point off every node of the shortest waves.
  [[nodiscard]] double phase(const Vector3d& x) const { return number().dot(x) + 0.7; }
};

// State at the start of the short step, and what the step makes of it.
struct Response {
  std::vector<Vector3d> acceleration;
  std::vector<double> expansion;  // - d(rho)/dt / rho, the divergence
};

template <typename State>
Response step(double smoothing, const State& state) {
  Lattice lattice(kCells);
  lattice.setup.formulation.smoothing = smoothing;
  lattice.setup.formulation.artificial_viscosity = lattice.setup.formulation.density_diffusion = 0;
  lattice.for_each([&](const Vector3d& x, int, int) { state(lattice, x); });
  const auto solver = fluid::make_solver(lattice.setup);
  solver->start({});
  const fluid::Snapshot before = solver->snapshot();
  const double dt = 1e-6 * solver->largest_step(0);
  solver->step(dt, {});
  const fluid::Snapshot after = solver->snapshot();
  Response response;
  for (std::size_t i = 0; i < after.density.size(); ++i) {
    const auto velocity = [i](const fluid::Snapshot& s) {
      return Eigen::Map<const Vector3d>(&s.velocity[3 * i]);
    };
    response.acceleration.emplace_back((velocity(after) - velocity(before)) / dt);
    response.expansion.push_back((before.density[i] / after.density[i] - 1) / dt);
  }
  return response;
}

// rho a over u of a wave, for both directions of u, with the density that belongs to it.
Eigen::Matrix2d stiffness(double smoothing, const Wave& wave) {
  const double amplitude = 1e-4 / kCells;
  Eigen::Matrix2d K;
  for (int direction = 0; direction < 2; ++direction) {
    const Vector3d along = Vector3d::Unit(direction);
    // The divergence of a velocity is that of a displacement a second long.
    const Response moving = step(smoothing, [&](Lattice& lattice, const Vector3d& x) {
      lattice.add(x, std::sin(wave.phase(x)) * along, Lattice::kPressure);
    });
    std::size_t next = 0;
    const double stiff = Lattice::kDensity * Lattice::kSoundSpeed * Lattice::kSoundSpeed;
    const Response displaced = step(smoothing, [&](Lattice& lattice, const Vector3d& x) {
      lattice.add(x + amplitude * std::sin(wave.phase(x)) * along, Vector3d::Zero(),
                  Lattice::kPressure - stiff * amplitude * moving.expansion[next++]);
    });
    Vector3d sum = Vector3d::Zero();
    double square = 0;
    std::size_t i = 0;
    Lattice(kCells).for_each([&](const Vector3d& x, int, int) {
      sum += std::sin(wave.phase(x)) * displaced.acceleration[i++];
      square += std::pow(std::sin(wave.phase(x)), 2);
    });
    K.col(direction) = Lattice::kDensity * sum.head<2>() / (square * amplitude);
  }
  return K;
}

// Largest s of a wave; along a wave number the pressure resists, so that it is that of the rest.
double largest_share(double smoothing, const Wave& wave) {
  const Eigen::EigenSolver<Eigen::Matrix2d> solver(stiffness(smoothing, wave), false);
  return solver.eigenvalues().real().maxCoeff() / (Lattice::kPressure * wave.number().squaredNorm());
}

struct Worst {
  double share = -std::numeric_limits<double>::infinity();
  Wave wave{0, 0};
};

// Over all wave vectors, of which symmetry leaves 0 <= n <= m. `stride`: every one, or every second.
Worst worst(double smoothing, int stride) {
  Worst result;
  for (int m = stride; m <= kCells / 2; m += stride)
    for (int n = 0; n <= m; n += stride)
      if (const double share = largest_share(smoothing, {m, n}); share > result.share)
        result = {share, {m, n}};
  return result;
}

}  // namespace

StabilityTable lattice_waves(const StabilityOptions& options) {
  StabilityTable table{
      .name = "lattice_waves",
      .title =
          "Waves of displacement of a square lattice under pressure: largest growth s of all wave vectors",
      .items = "h/dx",
      .columns = {{"largest s", ""}, {"wavelength", "dx"}, {"direction", "deg"}},
      .rows = {},
      .figures = {}};
  std::vector<double> smoothings{1.3, 1.4, 1.5, 1.6, 1.8, 2.0};
  if (!options.quick)
    smoothings = {1.3, 1.35, 1.4, 1.425, 1.475, 1.5, 1.55, 1.6, 1.65, 1.7, 1.75, 1.8, 1.85, 1.9, 1.95, 2.0};
  const double chosen = fluid::stable_smoothing(2);
  smoothings.push_back(chosen);
  std::sort(smoothings.begin(), smoothings.end());
  for (const double smoothing : smoothings) {
    const Worst found = worst(smoothing, options.quick ? 2 : 1);
    table.rows.push_back({fmt::format("{:g}", smoothing),
                          {found.share, kCells / std::hypot(found.wave.m, found.wave.n),
                           std::atan2(found.wave.n, found.wave.m) * 180 / M_PI},
                          smoothing == chosen ? "default" : ""});
    if (smoothing == chosen) table.figures.push_back({"largest s at the default", "", found.share, 1e-6});
  }
  return table;
}

}  // namespace sluice::benchmark
