#include "clients/sluice/session.hpp"

#include <fmt/core.h>
#include <spdlog/spdlog.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <iostream>

#include "clients/recording/reader.hpp"
#include "clients/sluice/not_computed.hpp"
#include "protocol/body_kind.hpp"
#include "protocol/sim_time.hpp"

namespace sluice::clients {
namespace {

constexpr std::chrono::milliseconds kSlice{100};
constexpr std::chrono::milliseconds kLastNews{500};

std::size_t terminal_columns() {
  winsize size{};
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

std::optional<protocol::ClientKeys> client_keys(const std::filesystem::path& directory) {
  if (directory.empty()) return std::nullopt;
  return protocol::ClientKeys::load(directory);
}

// The server's last words, in case that its End did not arrive: "[sluice-server] status: REASON - detail".
std::string last_status(const Child& server) {
  constexpr std::string_view mark = "status: ";
  for (auto line = server.last_lines().rbegin(); line != server.last_lines().rend(); ++line)
    if (const auto at = line->find(mark); at != std::string::npos) return line->substr(at + mark.size());
  return "UNKNOWN - the server ended without a status";
}

}  // namespace

Session::Session(const RunOptions& options, const std::string& endpoint)
    : options_(options),
      endpoint_(endpoint),
      link_(context_, protocol::Endpoint::parse(endpoint, !options.keys.empty()), client_keys(options.keys),
            options.output.empty()),
      progress_(std::cerr, isatty(STDERR_FILENO) != 0, terminal_columns()),
      crew_([this](const std::string& line) {
        if (!options_.verbose) return;
        progress_.clear();
        std::cerr << line << '\n';
      }) {
  summary_.file = (options.resume.empty() ? options.check.scene : options.resume).string();
}

std::vector<std::string> Session::connection() const {
  std::vector<std::string> arguments{"--connect", endpoint_};
  if (!options_.keys.empty()) arguments.insert(arguments.end(), {"--keys", options_.keys.string()});
  return arguments;
}

void Session::start_server() {
  std::vector<std::string> arguments{"--listen", endpoint_};
  const auto add = [&](const char* option, const std::string& value) {
    arguments.insert(arguments.end(), {option, value});
  };
  if (options_.resume.empty())
    add("--scene", options_.check.scene.string());
  else
    add("--resume", options_.resume.string());
  for (const std::string& override : options_.check.overrides) add("--set", override);
  if (options_.until) add("--until", fmt::format("{}", *options_.until));
  if (options_.threads > 0) add("--threads", std::to_string(options_.threads));
  if (!options_.output.empty()) {
    arguments.emplace_back("--expect-recorder");
    add("--checkpoint", checkpoint_of(options_.output).string());
    if (options_.checkpoint_every > 0)
      add("--checkpoint-every", fmt::format("{}", options_.checkpoint_every));
  }
  if (!options_.keys.empty()) add("--keys", options_.keys.string());
  crew_.start("sluice-server", arguments);
}

// Only now: a server that refuses its scene or endpoint leaves no trace of a recording.
void Session::start_participants(const Welcome& welcome) {
  const protocol::StepClock clock(welcome.interval_ns(), welcome.steps_per_interval(), welcome.steps());
  summary_.scene = welcome.scene().name();
  summary_.dimension = welcome.scene().dimension();
  summary_.fluid_particles = welcome.fluid_particles();
  summary_.boundary_particles = welcome.boundary_particles();
  summary_.steps = welcome.steps();
  summary_.step = summary_.done_before = welcome.done();
  summary_.duration = protocol::seconds(clock.time(welcome.steps()));
  summary_.not_computed = not_computed(welcome.scene(), !options_.output.empty());

  if (!options_.output.empty()) {
    auto arguments = connection();
    arguments.insert(arguments.end(), {"-o", options_.output.string()});
    if (options_.force) arguments.emplace_back("--force");
    if (!options_.recording.empty())
      arguments.insert(arguments.end(), {"--resume", options_.recording.string()});
    crew_.start("sluice-record", arguments);
    summary_.recording = options_.output.string();
  }
  for (const std::string& owner : protocol::owners(welcome.scene())) {
    if (owner.empty())
      crew_.start("sluice-rigid", connection());
    else
      std::cerr << fmt::format("[sluice] waiting for '{}', the owner of bodies, to join at {}\n", owner,
                               endpoint_);
  }
}

void Session::wait_for_news() {
  std::vector<zmq::pollitem_t> items{link_.greeting_poll(), link_.news_poll()};
  crew_.add_outputs(items);
  try {
    zmq::poll(items, kSlice);
  } catch (const zmq::error_t& error) {
    if (error.num() != EINTR) throw;
  }
}

void Session::note(const Header& header) {
  summary_.step = header.step();
  summary_.time = protocol::seconds(header.time_ns());
  if (header.has_status()) {
    summary_.wall_seconds = header.status().wall_seconds();
    progress_.show({summary_.time, summary_.duration, header.step(), header.status().steps(),
                    header.status().steps_per_second()});
  } else if (header.has_frame()) {
    if (header.frame().index() == 0) summary_.start = header.frame().energy();
    summary_.end = header.frame().energy();
  } else if (header.has_end()) {
    summary_.status = End::Reason_Name(header.end().reason());
    summary_.detail = header.end().detail();
    summary_.wall_seconds = header.end().wall_seconds();
  }
}

void Session::take_news() {
  if (const auto welcome = link_.welcome()) start_participants(*welcome);
  while (const auto header = link_.news()) note(*header);
}

// After the last process has ended: what is still on its way, and what the recording says.
void Session::conclude() {
  crew_.read_outputs();
  std::vector<zmq::pollitem_t> items{link_.news_poll()};
  while (summary_.status.empty() && zmq::poll(items, kLastNews) > 0)
    while (const auto header = link_.news()) note(*header);
  progress_.clear();

  if (summary_.status.empty()) {
    const std::string words = last_status(crew_.server());
    const auto dash = words.find(" - ");
    summary_.status = words.substr(0, dash);
    if (dash != std::string::npos) summary_.detail = words.substr(dash + 3);
  }
  summary_.exit_code = crew_.exit_code();
  if (!summary_.recording.empty()) read_recording();
}

void Session::read_recording() {
  try {
    summary_.recording_bytes = std::filesystem::file_size(summary_.recording);
    const Reader recording(summary_.recording);
    if (recording.frames() == 0) return;
    summary_.start = recording.frame_header(0).frame().energy();
    summary_.end = recording.frame_header(recording.frames() - 1).frame().energy();
  } catch (const std::filesystem::filesystem_error&) {
    summary_.recording.clear();  // the recorder wrote nothing
  } catch (const protocol::InputError& error) {
    spdlog::warn("{}", error.what());
  }
}

Summary Session::follow() {
  start_server();
  while (!crew_.all_ended()) {
    wait_for_news();
    crew_.read_outputs();
    take_news();
    for (int fresh = interrupts_.take(); fresh > 0; --fresh) crew_.interrupt();
    crew_.stop_stragglers();
  }
  conclude();
  return summary_;
}

}  // namespace sluice::clients
