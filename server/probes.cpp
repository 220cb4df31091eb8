#include "server/probes.hpp"

#include <array>
#include <cmath>

#include "fluid/probe.hpp"
#include "server/geometry.hpp"
#include "server/kinematics_rows.hpp"

namespace sluice::server {
namespace {

using Row = std::array<double, kProbeRow>;

class Probes {
 public:
  Probes(const Simulation& simulation, std::span<const double> kinematics)
      : simulation_(simulation),
        kinematics_(kinematics),
        state_(simulation.solver->snapshot()),
        fluid_{state_, simulation.particle_masses,
               simulation.scene.formulation().smoothing() * simulation.scene.spacing(),
               static_cast<int>(simulation.scene.dimension())} {}

  Row row(const Probe& probe) const {
    if (probe.has_point()) return point(probe.point());
    if (probe.has_surface()) return surface(probe.surface());
    if (probe.has_flow()) return flow(probe.flow());
    return force(probe.force());
  }

 private:
  // Index of the scene's body of that name; the checks have seen that there is one.
  [[nodiscard]] std::size_t index(const std::string& name) const {
    std::size_t b = 0;
    while (simulation_.scene.body(static_cast<int>(b)).name() != name) ++b;
    return b;
  }

  [[nodiscard]] fluid::Kinematics now(std::size_t body) const {
    return read_kinematics(kinematics_.subspan(body * kKinematicsRow, kKinematicsRow));
  }

  // Where a point is now that is at x at time 0 and moves with a body; the same without a body.
  [[nodiscard]] Eigen::Vector3d moved(const Eigen::Vector3d& x, const std::string& body) const {
    if (body.empty()) return x;
    const std::size_t b = index(body);
    const fluid::Kinematics& start = simulation_.bodies[b];
    const fluid::Kinematics here = now(b);
    return here.position + here.orientation * (start.orientation.conjugate() * (x - start.position));
  }

  [[nodiscard]] Row point(const PointProbe& probe) const {
    const fluid::PointSample sample =
        fluid::sample_point(fluid_, moved(to_vector(probe.position()), probe.body()));
    const Eigen::Vector3d& v = sample.velocity;
    return {sample.pressure, v.x(), v.y(), v.z(), sample.wetness, 0};
  }

  [[nodiscard]] Row surface(const SurfaceProbe& probe) const {
    Eigen::Vector3d up = -to_vector(simulation_.scene.gravity());
    if (up.norm() == 0) up = Eigen::Vector3d::Unit(fluid_.dimension - 1);
    up.normalize();
    const double height = fluid::surface_height(fluid_, moved(to_vector(probe.position()), probe.body()), up);
    return std::isfinite(height) ? Row{height, 1} : Row{};
  }

  [[nodiscard]] Row force(const ForceProbe& probe) const {
    const std::size_t b = index(probe.body());
    const fluid::Wrench wrench = simulation_.solver->wrenches()[b];
    const Eigen::Vector3d arm = now(b).position - to_vector(probe.about());
    const Eigen::Vector3d moment = wrench.moment + arm.cross(wrench.force);
    return {wrench.force.x(), wrench.force.y(), wrench.force.z(), moment.x(), moment.y(), moment.z()};
  }

  [[nodiscard]] Row flow(const FlowProbe& probe) const {
    int o = 0;
    while (simulation_.scene.opening(o).name() != probe.opening()) ++o;
    const fluid::Passage passage = simulation_.solver->diagnostics().openings[static_cast<std::size_t>(o)];
    return {passage.rate, passage.mass_in, passage.mass_out, 0, 0, 0};
  }

  const Simulation& simulation_;
  std::span<const double> kinematics_;
  fluid::Snapshot state_;
  fluid::ProbedFluid fluid_;
};

}  // namespace

std::vector<double> probe_rows(const Simulation& simulation, std::span<const double> kinematics) {
  const Probes probes(simulation, kinematics);
  std::vector<double> rows;
  for (const Probe& probe : simulation.scene.probe()) {
    const Row row = probes.row(probe);
    rows.insert(rows.end(), row.begin(), row.end());
  }
  return rows;
}

}  // namespace sluice::server
