#pragma once

#include "messages.pb.h"

namespace sluice::server {

// What a bit-for-bit repetition of a run depends on, of this program on this machine.
Build build_info(int threads);

}  // namespace sluice::server
