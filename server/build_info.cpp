#include "server/build_info.hpp"

#include <fstream>
#include <string>

namespace sluice::server {

namespace {

// The processor's name, e.g. "AMD EPYC 7B13".
std::string model_name() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    const std::size_t colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown processor";
}

std::string compiler() {
#if defined(__clang__)
  return "Clang " __clang_version__;
#else
  return "GCC " __VERSION__;
#endif
}

}  // namespace

std::string processor_class() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512f")) return "x86-64, avx512";
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return "x86-64, avx2 fma";
  return "x86-64";
#elif defined(__aarch64__)
  return "aarch64";
#else
  return "other";
#endif
}

Build build_info(int threads) {
  Build build;
  build.set_version(SLUICE_VERSION);
  build.set_compiler(compiler());
  build.set_processor(model_name() + " (" + processor_class() + ")");
  build.set_threads(static_cast<std::uint32_t>(threads));
  return build;
}

}  // namespace sluice::server
