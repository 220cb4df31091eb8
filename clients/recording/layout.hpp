#pragma once

#include <string>
#include <vector>

#include "clients/recording/hdf5.hpp"
#include "protocol/frame_layout.hpp"

// Names and shapes in a recording; README.md describes them.
namespace sluice::clients::layout {

// Raised by any change that an older reader would misread. Bodies are of format 3, what the scene's output
// selects of 2, other recordings of 1 still.
inline constexpr int kFormat = 3;
inline bool selects(const Scene& scene) {
  const bool is_whole = !protocol::particles_vary(scene) && protocol::particle_arrays(scene).size() == 4;
  return !is_whole || scene.output().precision() == FLOAT32 || protocol::particles_every(scene) != 1;
}
inline int format_of(const Scene& scene) {
  if (scene.body_size() > 0) return 3;
  return selects(scene) ? 2 : 1;
}
inline constexpr const char* kCreator = "sluice";

inline constexpr const char* kRunning = "running";
inline constexpr std::size_t kReasonLength = 64;
inline constexpr std::size_t kDetailLength = 1024;

inline constexpr const char* kFrameStep = "/frames/step";
inline constexpr const char* kFrameTime = "/frames/time";
inline constexpr const char* kParticleStep = "/particles/fluid/position/step";
inline constexpr const char* kParticleTime = "/particles/fluid/position/time";
inline constexpr const char* kFrameTimeNs = "/frames/time_ns";
inline constexpr const char* kFrameHash = "/frames/hash";
inline constexpr const char* kProbes = "/observables/probe";
// Over step, time_ns, hash and the energies of the frame.
inline constexpr const char* kFrameChecksum = "/frames/checksum";
// Over step, time_ns, kinematics and wrenches of the step.
inline constexpr const char* kExchangeChecksum = "/exchange/checksum";
inline constexpr const char* kExchangeStep = "/exchange/step";
inline constexpr const char* kExchangeTimeNs = "/exchange/time_ns";

// One array of a message and the dataset that holds it.
struct Field {
  std::string array;
  std::string dataset;
  h5::Shape row;  // of one particle set, or of one step
  std::string unit;
  Array::Type type = Array::FLOAT64;
};

inline std::string unit_of(ParticleField field) {
  switch (field) {
    case POSITION:
      return "m";
    case VELOCITY:
      return "m s-1";
    case DENSITY:
      return "kg m-3";
    case PRESSURE:
      return "Pa";
    default:
      return "";
  }
}

// Arrays of the particles in a Frame, in the order of the message, where it has some.
inline std::vector<Field> particle_fields(const Scene& scene, hsize_t particles) {
  std::vector<Field> fields;
  for (const protocol::ParticleArray& array : protocol::particle_arrays(scene)) {
    h5::Shape row{particles};
    if (array.components > 1) row.push_back(array.components);
    fields.push_back(
        {array.name, "/particles/" + array.name + "/value", row, unit_of(array.field), array.type});
  }
  return fields;
}

// Its other arrays, behind those. The hash of a frame is over all of them in this order.
inline std::vector<Field> frame_fields(hsize_t bodies, hsize_t probes) {
  std::vector<Field> fields{{"body/kinematics", "/frames/kinematics", {bodies, 19}, ""},
                            {"body/wrench", "/frames/wrench", {bodies, 6}, ""}};
  if (probes > 0) fields.push_back({"probe", std::string(kProbes) + "/value", {probes, 6}, ""});
  return fields;
}

// Arrays of an ExchangeLog, a row a step, all float64. Before format 3 ledgers had contact and joints in one,
// and nothing told of stability.
inline std::vector<Field> exchange_fields(hsize_t bodies, int format = kFormat) {
  std::vector<Field> fields{
      {"kinematics", "/exchange/kinematics", {bodies, 19}, ""},
      {"wrenches", "/exchange/wrenches", {bodies, 6}, ""},
      {"coupling", "/exchange/coupling", {bodies > 0 ? hsize_t{2} : hsize_t{0}}, ""},
      {"wrench_parts", "/exchange/wrench_parts", {bodies, 12}, ""},
      {"ledger", "/exchange/ledger", {bodies, format < 3 ? hsize_t{15} : hsize_t{29}}, ""}};
  if (format >= 3) fields.push_back({"indicator", "/exchange/indicator", {bodies}, ""});
  return fields;
}

// A field of Energy; the dataset is /observables/energy/<name>/value.
struct Observable {
  std::string name;
  h5::Shape row;
  std::string unit;
};

inline std::vector<Observable> observables() {
  return {{"kinetic", {}, "J"},
          {"potential", {}, "J"},
          {"elastic", {}, "J"},
          {"momentum", {3}, "kg m s-1"},
          {"angular_momentum", {3}, "kg m2 s-1"},
          {"boundary_work", {}, "J"},
          {"max_speed", {}, "m s-1"},
          {"max_compression", {}, ""}};
}

inline std::string energy_group(const Observable& observable) {
  return "/observables/energy/" + observable.name;
}

}  // namespace sluice::clients::layout
