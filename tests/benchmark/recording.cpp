#include "benchmark/recording.hpp"

#include <fmt/format.h>
#include <google/protobuf/text_format.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>

#include "benchmark/report.hpp"
#include "benchmark/speed_scenes.hpp"
#include "clients/sluice/endpoints.hpp"
#include "clients/sluice/process.hpp"
#include "clients/sluice/siblings.hpp"
#include "protocol/error.hpp"
#include "protocol/scene_check.hpp"
#include "protocol/sim_time.hpp"

namespace sluice::benchmark {
namespace {

namespace fs = std::filesystem;

constexpr double kStatedRate = 100;    // frames per simulated second
constexpr double kStatedShare = 0.03;  // of the server's processor time at that rate

// A directory of one benchmark.
class Directory {
 public:
  Directory() {
    std::string pattern = fs::temp_directory_path() / "sluice-bench-XXXXXX";
    path_ = mkdtemp(pattern.data());
  }
  ~Directory() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  Directory(const Directory&) = delete;
  Directory& operator=(const Directory&) = delete;
  [[nodiscard]] fs::path operator/(const char* name) const { return path_ / name; }

 private:
  fs::path path_;
};

// Processor time of all processes that were started here and have ended [s].
double children_seconds() {
  rusage usage{};
  getrusage(RUSAGE_CHILDREN, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

void require_success(clients::Child& child) {
  if (child.wait() == 0) return;
  child.read_output();
  throw std::runtime_error(
      fmt::format("{} failed: {}", child.name(),
                  child.last_lines().empty() ? "it said nothing" : child.last_lines().back()));
}

// Processor time of the server's process over the whole run [s].
double server_seconds(const fs::path& scene, const fs::path& recording, bool is_recorded) {
  const clients::PrivateEndpoint endpoint;
  std::vector<std::string> words{"--scene", scene.string(), "--listen", endpoint.text(), "--threads", "1"};
  if (is_recorded) words.emplace_back("--expect-recorder");
  const double before = children_seconds();
  clients::Child server(clients::sibling("sluice-server"), words);
  std::optional<clients::Child> recorder;
  if (is_recorded)
    recorder.emplace(
        clients::sibling("sluice-record"),
        std::vector<std::string>{"--connect", endpoint.text(), "-o", recording.string(), "--force"});
  require_success(server);
  const double seconds = children_seconds() - before;  // the recorder has not been waited for yet
  if (recorder) require_success(*recorder);
  return seconds;
}

Scene scene_of(const RecordingOptions& options, double rate, double frames) {
  const auto& scenes = all_speed_scenes();
  const auto dam =
      std::find_if(scenes.begin(), scenes.end(), [](const auto& s) { return s.name == "dam_break"; });
  Scene scene = dam->make(options.particles);
  scene.mutable_output()->set_rate(rate);
  scene.set_duration(frames / rate);
  return scene;
}

// Length of the solver's steps [s].
double step_of(const Scene& scene) {
  const Scene full = protocol::with_defaults(scene);
  return full.formulation().courant() * full.formulation().smoothing() * full.spacing() /
         (full.liquid().sound_speed() + full.liquid().max_speed());
}

// With and without take turns at being first.
FrameCost measure(const RecordingOptions& options, double rate, double frames) {
  const Directory directory;
  const Scene scene = scene_of(options, rate, frames);
  const fs::path file = directory / "dam_break.scene";
  std::string text;
  google::protobuf::TextFormat::PrintToString(scene, &text);
  open_output(file.string()) << text << std::flush;

  const auto clock = protocol::StepClock::for_run(scene.duration(), rate, step_of(scene));
  FrameCost cost;
  cost.rate = rate;
  cost.steps = clock.steps();
  cost.frames = clock.steps() / clock.steps_per_interval() + 1;
  for (int pair = 0; pair < options.pairs; ++pair)
    for (const bool is_recorded : {pair % 2 == 0, pair % 2 != 0})
      (is_recorded ? cost.with : cost.without)
          .push_back(server_seconds(file, directory / "run.h5", is_recorded));
  return cost;
}

// The value below which the share `q` of the sorted values lies, by linear interpolation.
double quantile(const std::vector<double>& sorted, double q) {
  const double at = q * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(at);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (at - std::floor(at)) * (sorted[above] - sorted[below]);
}

void print(const FrameCost& cost) {
  const Share share = share_of(cost);
  std::vector<double> alone = cost.without;
  std::sort(alone.begin(), alone.end());
  fmt::print("  {:>12g}{:>9}{:>9}{:>16.3f}{:>16.2f}{:>12.2f}{:>9.2f} to {:<8.2f}\n", cost.rate, cost.frames,
             cost.steps, quantile(alone, 0.5), 1e3 * seconds_per_frame(cost), 100 * share.median,
             100 * share.lower, 100 * share.upper);
  std::fflush(stdout);
}

std::string to_csv(const std::vector<FrameCost>& costs) {
  std::string text = "rate,frames,steps,without_s,with_s\n";
  for (const FrameCost& cost : costs)
    for (std::size_t k = 0; k < cost.with.size(); ++k)
      text += fmt::format("{:g},{},{},{:.6g},{:.6g}\n", cost.rate, cost.frames, cost.steps, cost.without[k],
                          cost.with[k]);
  return text;
}

}  // namespace

Share share_of(const FrameCost& cost) {
  std::vector<double> shares;
  for (std::size_t k = 0; k < cost.with.size(); ++k) shares.push_back(cost.with[k] / cost.without[k] - 1);
  std::sort(shares.begin(), shares.end());
  return {quantile(shares, 0.5), quantile(shares, 0.25), quantile(shares, 0.75)};
}

double seconds_per_frame(const FrameCost& cost) {
  std::vector<double> seconds;
  for (std::size_t k = 0; k < cost.with.size(); ++k)
    seconds.push_back((cost.with[k] - cost.without[k]) / static_cast<double>(cost.frames));
  std::sort(seconds.begin(), seconds.end());
  return quantile(seconds, 0.5);
}

int recording(const RecordingOptions& options) {
  fmt::print("dam_break, {:g} particles, one thread; {} pairs of runs with and without a recorder\n",
             options.particles, options.pairs);
  fmt::print("  {:>12}{:>9}{:>9}{:>16}{:>16}{:>12}{:>12}\n", "frames/s", "frames", "steps", "without [s]",
             "a frame [ms]", "share [%]", "quartiles");
  std::vector<FrameCost> costs;
  costs.push_back(measure(options, kStatedRate, options.quick ? 2 : 10));
  print(costs.back());
  // A frame every step, so that their cost stands out of the noise.
  const double often_rate = 1.01 / step_of(scene_of(options, kStatedRate, 1));
  costs.push_back(measure(options, often_rate, options.quick ? 50 : 300));
  print(costs.back());
  if (!options.csv.empty()) open_output(options.csv) << to_csv(costs) << std::flush;

  if (options.quick) return protocol::kDone;

  // What a frame costs where there are many, over the time that the stated rate leaves for it.
  const FrameCost &stated = costs[0], &often = costs[1];
  std::vector<double> alone = stated.without;
  std::sort(alone.begin(), alone.end());
  const double share = seconds_per_frame(often) * static_cast<double>(stated.frames) / quantile(alone, 0.5);
  const bool holds = share_of(stated).median <= kStatedShare && share <= kStatedShare;
  fmt::print(
      "at {:g} frames/s, by the cost of a frame where every step is one: {:.2f} %; stated at most {:g} %{}\n",
      kStatedRate, 100 * share, 100 * kStatedShare, holds ? "" : "  MISSED");
  return holds ? protocol::kDone : protocol::kBadInput;
}

}  // namespace sluice::benchmark
