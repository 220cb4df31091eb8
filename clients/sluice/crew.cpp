#include "clients/sluice/crew.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <csignal>

#include "clients/sluice/siblings.hpp"
#include "protocol/error.hpp"

namespace sluice::clients {
namespace {

using std::chrono::seconds;
using std::chrono::steady_clock;

// A participant notices a lost server within 10 s, a server a lost participant within its deadline (4 s).
constexpr seconds kPatience{15};
constexpr seconds kLastPatience{20};
constexpr std::size_t kReportedLines = 12;

int as_exit_code(int code) {
  return code >= 0 && code <= 3 ? code : protocol::kProcessFailed;
}

std::string how_it_ended(int code) {
  return code > 128 ? fmt::format("ended by signal {}", code - 128) : fmt::format("exit code {}", code);
}

}  // namespace

void Crew::start(const std::string& program, const std::vector<std::string>& arguments) {
  children_.push_back(std::make_unique<Child>(sibling(program), arguments));
}

void Crew::add_outputs(std::vector<zmq::pollitem_t>& items) const {
  for (const auto& child : children_)
    if (child->output() >= 0) items.push_back({nullptr, child->output(), ZMQ_POLLIN, 0});
}

void Crew::read_outputs() {
  for (const auto& child : children_) child->read_output(on_line_);
}

bool Crew::all_ended() {
  return std::ranges::all_of(children_, [](auto& child) { return child->exit_code().has_value(); });
}

void Crew::signal_all(int number) {
  for (const auto& child : children_) child->signal(number);
}

void Crew::interrupt() {
  if (interrupts_++ == 0)
    children_.front()->signal(SIGINT);
  else
    signal_all(SIGKILL);
}

bool Crew::someone_ended_badly() {
  return std::ranges::any_of(children_, [](auto& child) { return child->exit_code().value_or(0) != 0; });
}

void Crew::stop_stragglers() {
  Child& server = *children_.front();
  const bool out_of_order = server.exit_code() || someone_ended_badly();
  const auto now = steady_clock::now();
  if (!out_of_order) return;
  if (alone_since_ == Instant{}) alone_since_ = now;
  if (now - alone_since_ > kLastPatience) {
    signal_all(SIGKILL);
  } else if (now - alone_since_ > kPatience && !server_stopped_) {
    server_stopped_ = !server.exit_code();
    signal_all(SIGTERM);
  }
}

int Crew::exit_code() {
  const int servers = as_exit_code(children_.front()->wait());
  if (servers != protocol::kDone && !server_stopped_) return servers;
  for (const auto& child : children_)
    if (child != children_.front() && child->wait() != 0) return as_exit_code(child->wait());
  return servers;
}

std::string Crew::failure_report() {
  std::string report;
  if (interrupts_ > 0) return report;  // the user knows why they ended
  for (const auto& child : children_) {
    const int code = child->wait();
    if (code == 0) continue;
    report += fmt::format("{}: {}; its last lines:\n", child->name(), how_it_ended(code));
    const auto& lines = child->last_lines();
    const std::size_t skipped = lines.size() - std::min(lines.size(), kReportedLines);
    for (std::size_t k = skipped; k < lines.size(); ++k) report += "  " + lines[k] + "\n";
  }
  return report;
}

}  // namespace sluice::clients
