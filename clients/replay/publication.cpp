#include "clients/replay/publication.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <map>
#include <random>

#include "clients/record/connection.hpp"
#include "clients/replay/line_input.hpp"
#include "clients/replay/playback.hpp"
#include "protocol/endpoint.hpp"
#include "protocol/framing.hpp"
#include "protocol/version.hpp"

namespace sluice::clients {
namespace {

using protocol::Message;
using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr milliseconds kSlice{50};
constexpr milliseconds kStatusEvery{100};

// How the run ended, in the words of the protocol. What only a recorder can say becomes the detail.
End end_of(const Reader& recording) {
  End end;
  End::Reason reason = End::UNKNOWN;
  if (recording.ending() == Ending::kFinished && End::Reason_Parse(recording.reason(), &reason)) {
    end.set_reason(reason);
    end.set_detail(recording.detail());
  } else {
    end.set_detail(fmt::format("the recording ends here ({})", recording.ending() == Ending::kFinished
                                                                   ? recording.reason()
                                                                   : "its recorder did not finish it"));
  }
  end.set_wall_seconds(recording.wall_seconds());
  return end;
}

class Publication {
 public:
  Publication(const Reader& recording, const PublicationOptions& options, const std::atomic<bool>& stop)
      : recording_(recording),
        options_(options),
        stop_(stop),
        endpoint_(protocol::Endpoint::parse(options.endpoint, options.keys.has_value())),
        lock_(endpoint_),
        welcome_(make_welcome()),
        control_(options.control) {
    if (options.keys) {
      authenticator_.emplace(context_, *options.keys);
      for (zmq::socket_t* socket : {&exchange_, &publish_}) authenticator_->secure(*socket);
    }
    protocol::bind(exchange_, endpoint_.exchange);
    protocol::bind(publish_, endpoint_.publish);
  }

  void run() {
    while (options_.wait && !watched_ && !stop_) serve(kSlice);
    start_ = status_at_ = Clock::now();
    playback_.emplace(times(), options_.speed, options_.from, start_);
    // With somebody at the controls the end is not the end.
    while (!stop_ && !playback_->has_quit() && (!playback_->is_at_end() || control_.is_open())) {
      const auto due = playback_->due();
      const auto left = due ? std::chrono::ceil<milliseconds>(*due - Clock::now()) : kSlice;
      serve(std::clamp(left, milliseconds(0), kSlice));
      if (const auto now_due = playback_->due(); now_due && *now_due <= Clock::now()) show(playback_->take());
    }
    publish_status();
    Message end = stamped();
    *end.header.mutable_end() = end_of(recording_);
    if (stop_) {
      end.header.mutable_end()->set_reason(End::INTERRUPTED);
      end.header.mutable_end()->set_detail("the replay was asked to stop");
    }
    protocol::send(publish_, end, "status");
  }

 private:
  [[nodiscard]] Message make_welcome() const {
    Message message = recording_.welcome_message();
    message.header.mutable_welcome()->set_publish_endpoint(endpoint_.publish);
    return message;
  }

  [[nodiscard]] std::vector<std::int64_t> times() const {
    std::vector<std::int64_t> all;
    for (std::uint64_t index = 0; index < recording_.frames(); ++index)
      all.push_back(recording_.frame_header(index).time_ns());
    return all;
  }

  void show(std::uint64_t index) {
    const Message frame = recording_.frame(index);
    step_ = frame.header.step();
    time_ns_ = frame.header.time_ns();
    protocol::send(publish_, frame, "frame");
  }

  void serve(milliseconds timeout) {
    std::vector<zmq::pollitem_t> items{{exchange_.handle(), 0, ZMQ_POLLIN, 0},
                                       {publish_.handle(), 0, ZMQ_POLLIN, 0}};
    if (playback_ && control_.is_open()) items.push_back(control_.poll_item());
    wait_for_any(items, timeout);
    if (items.size() > 2 && items[2].revents != 0) obey();
    zmq::message_t event;
    while (publish_.recv(event, zmq::recv_flags::dontwait))
      watched_ = watched_ || (event.size() > 0 && *event.data<char>() == 1);
    while (answer_next()) {
    }
    if (watched_ && step_ > 0 && Clock::now() - status_at_ > kStatusEvery) publish_status();
  }

  void obey() {
    for (const std::string& line : control_.read()) try {
        playback_->obey(line, Clock::now());
      } catch (const protocol::InputError& error) {
        spdlog::warn("{}", error.what());
      }
  }

  // Anyone can send anything to a socket: what is not a message is dropped.
  bool answer_next() {
    try {
      const auto received = protocol::receive(exchange_);
      if (!received) return false;
      Message reply = answer(received->identity, received->message.header);
      reply.header.set_protocol_version(protocol::kProtocolVersion);
      reply.header.set_run_id(recording_.run_id());
      protocol::send(exchange_, reply, received->identity);
    } catch (const protocol::ProtocolError& error) {
      spdlog::warn("dropped a message: {}", error.what());
    }
    return true;
  }

  Message answer(const std::string& identity, const Header& request) {
    if (request.protocol_version() != protocol::kProtocolVersion)
      return refusal(Refusal::VERSION_MISMATCH,
                     fmt::format("protocol version {} is not {}, this replay's; use programs of one build",
                                 request.protocol_version(), protocol::kProtocolVersion));
    if (request.has_hello()) return greet(identity, request.hello());
    const auto token = tokens_.find(identity);
    if (token == tokens_.end() || token->second != request.session_token() ||
        request.run_id() != recording_.run_id())
      return refusal(Refusal::BAD_TOKEN, "run id and token are not those of a Welcome; say Hello first");
    if (!request.has_heartbeat())
      return refusal(Refusal::BAD_MESSAGE, "watchers send Hello and Heartbeat only");
    Message beat;
    beat.header.mutable_heartbeat();
    beat.header.set_session_token(token->second);
    return beat;
  }

  Message greet(const std::string& identity, const Hello& hello) {
    if (hello.role() != WATCHER)
      return refusal(Refusal::NOT_NEEDED, "this is the replay of a recording; only watchers can join");
    const std::uint64_t fresh = (std::uint64_t{random_()} << 32) | random_();
    Message welcome = welcome_.clone();
    welcome.header.set_session_token(tokens_.try_emplace(identity, fresh).first->second);
    spdlog::info("a watcher joined ({})", hello.program());
    return welcome;
  }

  static Message refusal(Refusal::Code code, const std::string& reason) {
    Message message;
    message.header.mutable_refusal()->set_code(code);
    message.header.mutable_refusal()->set_reason(reason);
    return message;
  }

  [[nodiscard]] Message stamped() const {
    Message message;
    message.header.set_protocol_version(protocol::kProtocolVersion);
    message.header.set_run_id(recording_.run_id());
    message.header.set_step(step_);
    message.header.set_time_ns(time_ns_);
    return message;
  }

  void publish_status() {
    status_at_ = Clock::now();
    const double wall = std::chrono::duration<double>(status_at_ - start_).count();
    Message message = stamped();
    Status& status = *message.header.mutable_status();
    status.set_steps(recording_.welcome().steps());
    status.set_wall_seconds(wall);
    if (wall > 0) status.set_steps_per_second(static_cast<double>(step_) / wall);
    protocol::send(publish_, message, "status");
  }

  const Reader& recording_;
  const PublicationOptions& options_;
  const std::atomic<bool>& stop_;
  protocol::Endpoint endpoint_;
  protocol::EndpointLock lock_;
  zmq::context_t context_;
  std::optional<protocol::Authenticator> authenticator_;  // outlives the sockets
  zmq::socket_t exchange_ = protocol::make_socket(context_, zmq::socket_type::router);
  zmq::socket_t publish_ = protocol::make_socket(context_, zmq::socket_type::xpub);
  Message welcome_;
  LineInput control_;
  std::optional<Playback> playback_;
  std::map<std::string, std::uint64_t> tokens_;
  std::random_device random_;
  bool watched_ = false;
  std::uint64_t step_ = 0;
  std::int64_t time_ns_ = 0;
  Clock::time_point start_, status_at_;
};

}  // namespace

void publish(const Reader& recording, const PublicationOptions& options, const std::atomic<bool>& stop) {
  Publication(recording, options, stop).run();
}

}  // namespace sluice::clients
