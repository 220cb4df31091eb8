#include "benchmark/speed.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "benchmark/peak.hpp"
#include "benchmark/plot.hpp"
#include "benchmark/report.hpp"
#include "benchmark/selection.hpp"
#include "benchmark/speed_run.hpp"
#include "protocol/error.hpp"

namespace sluice::benchmark {

namespace {

// What is compared with a baseline; more columns follow.
constexpr const char* kColumns = "scene,particles,threads,rate,neighbors,share,bytes,growth";

// Share of the time of a step that each stage takes, by its column.
std::vector<std::pair<std::string, double>> stage_shares(const fluid::StageTimes& t) {
  const double known = t.search + t.boundary + t.gradients + t.forces + t.reactions;
  std::vector<std::pair<std::string, double>> shares{{"search", t.search},       {"boundary", t.boundary},
                                                     {"gradients", t.gradients}, {"forces", t.forces},
                                                     {"reactions", t.reactions}, {"passes", t.steps - known}};
  for (auto& [name, share] : shares) share /= t.steps;
  return shares;
}

const SpeedRow* find_like(const std::vector<SpeedRow>& rows, const SpeedRow& row) {
  const auto found = std::find_if(rows.begin(), rows.end(), [&](const SpeedRow& other) {
    return other.scene == row.scene && other.particles == row.particles && other.threads == row.threads;
  });
  return found == rows.end() ? nullptr : &*found;
}

void print(const SpeedRow& row, const std::vector<SpeedRow>& baseline) {
  fmt::print("  {:>10}{:>9}{:>22.3f}{:>12.1f}{:>15.1f}{:>9.1f}{:>16.0f}{:>9.0f}{:>9.1f}{:>9.2f}",
             row.particles, row.threads, 1e-6 * row.rate, row.neighbors, 1e-6 * row.rate * row.neighbors,
             100 * row.share, row.bytes, row.most_bytes, row.start, row.growth);
  if (const SpeedRow* before = find_like(baseline, row)) fmt::print("{:>9.2f}", row.rate / before->rate);
  fmt::print("\n{:>19}", "");
  for (const auto& [stage, share] : stage_shares(row.stages)) fmt::print(" {} {:.0f} %", stage, 100 * share);
  fmt::print("\n");
  std::fflush(stdout);
}

void run_case(const SpeedScene& scene, const SpeedOptions& options, double peak,
              const std::vector<SpeedRow>& baseline, std::vector<SpeedRow>& rows) {
  fmt::print("{}: {}\n  {:>10}{:>9}{:>22}{:>12}{:>15}{:>9}{:>16}{:>9}{:>9}{:>9}{}\n", scene.name, scene.title,
             "particles", "threads", "10^6 particle steps/s", "neighbours", "10^6 pairs/s", "% peak",
             "bytes/particle", "at most", "start", "growth", baseline.empty() ? "" : "  times baseline");
  std::vector<double> sizes = options.particles.empty() ? scene.particles : options.particles;
  if (options.quick) sizes.resize(1);
  const SpeedEffort effort = options.quick ? SpeedEffort{1e6, 1e6} : SpeedEffort{2e7, 2e7};
  for (const int threads : options.threads) {
    double first = 0;
    for (const double particles : sizes) {
      SpeedRow row = run_for_speed(scene, particles, threads, effort, peak);
      if (first == 0) first = row.rate;
      row.growth = first / row.rate;
      print(row, baseline);
      rows.push_back(row);
    }
  }
}

}  // namespace

std::string to_csv(const std::vector<SpeedRow>& rows) {
  std::string text = kColumns;
  text += ",start,most_bytes";
  for (const auto& [stage, share] : stage_shares({})) text += "," + stage;
  for (const SpeedRow& r : rows) {
    text += fmt::format("\n{},{},{},{:.6g},{:.4g},{:.4g},{:.4g},{:.4g}", r.scene, r.particles, r.threads,
                        r.rate, r.neighbors, r.share, r.bytes, r.growth);
    text += fmt::format(",{:.4g},{:.4g}", r.start, r.most_bytes);
    for (const auto& [stage, share] : stage_shares(r.stages)) text += fmt::format(",{:.4g}", share);
  }
  return text + "\n";
}

std::vector<SpeedRow> read_speed_csv(const std::string& path) {
  std::ifstream file(path);
  std::string line;
  if (!std::getline(file, line) || !line.starts_with(kColumns))
    throw protocol::InputError(
        fmt::format("{}: not a table of `sluice bench speed --csv`: its first line must begin with '{}'",
                    path, kColumns));
  std::vector<SpeedRow> rows;
  for (int number = 2; std::getline(file, line); ++number) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream fields(line);
    SpeedRow r;
    if (!(fields >> r.scene >> r.particles >> r.threads >> r.rate >> r.neighbors >> r.share >> r.bytes >>
          r.growth))
      throw protocol::InputError(fmt::format("{}:{}: cannot be read as '{}'", path, number, kColumns));
    rows.push_back(r);
  }
  return rows;
}

int speed(const SpeedOptions& options) {
  const auto scenes = select(all_speed_scenes(), options.cases, "case");
  std::vector<SpeedRow> baseline, rows;
  if (!options.baseline.empty()) baseline = read_speed_csv(options.baseline);
  std::ofstream csv;
  if (!options.csv.empty()) csv = open_output(options.csv);
  const double peak = measure_peak();
  fmt::print("peak of one core: {:.1f} GFLOP/s in double precision\n\n", 1e-9 * peak);
  for (const SpeedScene& scene : scenes) run_case(scene, options, peak, baseline, rows);
  if (csv.is_open()) csv << to_csv(rows) << std::flush;
  if (!options.plot.empty()) plot("plot_speed.py", to_csv(rows), options.plot);
  return protocol::kDone;
}

}  // namespace sluice::benchmark
