#include "clients/recording/size.hpp"

#include <algorithm>
#include <cmath>

#include "clients/recording/layout.hpp"
#include "protocol/array_layout.hpp"

namespace sluice::clients {
namespace {

constexpr std::uint64_t kNumber = 8;                       // bytes of a real or an integer, unless told
constexpr std::uint64_t kTimes = 5;                        // step, time, time_ns, hash, checksum
constexpr std::uint64_t kExchangeTimes = 3;                // step, time_ns, checksum
constexpr std::uint64_t kBoundaryBytes = 3 * kNumber + 4;  // position and body

std::uint64_t row_bytes(const std::vector<layout::Field>& fields) {
  std::uint64_t bytes = 0;
  for (const layout::Field& field : fields)
    bytes += protocol::element_size(field.type) * h5::elements(field.row);
  return bytes;
}

}  // namespace

std::uint64_t most_recorded(const Scene& scene, std::uint64_t fluid_particles) {
  if (!scene.output().has_region()) return fluid_particles;
  const Span& region = scene.output().region();
  double room = 1;  // for particles
  for (int axis = 0; axis < region.max_size(); ++axis) {
    const double low = axis < scene.domain().min_size() ? scene.domain().min(axis) : 0;
    const double length =
        std::min(region.max(axis), scene.domain().max(axis)) - std::max(region.min(axis), low);
    room *= std::max(length, 0.0) / scene.spacing();
  }
  return std::min(fluid_particles, static_cast<std::uint64_t>(std::llround(room)));
}

std::uint64_t recording_bytes(const RunSize& run) {
  const auto bodies = static_cast<hsize_t>(run.scene.body_size());
  const std::uint64_t every = protocol::particles_every(run.scene);
  std::uint64_t frame = row_bytes(layout::frame_fields(bodies, static_cast<hsize_t>(run.scene.probe_size())));
  for (const layout::Observable& observable : layout::observables())
    frame += kNumber * h5::elements(observable.row);
  const std::uint64_t particles = row_bytes(layout::particle_fields(run.scene, run.fluid_particles));
  const std::uint64_t step = bodies == 0 ? 0 : row_bytes(layout::exchange_fields(bodies));
  return run.frames * (frame + kTimes * kNumber) + (run.frames + every - 1) / every * particles +
         run.boundary_particles * kBoundaryBytes +
         (bodies == 0 ? 0 : run.steps * (step + kExchangeTimes * kNumber));
}

}  // namespace sluice::clients
