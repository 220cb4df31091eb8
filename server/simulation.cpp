#include "server/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "fluid/sampling.hpp"
#include "protocol/body_kind.hpp"
#include "protocol/build_id.hpp"
#include "protocol/liquids.hpp"
#include "protocol/scene_check.hpp"
#include "server/boundary.hpp"
#include "server/build_info.hpp"
#include "server/formulation.hpp"
#include "server/geometry.hpp"
#include "server/liquid.hpp"
#include "server/openings.hpp"

namespace sluice::server {

namespace {

fluid::Tank to_tank(const Domain& domain) {
  fluid::Tank tank{.min = to_vector(domain.min()), .max = to_vector(domain.max())};
  for (const int side : domain.open())
    if (side != SIDE_UNSPECIFIED) tank.closed[static_cast<std::size_t>(side - X_MIN)] = false;
  for (const int axis : domain.periodic()) tank.periodic[static_cast<std::size_t>(axis - X_AXIS)] = true;
  for (const WallMotion& wall : domain.moving())
    tank.velocity[static_cast<std::size_t>(wall.side() - X_MIN)] = to_vector(wall.velocity());
  tank.no_slip = domain.surface() == NO_SLIP;
  return tank;
}

fluid::Period to_period(const fluid::Tank& tank) {
  fluid::Period period{.lower = tank.min, .length = Eigen::Vector3d::Zero()};
  for (int a = 0; a < 3; ++a)
    if (tank.periodic[static_cast<std::size_t>(a)]) period.length[a] = tank.max[a] - tank.min[a];
  return period;
}

// Sides that are mirrors, since that costs less and leaves no trace at the waterline: closed, at rest, not
// sticking and along gravity. The formulations that carry vectors in arrays of their own have no images of
// them; boundary forces are instead of mirrors too.
std::array<bool, 6> mirrored_sides(const Scene& scene, const fluid::Tank& tank, double support) {
  std::array<bool, 6> mirrored{};
  const Formulation& formulation = scene.formulation();
  const std::vector<protocol::LiquidProperties> liquids = protocol::liquids(scene);
  const bool sticks = tank.no_slip && std::any_of(liquids.begin(), liquids.end(),
                                                  [](const auto& liquid) { return liquid.viscosity > 0.0; });
  const bool has_images = formulation.quadrature() == NODAL && formulation.integrator() == KICK_DRIFT_KICK &&
                          formulation.boundary() != FORCES;
  if (sticks || !has_images) return mirrored;
  for (std::size_t side = 0; side < 2 * scene.dimension(); ++side) {
    const auto a = static_cast<Eigen::Index>(side / 2);
    const bool has_opening =
        std::any_of(tank.openings.begin(), tank.openings.end(),
                    [side](const fluid::Opening& opening) { return opening.side == static_cast<int>(side); });
    mirrored[side] = tank.closed[side] && !has_opening && !tank.periodic[side / 2] &&
                     tank.velocity[side].isZero(0) && to_vector(scene.gravity())[a] == 0.0 &&
                     tank.max[a] - tank.min[a] > 3 * support;
  }
  return mirrored;
}

protocol::StepClock make_clock(const Scene& scene, double largest_step) {
  try {
    return protocol::StepClock::for_run(scene.duration(), scene.output().rate(), largest_step);
  } catch (const std::invalid_argument& error) {
    throw protocol::InputError(std::string(error.what()) +
                               "; take a larger spacing or a smaller liquid.sound_speed");
  }
}

void set_liquids(const Scene& scene, fluid::Setup& setup) {
  for (const protocol::LiquidProperties& liquid : protocol::liquids(scene))
    setup.liquids.push_back({liquid.density, liquid.viscosity, liquid.sound_speed});
  setup.liquid =
      *std::max_element(setup.liquids.begin(), setup.liquids.end(),
                        [](const fluid::Liquid& a, const fluid::Liquid& b) { return a.density < b.density; });
  if (setup.liquids.size() == 1) setup.liquids.clear();
  setup.liquid.surface_tension = scene.liquid().surface_tension();
}

}  // namespace

fluid::Setup to_setup(const Scene& scene, int threads) {
  fluid::Setup setup;
  setup.dimension = static_cast<int>(scene.dimension());
  setup.spacing = scene.spacing();
  setup.gravity = to_vector(scene.gravity());
  set_liquids(scene, setup);
  setup.formulation = to_formulation(scene.formulation());
  setup.fluid = fill_liquid(scene);
  setup.threads = threads;
  setup.limit_step_by_bodies = scene.coupling().shorten_steps();

  fluid::Tank tank = to_tank(scene.domain());
  tank.openings = setup.openings = to_openings(scene);
  tank.mirrored = mirrored_sides(scene, tank, kernel_support(setup));
  setup.period = to_period(tank);
  setup.mirrors = {tank.min, tank.max, tank.mirrored};
  setup.walls = wall_boundary(tank, setup);
  for (const Body& body : scene.body()) {
    setup.bodies.push_back(body_boundary(body, setup));
    setup.bodies.back().no_slip = body.surface() == NO_SLIP;
    if (protocol::is_ever_free(body)) setup.bodies.back().free_mass = mass(body, setup.dimension);
  }
  return setup;
}

bool Simulation::has_free_body() const {
  return protocol::is_any_body_ever_free(scene);
}

bool Simulation::is_iterated() const {
  return has_free_body() && coupling.coupling.scheme() == IMPLICIT;
}

std::size_t Simulation::boundary_particles() const {
  std::size_t count = walls.position.size();
  for (const fluid::Boundary& boundary : boundaries) count += boundary.position.size();
  return count;
}

namespace {

std::vector<double> particle_masses(const Scene& scene, double volume) {
  std::vector<double> masses;
  for (const protocol::LiquidProperties& liquid : protocol::liquids(scene))
    masses.push_back(liquid.density * volume);
  return masses;
}

// All but the first forces. The output rate stays that of the whole scene when the run is cut.
Simulation set_up(const Scene& given, int threads, const SolverFactory& factory, double until) {
  Scene scene = protocol::with_defaults(given);
  const double whole_duration = scene.duration();
  if (until > 0) scene.set_duration(until);
  fluid::Setup setup = to_setup(scene, threads);

  std::vector<fluid::Kinematics> bodies;
  for (const Body& body : scene.body()) bodies.push_back(initial_kinematics(body, setup.dimension));
  std::unique_ptr<fluid::Solver> solver = factory(setup);
  const protocol::StepClock clock = make_clock(
      scene, std::min(solver->largest_step(scene.liquid().max_speed()), largest_exchange_step(scene, setup)));
  CouplingPlan coupling = plan_coupling(
      scene, setup, protocol::seconds(clock.interval()) / static_cast<double>(clock.steps_per_interval()));
  std::vector<double> masses = particle_masses(scene, setup.fluid.volume);
  return {.scene = std::move(scene),
          .whole_duration = whole_duration,
          .bodies = std::move(bodies),
          .initial_wrenches = {},
          .resumed = {},
          .solver = std::move(solver),
          .clock = clock,
          .coupling = std::move(coupling),
          .walls = std::move(setup.walls),
          .boundaries = std::move(setup.bodies),
          .fluid_particles = setup.fluid.position.size(),
          .particle_masses = std::move(masses),
          .threads = threads};
}

void keep_wrenches(Simulation& simulation) {
  const std::span<const fluid::Wrench> wrenches = simulation.solver->wrenches();
  simulation.initial_wrenches.assign(wrenches.begin(), wrenches.end());
}

void require_same_program(const Checkpoint& checkpoint) {
  const auto require = [](const std::string& what, const std::string& its, const std::string& mine) {
    if (its != mine)
      throw protocol::InputError(fmt::format(
          "the checkpoint was written by another {} ({}; this one is {}), where the run would not go "
          "on to the last bit; resume it there, or run the scene again",
          what, its.empty() ? "unnamed" : its, mine.empty() ? "unnamed" : mine));
  };
  require("class of processors", checkpoint.processor_class(), processor_class());
  require("build of sluice-server", checkpoint.server_build(), protocol::build_id());
}

void require_same_clock(const Checkpoint& checkpoint, const protocol::StepClock& clock) {
  if (checkpoint.interval_ns() != clock.interval() ||
      checkpoint.steps_per_interval() != clock.steps_per_interval() || !clock.is_output(checkpoint.step()))
    throw protocol::InputError("the checkpoint is damaged: its clock is not that of its scene");
  if (checkpoint.step() >= clock.steps())
    throw protocol::InputError(
        fmt::format("the checkpoint is at {:g} s and the run ends at {:g} s: there is nothing left to do; "
                    "give a later --until",
                    protocol::seconds(checkpoint.time_ns()), protocol::seconds(clock.time(clock.steps()))));
}

}  // namespace

Simulation make_simulation(const Scene& scene, int threads, const SolverFactory& factory, double until) {
  Simulation simulation = set_up(scene, threads, factory, until);
  simulation.solver->start(simulation.bodies);
  keep_wrenches(simulation);
  return simulation;
}

Simulation resume_simulation(protocol::CheckpointFile checkpoint, int threads, const SolverFactory& factory,
                             double until) {
  const Checkpoint& header = checkpoint.header;
  require_same_program(header);
  Simulation simulation = set_up(header.scene(), threads, factory, until);
  require_same_clock(header, simulation.clock);
  try {
    simulation.solver->read_state(checkpoint.fluid);
  } catch (const std::invalid_argument& error) {
    throw protocol::InputError(fmt::format("the checkpoint does not fit its scene: {}", error.what()));
  }
  keep_wrenches(simulation);
  simulation.resumed = {.step = header.step(),
                        .run_id = header.run_id(),
                        .rigid = std::move(checkpoint.rigid),
                        .rigid_build = header.rigid_build()};
  return simulation;
}

}  // namespace sluice::server
