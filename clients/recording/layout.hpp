#pragma once

#include <string>
#include <vector>

#include "clients/recording/hdf5.hpp"

// Names and shapes in a recording; README.md describes them.
namespace sluice::clients::layout {

// Raised by any change that an older reader would misread.
inline constexpr int kFormat = 1;
inline constexpr const char* kCreator = "sluice";

inline constexpr const char* kRunning = "running";
inline constexpr std::size_t kReasonLength = 64;
inline constexpr std::size_t kDetailLength = 1024;

inline constexpr const char* kFrameStep = "/particles/fluid/position/step";
inline constexpr const char* kFrameTime = "/particles/fluid/position/time";
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
};

// Arrays of a Frame in the order of the message, all float64; the hash of a frame is over them in this order.
inline std::vector<Field> frame_fields(hsize_t particles, hsize_t bodies, hsize_t probes) {
  std::vector<Field> fields{{"fluid/position", "/particles/fluid/position/value", {particles, 3}, "m"},
                            {"fluid/velocity", "/particles/fluid/velocity/value", {particles, 3}, "m s-1"},
                            {"fluid/density", "/particles/fluid/density/value", {particles}, "kg m-3"},
                            {"fluid/pressure", "/particles/fluid/pressure/value", {particles}, "Pa"},
                            {"body/kinematics", "/frames/kinematics", {bodies, 19}, ""},
                            {"body/wrench", "/frames/wrench", {bodies, 6}, ""}};
  if (probes > 0) fields.push_back({"probe", std::string(kProbes) + "/value", {probes, 6}, ""});
  return fields;
}

// Arrays of an ExchangeLog, a row a step, all float64.
inline std::vector<Field> exchange_fields(hsize_t bodies) {
  return {{"kinematics", "/exchange/kinematics", {bodies, 19}, ""},
          {"wrenches", "/exchange/wrenches", {bodies, 6}, ""},
          {"coupling", "/exchange/coupling", {bodies > 0 ? hsize_t{2} : hsize_t{0}}, ""},
          {"wrench_parts", "/exchange/wrench_parts", {bodies, 12}, ""},
          {"ledger", "/exchange/ledger", {bodies, 15}, ""}};
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
