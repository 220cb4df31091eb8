#pragma once

#include <future>

#include "server/run.hpp"
#include "tests/coupling/directory.hpp"
#include "tests/coupling/fake_solver.hpp"
#include "tests/coupling/peer.hpp"
#include "tests/coupling/scenes.hpp"

namespace sluice::testing {

// A server in a thread of this process, with a FakeSolver. Destroying it interrupts a run that still goes on.
class TestServer {
 public:
  explicit TestServer(const Scene& scene, server::Options options = {}, SolverScript given = {})
      : script(std::move(given)), simulation_(server::make_simulation(scene, 1, factory())) {
    start(options);
  }
  TestServer(protocol::CheckpointFile checkpoint, server::Options options)
      : simulation_(server::resume_simulation(std::move(checkpoint), 1, factory())) {
    start(options);
  }
  ~TestServer() {
    interrupted_ = true;
    if (outcome_.valid()) outcome_.wait();
  }

  // Waits for the end of the run.
  server::Outcome outcome() { return outcome_.get(); }
  void interrupt() { interrupted_ = true; }

  [[nodiscard]] const protocol::Endpoint& endpoint() const { return sockets_.endpoint; }
  [[nodiscard]] std::uint64_t steps() const { return simulation_.clock.steps(); }

  SolverScript script;  // to be read after outcome()

 private:
  server::SolverFactory factory() {
    return [this](const fluid::Setup& setup) { return std::make_unique<FakeSolver>(setup, script); };
  }
  void start(server::Options options) {
    options.interrupted = &interrupted_;
    outcome_ = std::async(std::launch::async,
                          [this, options] { return server::run(simulation_, sockets_, options); });
  }

  Directory directory_;
  server::Simulation simulation_;
  server::Sockets sockets_{protocol::Endpoint::parse(directory_.endpoint())};
  std::atomic<bool> interrupted_{false};
  std::future<server::Outcome> outcome_;
};

inline server::Options with_recorder() {
  server::Options options;
  options.expect_recorder = true;
  return options;
}

}  // namespace sluice::testing
