#pragma once

#include "clients/recording/hdf5.hpp"
#include "protocol/message.hpp"

namespace sluice::clients {

// Everything in a recording that is known before the run starts: metadata, parameters, boundary particles.
void write_prologue(hid_t file, const protocol::Message& welcome);

}  // namespace sluice::clients
