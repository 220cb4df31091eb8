#pragma once

#include <functional>
#include <memory>

#include "fluid/solver.hpp"
#include "protocol/checkpoint_file.hpp"
#include "protocol/sim_time.hpp"
#include "scene.pb.h"
#include "server/stability.hpp"

namespace sluice::server {

// What the solver needs, from a scene with its defaults filled in. Throws SceneError (see fill_liquid).
fluid::Setup to_setup(const Scene& scene, int threads);

// Where a run goes on that was stopped.
struct Resumption {
  std::uint64_t step = 0;  // done before; 0: the run starts
  std::string run_id;
  std::vector<double> rigid;  // the bodies' state, and the program that can read it; empty where none is free
  std::string rigid_build;
};

// A scene ready to run: the solver has computed the forces at time 0, or of the last step that is done.
struct Simulation {
  Scene scene;                            // with its defaults
  double whole_duration = 0;              // of a run that is to be cut short [s]
  std::vector<fluid::Kinematics> bodies;  // at time 0
  std::vector<fluid::Wrench> initial_wrenches;
  Resumption resumed;
  std::unique_ptr<fluid::Solver> solver;
  protocol::StepClock clock;
  CouplingPlan coupling;
  // What watchers and the recorder are told of the setup.
  fluid::Boundary walls;
  std::vector<fluid::Boundary> boundaries;
  std::size_t fluid_particles = 0;
  // Of every liquid, at zero pressure [kg], per metre of depth in 2D.
  std::vector<double> particle_masses;
  int threads = 1;

  // Whether a body moves by the fluid's forces, so that the rigid process needs every answer.
  [[nodiscard]] bool has_free_body() const;
  // Whether exchanges with them are repeated until they agree.
  [[nodiscard]] bool is_iterated() const;
  [[nodiscard]] std::size_t boundary_particles() const;
};

using SolverFactory = std::function<std::unique_ptr<fluid::Solver>(const fluid::Setup&)>;

// A run of the scene up to `until` [s]; 0: its duration. Throws SceneError when the scene cannot be set up,
// InputError when its steps would be too short.
Simulation make_simulation(const Scene& scene, int threads, const SolverFactory& factory = fluid::make_solver,
                           double until = 0);

// Goes on from a checkpoint, likewise. Throws InputError when this program cannot, or when it would end
// before.
Simulation resume_simulation(protocol::CheckpointFile checkpoint, int threads,
                             const SolverFactory& factory = fluid::make_solver, double until = 0);

}  // namespace sluice::server
