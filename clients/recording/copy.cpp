#include "clients/recording/copy.hpp"

#include <algorithm>

#include "protocol/error.hpp"

namespace sluice::clients {
namespace {

using protocol::InputError;

constexpr std::uint64_t kAtOnce = 256;  // exchanges

class Copying {
 public:
  Copying(const Reader& from, Writer& to) : from_(from), to_(to) {}

  // All up to the damage, then no more.
  void exchanges_up_to(std::uint64_t last) {
    while (done_.exchanges < last) {
      const std::uint64_t count = std::min(kAtOnce, last - done_.exchanges);
      if (exchanges(count)) continue;
      while (exchanges(1)) {
      }
      return;
    }
  }
  bool frame() {
    try {
      to_.write(from_.frame(done_.frames));
    } catch (const InputError&) {
      return false;
    }
    ++done_.frames;
    return true;
  }
  [[nodiscard]] const Extent& done() const { return done_; }

 private:
  bool exchanges(std::uint64_t count) {
    try {
      to_.write(from_.exchange_log(done_.exchanges + 1, static_cast<std::uint32_t>(count)));
    } catch (const InputError&) {
      return false;
    }
    done_.exchanges += count;
    return true;
  }

  const Reader& from_;
  Writer& to_;
  Extent done_;
};

}  // namespace

// A frame comes after the exchanges of its steps.
Extent copy_rows(const Reader& from, Writer& to, const Extent& extent) {
  const bool exchanged = from.scene().body_size() > 0;
  Copying copying(from, to);
  for (std::uint64_t index = 0; index < extent.frames; ++index) {
    const std::uint64_t step = from.frame_header(index).step();
    if (exchanged) copying.exchanges_up_to(std::min(step, extent.exchanges));
    if ((exchanged && copying.done().exchanges < step) || !copying.frame()) {
      to.flush();
      return copying.done();
    }
  }
  copying.exchanges_up_to(extent.exchanges);
  to.flush();
  return copying.done();
}

}  // namespace sluice::clients
