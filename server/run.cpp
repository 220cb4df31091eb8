#include "server/run.hpp"

#include <fmt/format.h>

#include "server/guard.hpp"
#include "server/stability_watch.hpp"

namespace sluice::server {

namespace {

// Steps between looks at every particle: a copy of the state costs about a hundredth of a step.
constexpr std::uint64_t kGuardEvery = 8;

// The steps from `first` to the next time the rigid process is heard, which is returned; again and again
// where that asks for it.
std::uint64_t exchange(Simulation& simulation, Coupling& coupling, const Guard& guard, StabilityWatch& watch,
                       std::uint64_t first) {
  const protocol::StepClock& clock = simulation.clock;
  fluid::Solver& solver = *simulation.solver;
  if (simulation.is_iterated()) solver.save();
  watch.save();
  while (true) {
    const std::uint64_t last = coupling.exchange_end(first);
    for (std::uint64_t step = first; step <= last; ++step) {
      const std::span<const fluid::Kinematics> bodies = coupling.kinematics(step);
      solver.step(protocol::seconds(clock.duration(step)), bodies);
      const double time = protocol::seconds(clock.time(step));
      guard.check(solver.wrenches(), time);
      if (step % kGuardEvery == 0 || clock.is_output(step)) guard.check(solver.snapshot(), time);
      if (watch.is_due(step, clock)) watch.look(solver.snapshot().position, bodies, time);
      coupling.answer(step, watch.indicators());
    }
    if (!coupling.repeats()) {
      watch.note(coupling.accepted(), protocol::seconds(clock.time(last)));
      return last;
    }
    solver.restore();
    watch.restore();
  }
}

StabilityWatch make_watch(const Simulation& simulation) {
  std::vector<std::optional<WetSurface>> surfaces;
  for (std::size_t b = 0; b < simulation.boundaries.size(); ++b)
    surfaces.push_back(wet_surface(simulation.scene, b, simulation.boundaries[b]));
  const protocol::StepClock& clock = simulation.clock;
  return {simulation.scene, simulation.coupling, std::move(surfaces),
          protocol::seconds(clock.interval()) / static_cast<double>(clock.steps_per_interval())};
}

void advance(Simulation& simulation, Coupling& coupling) {
  const protocol::StepClock& clock = simulation.clock;
  const Guard guard(simulation.scene);
  StabilityWatch watch = make_watch(simulation);

  const std::uint64_t done = simulation.resumed.step;
  if (done == 0) coupling.output(0);
  for (std::uint64_t first = done + 1; first <= clock.steps();) {
    const std::uint64_t last = exchange(simulation, coupling, guard, watch, first);
    if (clock.is_output(last)) {
      coupling.output(last);
      coupling.checkpoint(last);
    }
    coupling.poll();
    first = last + 1;
  }
}

}  // namespace

Outcome run(Simulation& simulation, Sockets& sockets, const Options& options) {
  Coupling coupling(simulation, sockets, options);
  Outcome outcome;
  try {
    coupling.wait_for_participants();
    advance(simulation, coupling);
    const std::uint64_t steps = simulation.clock.steps();
    outcome.reason = End::FINISHED;
    outcome.detail =
        fmt::format("{} steps, {:g} s simulated", steps, protocol::seconds(simulation.clock.time(steps)));
  } catch (const Stop& stop) {
    outcome.reason = stop.reason();
    outcome.detail = stop.what();
  } catch (const std::exception& error) {  // ours: the run cannot go on, but everyone is told
    outcome.detail = fmt::format("internal error: {}", error.what());
  }
  coupling.end(outcome);
  return outcome;
}

}  // namespace sluice::server
