#include <gtest/gtest.h>

#include "fluid/model.hpp"
#include "tests/unit/fluid/clouds.hpp"
#include "tests/unit/fluid/setups.hpp"

namespace sluice::fluid {
namespace {

using Eigen::Vector3d;

// A disordered block of compressed water without dissipation.
template <int Dim>
Scene compressed_block() {
  Scene scene(Dim, 0.1, 0.0, 20.0);
  scene.setup.gravity.setZero();
  scene.setup.formulation.quadrature = Quadrature::stress_points;
  scene.setup.formulation.artificial_viscosity = 0;
  scene.setup.formulation.density_diffusion = 0;
  std::mt19937_64 random(5);
  for (const Vec<Dim>& x : jittered_lattice<Dim>(Dim == 2 ? 9 : 6, 0.1, 0.1, random))
    scene.add_particle(widen<Dim>(x), Vector3d::Zero(), 1000.0 * (2.0 + random_vector<Dim>(random)[0]));
  return scene;
}

template <int Dim>
struct Cloud {
  using Kernel = WithStressPoints<WendlandC2<Dim>>;

  explicit Cloud(const Scene& scene) : model(scene.setup), V(scene.setup.fluid.volume) {
    for (const Vector3d& position : scene.setup.fluid.position) x.push_back(narrow<Dim>(position));
    for (const double p : scene.setup.fluid.pressure) rho.push_back(model.eos.density(p));
  }

  [[nodiscard]] double weight(std::size_t j, const Vec<Dim>& at) const {
    return V * model.kernel.value(Vec<Dim>(x[j] - at));
  }
  [[nodiscard]] Fit<Dim> fit_at(const Vec<Dim>& at) const {
    Moments<Dim> m;
    for (std::size_t j = 0; j < x.size(); ++j) m.add(weight(j, at), x[j] - at);
    return fit(m, model.moment_floor);
  }

  // CF (46) and (49) as they stand: forces on all particles, from the fits at every stress point over all
  // particles. Spray has the density of its particle.
  [[nodiscard]] std::vector<Vec<Dim>> forces() const {
    std::vector<Vec<Dim>> force(x.size(), Vec<Dim>::Zero());
    for (std::size_t parent = 0; parent < x.size(); ++parent)
      for (const Vec<Dim>& offset : model.points) {
        const Vec<Dim> at = x[parent] + offset;
        const Fit<Dim> f = fit_at(at);
        double rho_s = 0;
        for (std::size_t j = 0; j < x.size(); ++j)
          rho_s += weight(j, at) * (shape_constant(f) + f.g.dot(x[j] - at)) * rho[j];
        if (f.floored || fit_at(x[parent]).floored) rho_s = rho[parent];
        const double pV = model.eos.pressure(rho_s) * V / static_cast<double>(model.points.size());
        for (std::size_t i = 0; i < x.size(); ++i) force[i] += pV * weight(i, at) * (f.g + f.G * (x[i] - at));
      }
    return force;
  }

  Model<Dim, Kernel> model;
  double V;
  std::vector<Vec<Dim>> x;
  std::vector<double> rho;
};

template <int Dim>
void expect_forces_by_definition() {
  const Scene scene = compressed_block<Dim>();
  const auto solver = make_solver(scene.setup);
  solver->start({});
  const double dt = 1e-7 * solver->largest_step(1.0);
  solver->step(dt, {});
  const Snapshot s = solver->snapshot();
  const std::vector<Vec<Dim>> force = Cloud<Dim>(scene).forces();
  const std::vector<double> masses = scene.masses();
  double largest = 0, worst = 0;
  for (std::size_t i = 0; i < force.size(); ++i) {
    const Vec<Dim> acceleration = narrow<Dim>(Eigen::Map<const Vector3d>(&s.velocity[3 * i])) / dt;
    largest = std::max(largest, force[i].norm());
    worst = std::max(worst, (masses[i] * acceleration - force[i]).norm());
  }
  EXPECT_GT(largest, 0.0);
  EXPECT_LT(worst, 1e-5 * largest);
}

TEST(StressPoints, ForcesAreThoseOfTheDefinitionInThePlane) {
  expect_forces_by_definition<2>();
}
TEST(StressPoints, ForcesAreThoseOfTheDefinitionInSpace) {
  expect_forces_by_definition<3>();
}

}  // namespace
}  // namespace sluice::fluid
