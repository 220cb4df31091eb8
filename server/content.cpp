#include "server/content.hpp"

#include "protocol/body_kind.hpp"
#include "protocol/frame_layout.hpp"
#include "server/build_info.hpp"
#include "server/kinematics_rows.hpp"
#include "server/particle_arrays.hpp"
#include "server/probes.hpp"

namespace sluice::server {

using protocol::Message;

namespace {

void add_points(Message& message, std::string_view name, const std::vector<Eigen::Vector3d>& points) {
  std::vector<double> flat;
  flat.reserve(3 * points.size());
  for (const Eigen::Vector3d& x : points) flat.insert(flat.end(), {x.x(), x.y(), x.z()});
  message.add_array<double>(name, flat, {points.size(), 3});
}

void add_boundaries(Message& message, const Simulation& simulation) {
  add_points(message, "wall/position", simulation.walls.position);
  std::vector<Eigen::Vector3d> positions;
  std::vector<std::int32_t> bodies;
  for (std::size_t b = 0; b < simulation.boundaries.size(); ++b) {
    const std::vector<Eigen::Vector3d>& points = simulation.boundaries[b].position;
    positions.insert(positions.end(), points.begin(), points.end());
    bodies.insert(bodies.end(), points.size(), static_cast<std::int32_t>(b));
  }
  add_points(message, "boundary/position", positions);
  message.add_array<std::int32_t>("boundary/body", bodies, {bodies.size()});
}

void add_wrenches(Message& message, std::string_view name, std::span<const fluid::Wrench> wrenches) {
  std::vector<double> rows;
  for (const fluid::Wrench& wrench : wrenches) append(rows, wrench);
  message.add_array<double>(name, rows, {wrenches.size(), kWrenchRow});
}

// What a participant is told of the bodies that it moves. Who is not `sluice rigid` takes part step by step.
void add_own(Message& message, const Simulation& simulation, const std::string& owner) {
  Welcome& content = *message.header.mutable_welcome();
  std::vector<fluid::Wrench> wrenches;
  for (const int b : protocol::bodies_of(simulation.scene, owner)) {
    content.add_body(static_cast<std::uint32_t>(b));
    wrenches.push_back(simulation.initial_wrenches[static_cast<std::size_t>(b)]);
  }
  add_wrenches(message, "wrenches", wrenches);
  if (owner.empty() || !content.has_coupling()) return;
  content.mutable_coupling()->set_scheme(EXPLICIT);
  content.mutable_coupling()->set_steps_per_exchange(1);
}

void add_probes(Message& message, const Simulation& simulation, std::span<const double> kinematics) {
  const std::vector<double> rows = probe_rows(simulation, kinematics);
  message.add_array<double>("probe", rows, {rows.size() / kProbeRow, kProbeRow});
}

void fill_energy(Energy& energy, const fluid::Diagnostics& diagnostics) {
  energy.set_kinetic(diagnostics.kinetic);
  energy.set_potential(diagnostics.potential);
  energy.set_elastic(diagnostics.elastic);
  energy.set_boundary_work(diagnostics.boundary_work);
  energy.set_max_speed(diagnostics.max_speed);
  energy.set_max_compression(diagnostics.max_compression);
  for (int a = 0; a < 3; ++a) {
    energy.add_momentum(diagnostics.momentum[a]);
    energy.add_angular_momentum(diagnostics.angular_momentum[a]);
  }
}

}  // namespace

Message welcome(const Simulation& simulation, const protocol::Endpoint& endpoint, Role role,
                const std::string& owner) {
  Message message;
  Welcome& content = *message.header.mutable_welcome();
  *content.mutable_scene() = simulation.scene;
  content.set_interval_ns(simulation.clock.interval());
  content.set_steps_per_interval(simulation.clock.steps_per_interval());
  content.set_steps(simulation.clock.steps());
  content.set_fluid_particles(simulation.fluid_particles);
  content.set_boundary_particles(simulation.boundary_particles());
  *content.mutable_build() = build_info(simulation.threads);
  content.set_publish_endpoint(endpoint.publish);
  content.set_record_endpoint(endpoint.record);
  content.set_sound_speed(simulation.scene.liquid().sound_speed());
  content.set_particle_mass(simulation.particle_masses[0]);
  if (simulation.has_free_body()) {
    *content.mutable_coupling() = simulation.coupling.coupling;
    for (const BodyStability& body : simulation.coupling.stability) *content.add_stability() = body;
  }
  const Resumption& resumed = simulation.resumed;
  content.set_done(resumed.step);
  if (role == RIGID) {
    add_own(message, simulation, owner);
    if (simulation.scene.probe_size() > 0) {
      std::vector<double> rows;
      for (const fluid::Kinematics& body : simulation.bodies) append(rows, body);
      add_probes(message, simulation, rows);
    }
    if (resumed.step > 0 && simulation.has_free_body() && owner.empty()) {
      message.add_array<double>("state", resumed.rigid, {resumed.rigid.size()});
      content.set_state_build(resumed.rigid_build);
    }
  } else {
    add_boundaries(message, simulation);
  }
  return message;
}

Message frame(const Simulation& simulation, std::uint64_t step, std::span<const double> kinematics) {
  Message message;
  message.header.set_step(step);
  const std::uint64_t index = step / simulation.clock.steps_per_interval();
  if (protocol::has_particles(simulation.scene, index))
    add_particles(message, simulation.scene, simulation.solver->snapshot());
  message.add_array<double>("body/kinematics", kinematics,
                            {kinematics.size() / kKinematicsRow, kKinematicsRow});
  add_wrenches(message, "body/wrench", simulation.solver->wrenches());

  if (simulation.scene.probe_size() > 0) add_probes(message, simulation, kinematics);

  Frame& content = *message.header.mutable_frame();
  content.set_index(index);
  content.set_hash(message.hash_arrays());
  fill_energy(*content.mutable_energy(), simulation.solver->diagnostics());
  return message;
}

Message status(std::uint64_t step, std::uint64_t steps, double wall_seconds, double steps_per_second) {
  Message message;
  message.header.set_step(step);
  Status& content = *message.header.mutable_status();
  content.set_steps(steps);
  content.set_wall_seconds(wall_seconds);
  content.set_steps_per_second(steps_per_second);
  return message;
}

Message end(std::uint64_t step, End::Reason reason, const std::string& detail, double wall_seconds) {
  Message message;
  message.header.set_step(step);
  End& content = *message.header.mutable_end();
  content.set_reason(reason);
  content.set_detail(detail);
  content.set_wall_seconds(wall_seconds);
  return message;
}

}  // namespace sluice::server
