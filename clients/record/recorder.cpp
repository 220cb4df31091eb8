#include "clients/record/recorder.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "clients/record/connection.hpp"
#include "clients/recording/continuation.hpp"
#include "clients/recording/xdmf.hpp"
#include "protocol/framing.hpp"

namespace sluice::clients {
namespace {

using protocol::Message;
using protocol::PeerLost;
using protocol::ProtocolError;
using std::chrono::milliseconds;

constexpr milliseconds kSlice{100};
constexpr int kMostPerFlush = 64;   // messages; the server waits when as many are not acknowledged
constexpr int kLastMessages = 200;  // [ms] for what a lost server has still sent

class Interrupted : public std::exception {};

class Recorder {
 public:
  Recorder(const RecordOptions& options, const std::atomic<bool>& stop)
      : options_(options),
        stop_(stop),
        endpoint_(protocol::Endpoint::parse(options.endpoint, options.keys.has_value())),
        connection_(context_, endpoint_, options.keys),
        stream_(protocol::make_socket(context_, zmq::socket_type::pull)) {}

  RecordOutcome run() {
    if (options_.resume.empty()) {
      OutputFile output(options_.output, options_.force);
      connection_.greet(RECORDER, "sluice-record");
      const Message welcome = wait_for_welcome();
      require_start(welcome.header.welcome());
      writer_.emplace(std::move(output), welcome);
    } else {
      connection_.greet(RECORDER, "sluice-record");
      continuation_.emplace(options_.resume, options_.output, options_.force, wait_for_welcome());
    }
    connect_stream();
    spdlog::info("recording run {} to {}", connection_.run_id(), options_.output.string());
    try {
      while (!end_) turn();
    } catch (const Interrupted&) {
      finish("interrupted", "the recorder was asked to stop");
    } catch (const PeerLost& lost) {
      finish_without_server(lost.what());
    } catch (const ProtocolError& error) {
      finish("protocol error", error.what());
    }
    return outcome_;
  }

 private:
  Message wait_for_welcome() {
    while (true) {
      if (stop_) throw ProtocolError("stopped before the server answered");
      zmq::pollitem_t item = connection_.poll_item();
      wait_for_any({&item, 1}, kSlice);
      if (auto message = connection_.receive()) {
        if (message->header.has_welcome()) return std::move(*message);
        throw ProtocolError(fmt::format(
            "the server at {} answered the greeting with something else than a Welcome", options_.endpoint));
      }
      connection_.watch(options_.patience);
    }
  }

  static void require_start(const Welcome& welcome) {
    if (welcome.done() == 0) return;
    throw protocol::InputError(fmt::format(
        "the run goes on after step {}; name its recording so far with --resume", welcome.done()));
  }

  // Only now: what the server pushes goes to whoever is connected, also to a recorder that it refuses.
  void connect_stream() {
    if (options_.keys) options_.keys->secure(stream_);
    stream_.connect(endpoint_.record);
  }

  void turn() {
    if (stop_) throw Interrupted();
    zmq::pollitem_t items[] = {{stream_.handle(), 0, ZMQ_POLLIN, 0}, connection_.poll_item()};
    wait_for_any(items, kSlice);
    take_in(0);
    if (end_) return;
    while (connection_.receive()) {
    }
    connection_.watch();
  }

  // Writes what waits in the stream, flushes once, then acknowledges the last. Waits `patience` ms for each.
  bool take_in(int patience) {
    const std::uint64_t before = sequence_;
    for (int i = 0; i < kMostPerFlush && !end_; ++i) {
      auto received = protocol::receive_within(stream_, patience);
      if (!received) break;
      connection_.hear();
      take(received->message);
    }
    if (sequence_ == before) return false;
    if (end_) {
      finish(End::Reason_Name(end_->reason()), end_->detail(), end_->wall_seconds());
      outcome_.complete = true;
    } else {
      writer().flush();
    }
    Message acknowledgement;
    acknowledgement.header.mutable_acknowledgement()->set_sequence(sequence_);
    connection_.send(std::move(acknowledgement));
    return true;
  }

  void take(const Message& message) {
    const Header& header = message.header;
    if (header.run_id() != connection_.run_id())
      throw ProtocolError(fmt::format("a message of run \"{}\" came in the stream of run {}", header.run_id(),
                                      connection_.run_id()));
    if (header.sequence() != sequence_ + 1)
      throw ProtocolError(fmt::format("message {} came, expected {}", header.sequence(), sequence_ + 1));
    if (header.has_end()) {
      end_ = header.end();
    } else {
      if (continuation_) continuation_->take_place();
      writer().write(message);
    }
    sequence_ = header.sequence();
  }

  // What the server sent before it went is recorded; it may be the end of the run.
  void finish_without_server(const std::string& why) {
    try {
      while (!end_ && take_in(kLastMessages)) {
      }
    } catch (const PeerLost&) {  // nobody takes acknowledgements any more
    }
    if (!end_) finish("server lost", why);
  }

  void finish(const std::string& reason, const std::string& detail, double wall_seconds = 0) {
    outcome_.reason = reason;
    outcome_.detail = detail;
    if (continuation_ && !continuation_->is_in_place()) return continuation_->abandon();
    writer().finish(reason, detail, wall_seconds);
    try {
      write_xdmf(options_.output);
    } catch (const std::exception& error) {
      spdlog::warn("the recording has no companion for ParaView: {}", error.what());
    }
  }

  Writer& writer() { return continuation_ ? continuation_->writer() : *writer_; }

  const RecordOptions& options_;
  const std::atomic<bool>& stop_;
  protocol::Endpoint endpoint_;
  zmq::context_t context_;
  Connection connection_;
  zmq::socket_t stream_;
  // One of the two.
  std::optional<Writer> writer_;
  std::optional<Continuation> continuation_;
  std::optional<End> end_;
  std::uint64_t sequence_ = 0;
  RecordOutcome outcome_;
};

}  // namespace

RecordOutcome record(const RecordOptions& options, const std::atomic<bool>& stop) {
  return Recorder(options, stop).run();
}

}  // namespace sluice::clients
