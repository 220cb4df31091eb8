#pragma once

#include "messages.pb.h"

namespace sluice::server {

// The instructions that decide which code paths of the C library are taken, e.g. "x86-64, avx2 fma".
std::string processor_class();

// What a bit-for-bit repetition of a run depends on, of this program on this machine.
Build build_info(int threads);

}  // namespace sluice::server
