#include "server/run.hpp"

#include <fmt/format.h>

#include "server/guard.hpp"

namespace sluice::server {

namespace {

// Steps between looks at every particle: a copy of the state costs about a hundredth of a step.
constexpr std::uint64_t kGuardEvery = 8;

void advance(Simulation& simulation, Coupling& coupling) {
  const protocol::StepClock& clock = simulation.clock;
  fluid::Solver& solver = *simulation.solver;
  const Guard guard(simulation.scene);

  coupling.output(0);
  for (std::uint64_t step = 1; step <= clock.steps(); ++step) {
    const std::span<const fluid::Kinematics> bodies = coupling.kinematics(step);
    solver.step(protocol::seconds(clock.duration(step)), bodies);

    const double time = protocol::seconds(clock.time(step));
    guard.check(solver.wrenches(), time);
    if (step % kGuardEvery == 0 || clock.is_output(step)) guard.check(solver.snapshot(), time);

    coupling.answer(step);
    if (clock.is_output(step)) coupling.output(step);
    coupling.poll();
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
