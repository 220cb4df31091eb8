#include "clients/replay/comparison.hpp"

#include <fmt/format.h>

#include <array>
#include <cstring>

#include "clients/recording/element.hpp"
#include "clients/recording/energy.hpp"
#include "protocol/frame_layout.hpp"

namespace sluice::clients {
namespace {

using protocol::Message;

template <typename T>
bool same_bits(T a, T b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

constexpr std::array<const char*, 19> kKinematics = {"position x",
                                                     "position y",
                                                     "position z",
                                                     "orientation w",
                                                     "orientation x",
                                                     "orientation y",
                                                     "orientation z",
                                                     "velocity x",
                                                     "velocity y",
                                                     "velocity z",
                                                     "angular velocity x",
                                                     "angular velocity y",
                                                     "angular velocity z",
                                                     "acceleration x",
                                                     "acceleration y",
                                                     "acceleration z",
                                                     "angular acceleration x",
                                                     "angular acceleration y",
                                                     "angular acceleration z"};
constexpr std::array<const char*, 6> kWrench = {"force x",  "force y",  "force z",
                                                "moment x", "moment y", "moment z"};

std::string component(std::size_t i) {
  return std::string(1, "xyz"[i % 3]);
}

// What the k-th element of an array is. Arrays of bodies have a row for each, in a log a block of rows a
// step.
std::string element(const Message& message, const Array& array, std::size_t k, const Scene& scene) {
  const auto width = static_cast<std::size_t>(array.shape(array.shape_size() - 1));
  if (array.name().starts_with("fluid/")) {
    const std::size_t row = array.shape_size() == 2 ? k / width : k;
    const auto particle = message.has_array(protocol::kParticleId)
                              ? message.array<std::int64_t>(protocol::kParticleId)[row]
                              : static_cast<std::int64_t>(row);
    const std::string what =
        array.shape_size() == 2 ? fmt::format("{} {}", array.name(), component(k)) : array.name();
    return fmt::format("{} of particle {}", what, particle);
  }
  const auto bodies = static_cast<std::size_t>(scene.body_size());
  const std::size_t row = k / width;
  const std::string& body = scene.body(static_cast<int>(row % bodies)).name();
  if (array.name() == "coupling")
    return fmt::format("{} of the exchange of step {}", k % 2 == 0 ? "iterations" : "residual",
                       message.header.exchange_log().first_step() + k / 2);
  if (array.name() == "wrench_parts")
    return fmt::format("{} {} of body {} at step {}", k % width < 6 ? "viscous" : "penetration",
                       kWrench[k % 6], scene.body(static_cast<int>(row % bodies)).name(),
                       message.header.exchange_log().first_step() + row / bodies);
  if (array.name() == "ledger")
    return fmt::format("ledger of body {} at step {}", scene.body(static_cast<int>(row % bodies)).name(),
                       message.header.exchange_log().first_step() + row / bodies);
  if (array.name() == "indicator")
    return fmt::format("stability indicator of body {} at step {}",
                       scene.body(static_cast<int>(k % bodies)).name(),
                       message.header.exchange_log().first_step() + k / bodies);
  const char* name = width == kWrench.size() ? kWrench[k % width] : kKinematics.at(k % width);
  if (!message.header.has_exchange_log()) return fmt::format("{} of body {}", name, body);
  return fmt::format("{} of body {} at step {}", name, body,
                     message.header.exchange_log().first_step() + row / bodies);
}

std::optional<std::string> array_difference(const Message& recorded, const Message& now, int i,
                                            const Scene& scene) {
  const Array& a = recorded.header.array(i);
  const Array& b = now.header.array(i);
  if (a.SerializeAsString() != b.SerializeAsString())
    return fmt::format("array {}: recorded {}, now {}", i, a.ShortDebugString(), b.ShortDebugString());
  return with_element(a.type(), [&]<typename T>(T /*element*/) -> std::optional<std::string> {
    const auto before = recorded.array<T>(a.name()), after = now.array<T>(a.name());
    for (std::size_t k = 0; k < before.size(); ++k)
      if (!same_bits(before[k], after[k]))
        return fmt::format("{}: recorded {}, now {}", element(recorded, a, k, scene), before[k], after[k]);
    return std::nullopt;
  });
}

std::optional<std::string> energy_difference(const Energy& recorded, const Energy& now) {
  const auto* descriptor = Energy::descriptor();
  for (int i = 0; i < descriptor->field_count(); ++i) {
    const std::string& name = descriptor->field(i)->name();
    const auto before = energy_values(recorded, name, 3);
    const auto after = energy_values(now, name, 3);
    for (std::size_t k = 0; k < before.size(); ++k) {
      if (!same_bits(before[k], after[k]))
        return fmt::format("energy {}: recorded {}, now {}", name, before[k], after[k]);
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::string> first_difference(const Message& recorded, const Message& now, const Scene& scene) {
  if (recorded.header.step() != now.header.step())
    return fmt::format("step: recorded {}, now {}", recorded.header.step(), now.header.step());
  if (recorded.header.time_ns() != now.header.time_ns())
    return fmt::format("time: recorded {} ns, now {} ns", recorded.header.time_ns(), now.header.time_ns());
  if (recorded.header.array_size() != now.header.array_size())
    return fmt::format("arrays: recorded {}, now {}", recorded.header.array_size(), now.header.array_size());
  for (int i = 0; i < recorded.header.array_size(); ++i)
    if (auto difference = array_difference(recorded, now, i, scene)) return difference;
  if (!recorded.header.has_frame()) return std::nullopt;
  return energy_difference(recorded.header.frame().energy(), now.header.frame().energy());
}

}  // namespace sluice::clients
