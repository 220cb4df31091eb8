#include "benchmark/speed_run.hpp"

#include <malloc.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <fstream>
#include <string>

#include "fluid/cell_grid.hpp"
#include "validation/support/scene_run.hpp"

namespace sluice::benchmark {

namespace {

// Memory of the process [bytes], without what earlier runs have given back.
double resident() {
  malloc_trim(0);
  std::ifstream statm("/proc/self/statm");
  double pages = 0, resident_pages = 0;
  statm >> pages >> resident_pages;
  return resident_pages * static_cast<double>(sysconf(_SC_PAGESIZE));
}

// The most memory since forget_most() [bytes], and that from now on; where the kernel keeps no account, 0.
void forget_most() {
  std::ofstream("/proc/self/clear_refs") << 5;
}
double most_resident() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("VmHWM:")) return 1024.0 * std::stod(line.substr(6));
  return 0;
}

// Floating-point operations a pair in both sweeps, a multiply-add counting as two, roots and divisions as
// one: counted in gradient_lanes.cpp and force_lanes.cpp.
double operations_per_pair(int dimension) {
  return dimension == 2 ? 45 + 63 : 71 + 102;
}

template <int Dim>
double mean_neighbors(const fluid::Snapshot& state, double support) {
  const std::size_t count = state.density.size();
  std::vector<fluid::Node<Dim>> nodes(count);
  for (std::size_t i = 0; i < count; ++i)
    nodes[i].x = fluid::narrow<Dim>(Eigen::Map<const Eigen::Vector3d>(&state.position[3 * i]));
  fluid::CellGrid<Dim> cells(nodes, support);
  cells.file(nodes);
  double pairs = 0;
  for (const fluid::Node<Dim>& node : nodes) {
    const fluid::Vec<Dim> low = node.x.array() - support, high = node.x.array() + support;
    cells.for_rows_in(low, high, [&](std::uint32_t first, std::uint32_t last) {
      for (std::uint32_t k = first; k < last; ++k)
        if ((nodes[cells.item()[k]].x - node.x).squaredNorm() < support * support) ++pairs;
    });
  }
  return pairs / static_cast<double>(count) - 1.0;
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// Steps until that many particle steps are done; the seconds that took.
double advance(validation::SceneRun& run, double particle_steps, double particles) {
  const auto steps = static_cast<std::uint64_t>(std::ceil(particle_steps / particles));
  const auto start = std::chrono::steady_clock::now();
  for (std::uint64_t k = 0; k < steps; ++k) run.next_step();
  return seconds_since(start) / static_cast<double>(steps);
}

fluid::StageTimes difference(const fluid::StageTimes& a, const fluid::StageTimes& b) {
  return {a.search - b.search, a.boundary - b.boundary,   a.gradients - b.gradients,
          a.forces - b.forces, a.reactions - b.reactions, a.steps - b.steps};
}

}  // namespace

SpeedRow run_for_speed(const SpeedScene& scene, double particles, int threads, const SpeedEffort& effort,
                       double peak) {
  const double before = resident();
  forget_most();
  const auto start = std::chrono::steady_clock::now();
  validation::SceneRun run(scene.make(particles), threads);
  const double start_up = seconds_since(start);
  const auto count = static_cast<double>(run.masses().size());
  advance(run, effort.warm_up, count);
  const fluid::StageTimes until_then = run.solver().stage_times();
  const double seconds = advance(run, effort.timed, count);
  SpeedRow row{.scene = scene.name, .particles = run.masses().size(), .threads = threads};
  row.stages = difference(run.solver().stage_times(), until_then);
  row.bytes = (resident() - before) / count;
  row.most_bytes = (most_resident() - before) / count;
  row.start = start_up / seconds;
  row.rate = count / seconds;
  const double h = run.scene().formulation().smoothing() * run.scene().spacing();
  const fluid::Snapshot state = run.solver().snapshot();
  row.neighbors = scene.dimension == 2 ? mean_neighbors<2>(state, 2 * h) : mean_neighbors<3>(state, 2 * h);
  row.share = row.rate * row.neighbors * operations_per_pair(scene.dimension) / (peak * threads);
  return row;
}

}  // namespace sluice::benchmark
