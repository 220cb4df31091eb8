#include "clients/recording/size.hpp"

#include "clients/recording/layout.hpp"

namespace sluice::clients {
namespace {

constexpr std::uint64_t kNumber = 8;                       // bytes of a real or an integer
constexpr std::uint64_t kTimes = 5;                        // step, time, time_ns, hash, checksum
constexpr std::uint64_t kExchangeTimes = 3;                // step, time_ns, checksum
constexpr std::uint64_t kBoundaryBytes = 3 * kNumber + 4;  // position and body

std::uint64_t row_bytes(const std::vector<layout::Field>& fields) {
  std::uint64_t numbers = 0;
  for (const layout::Field& field : fields) numbers += h5::elements(field.row);
  return kNumber * numbers;
}

}  // namespace

std::uint64_t recording_bytes(const RunSize& run) {
  std::uint64_t frame = row_bytes(layout::frame_fields(run.fluid_particles, run.bodies, run.probes));
  for (const layout::Observable& observable : layout::observables())
    frame += kNumber * h5::elements(observable.row);
  const std::uint64_t step = run.bodies == 0 ? 0 : row_bytes(layout::exchange_fields(run.bodies));
  return run.frames * (frame + kTimes * kNumber) + run.boundary_particles * kBoundaryBytes +
         (run.bodies == 0 ? 0 : run.steps * (step + kExchangeTimes * kNumber));
}

}  // namespace sluice::clients
