#include "server/coupling.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "protocol/version.hpp"
#include "server/content.hpp"
#include "server/probes.hpp"

namespace sluice::server {

using protocol::Message;
using std::chrono::milliseconds;
using std::chrono::steady_clock;

namespace {

constexpr milliseconds kSlice{100};    // of waiting, after each of which lost peers are looked for
constexpr milliseconds kPollEvery{5};  // between steps
constexpr milliseconds kBeatEvery{1000};
constexpr int kMostMessages = 256;  // dealt with at once: a flood must not keep the run from its deadlines

}  // namespace

std::string late(std::string_view what, milliseconds deadline) {
  return fmt::format("{} within {:g} s", what, std::chrono::duration<double>(deadline).count());
}

Coupling::Coupling(const Simulation& simulation, Sockets& sockets, const Options& options)
    : simulation_(simulation),
      sockets_(sockets),
      options_(options),
      bodies_(simulation.bodies.size()),
      lock_step_(simulation.has_free_body()),
      is_iterated_(simulation.is_iterated()),
      owners_(simulation),
      session_(
          sockets.exchange, {.owners = owners_.names(), .recorder = options.expect_recorder},
          [this](const Session::Seat& seat) {
            Message message = welcome(simulation_, sockets_.endpoint, seat.role, seat.owner);
            if (seat == Session::Seat(RIGID) && lock_step_)
              message.header.mutable_welcome()->set_wants_state(has_checkpoints());
            return message;
          },
          simulation.resumed.run_id),
      log_(bodies_),
      recorder_(sockets.record),
      checkpoints_(options.checkpoint, simulation, options.expect_recorder),
      publisher_(sockets.publish),
      progress_(simulation.resumed.step),
      step_(simulation.resumed.step) {}

void Coupling::wait_for_participants() {
  service(milliseconds(0));  // who is waiting already is taken in even when nobody is needed
  wait_until([this] { return session_.complete(); }, options_.start_deadline,
             [this] {
               for (const std::string& owner : owners_.names())
                 if (const Session::Seat seat(RIGID, owner); !session_.present(seat))
                   return Stop(End::PARTICIPANT_TIMEOUT,
                               late(name_of(seat) + " did not join", options_.start_deadline));
               return Stop(End::RECORDER_LOST, late("the recorder did not join", options_.start_deadline));
             });
  session_.begin();
  progress_ = Progress(step_);
  if (checkpoints_.wanted() && owners_.has_others())
    spdlog::warn("no checkpoints will be written: bodies have owners, who do not give their state");
  else if (checkpoints_.wanted() && lock_step_ && !gives_state_)
    spdlog::warn("no checkpoints will be written: the rigid process does not give its state");
}

std::uint64_t Coupling::exchange_end(std::uint64_t first) {
  if (!lock_step_) return first;
  wait_for_kinematics(first);
  return owners_.of("").last_step();
}

void Coupling::wait_for_kinematics(std::uint64_t step) {
  wait_until([&] { return owners_.late_with(step) == nullptr; }, options_.deadline,
             [&] {
               const std::string who = name_of({RIGID, *owners_.late_with(step)});
               const std::string what = fmt::format("{} sent no kinematics of step {}", who, step);
               return Stop(End::PARTICIPANT_TIMEOUT, late(what, options_.deadline));
             });
}

std::span<const fluid::Kinematics> Coupling::kinematics(std::uint64_t step) {
  if (bodies_ == 0) return {};
  wait_for_kinematics(step);
  owners_.take(step);
  return owners_.kinematics();
}

void Coupling::answer(std::uint64_t step, std::span<const double> indicators) {
  step_ = step;
  indicators_.assign(indicators.begin(), indicators.end());
  if (bodies_ == 0) return;
  const std::span<const fluid::Wrench> wrenches = simulation_.solver->wrenches();
  if (options_.expect_recorder)
    log_.add(step, owners_.rows(), wrenches, simulation_.solver->wrench_parts(), owners_.ledger(),
             indicators);
  send(owners_.answer(step, wrenches, probes()));
}

void Coupling::send(std::vector<Owners::Reply> replies) {
  for (Owners::Reply& reply : replies) {
    stamp(reply.message.header);
    session_.send({RIGID, reply.owner}, std::move(reply.message));
  }
}

Owners::Probes Coupling::probes() const {
  return [this] { return probe_rows(simulation_, owners_.rows()); };
}

bool Coupling::repeats() {
  if (is_iterated_) {
    const Exchange& exchange = owners_.of("");
    wait_until([&] { return exchange.is_decided(); }, options_.deadline,
               [&] {
                 const std::string what = fmt::format(
                     "the rigid process neither accepted nor repeated the exchange up to step {}", step_);
                 return Stop(End::PARTICIPANT_TIMEOUT, late(what, options_.deadline));
               });
    if (exchange.is_repeated()) {
      log_.drop();
      return true;
    }
    accepted_ = exchange.accepted();
    send(owners_.answer_others(step_, simulation_.solver->wrenches(), probes()));
  }
  log_.accept(is_iterated_ ? accepted_.iterations() : 1, accepted_.residual());
  if (log_.full()) record_log();
  return false;
}

void Coupling::output(std::uint64_t step) {
  publisher_.update();
  const bool published = publisher_.wanted("frame");
  if (!published && !options_.expect_recorder) return;
  Message message = frame(simulation_, step, owners_.rows());
  stamp(message.header);
  ++outcome_.frames_serialised;
  count(message);
  if (published) publisher_.publish("frame", message);
  record_log();
  record(std::move(message));
}

void Coupling::poll() {
  if (steady_clock::now() - polled_ < kPollEvery) return;
  service(milliseconds(0));
  session_.heartbeat(kBeatEvery);
}

void Coupling::end(Outcome& outcome) {
  ending_ = true;
  session_.finish();
  outcome.steps = step_;
  outcome.frames_serialised = outcome_.frames_serialised;
  outcome.messages_serialised = outcome_.messages_serialised;
  outcome.bytes_serialised = outcome_.bytes_serialised;
  const auto message = [&] {
    Message end_message = server::end(step_, outcome.reason, outcome.detail, progress_.wall_seconds());
    stamp(end_message.header);
    return end_message;
  };
  bring_to_recorder(outcome, [this] { record_log(); });
  write_last_checkpoint(outcome);
  bring_to_recorder(outcome, [&] { record(message()); });
  if (outcome.reason == End::RECORDER_LOST) {
    outcome.detail += fmt::format("; {} messages up to step {} are recorded", recorder_.acknowledged(),
                                  recorder_.acknowledged_step());
  }
  for (const std::string& owner : owners_.names()) session_.send({RIGID, owner}, message());
  publisher_.update();
  publish_status();  // where the run has come to, however short it was
  publisher_.publish("status", message());
}

void Coupling::wait_until(const std::function<bool()>& done, milliseconds deadline,
                          const std::function<Stop()>& fail) {
  const auto limit = steady_clock::now() + deadline;
  while (!done()) {
    if (steady_clock::now() > limit) throw fail();
    service(std::min(kSlice, deadline));
    session_.heartbeat(kSlice);
  }
}

void Coupling::service(milliseconds timeout) {
  polled_ = steady_clock::now();
  zmq::pollitem_t items[] = {{sockets_.exchange.handle(), 0, ZMQ_POLLIN, 0},
                             {sockets_.publish.handle(), 0, ZMQ_POLLIN, 0}};
  try {
    zmq::poll(items, std::size(items), timeout);
  } catch (const zmq::error_t& error) {
    if (error.num() != EINTR) throw;  // a signal: looked at next
  }
  if (!ending_ && options_.interrupted != nullptr && options_.interrupted->load()) {
    throw Stop(End::INTERRUPTED, fmt::format("by a signal after step {}", step_));
  }
  const auto handle = [this](const Session::Inbound& inbound) { dispatch(inbound); };
  for (int i = 0; i < kMostMessages && session_.serve(handle); ++i) {
  }
  publisher_.update();
  if (progress_.due()) publish_status();
}

void Coupling::dispatch(const Session::Inbound& inbound) {
  const Header& header = inbound.message.header;
  const Session::Seat& seat = inbound.seat;
  try {
    if (header.has_hello()) {
      if (seat.role != RIGID) return;
      owners_.join(seat.owner, header.hello().probes());
      if (!seat.owner.empty()) return;
      rigid_state_ = {};
      gives_state_ = header.hello().gives_state();
    } else if (seat.role == RIGID && header.has_kinematics()) {
      std::optional<Message> reply = owners_.of(seat.owner).accept(inbound.message);
      if (!reply) return;
      stamp(reply->header);
      session_.send(seat, std::move(*reply));
    } else if (seat.role == RIGID && header.has_accepted()) {
      owners_.of(seat.owner).accept_exchange(header.accepted());
    } else if (seat == Session::Seat(RIGID) && header.has_state()) {
      take_state(inbound.message);
    } else if (seat.role == RECORDER && header.has_acknowledgement()) {
      recorder_.acknowledge(header.acknowledgement().sequence());
    } else {
      throw Refused(Refusal::BAD_MESSAGE,
                    fmt::format("message content {} is not for the role {} to send",
                                static_cast<int>(header.content_case()), Role_Name(seat.role)));
    }
  } catch (const Refused& refused) {
    session_.refuse(seat, refused);
  }
}

void Coupling::publish_status() {
  const double rate = progress_.rate(step_);
  if (!publisher_.wanted("status")) return;
  Message message = status(step_, simulation_.clock.steps(), progress_.wall_seconds(), rate);
  if (lock_step_)
    message.header.mutable_status()->mutable_indicator()->Assign(indicators_.begin(), indicators_.end());
  stamp(message.header);
  count(message);
  publisher_.publish("status", message);
}

void Coupling::stamp(Header& header) const {
  header.set_protocol_version(protocol::kProtocolVersion);
  header.set_run_id(session_.run_id());
  header.set_time_ns(simulation_.clock.time(header.step()));
}

}  // namespace sluice::server
