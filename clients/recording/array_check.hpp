#pragma once

#include <string>

#include "clients/recording/hdf5.hpp"
#include "protocol/message.hpp"

namespace sluice::clients {

// Throws ProtocolError unless the i-th array of the message is float64 of that name and shape.
void check_array(const protocol::Message& message, int i, const std::string& name, const h5::Shape& shape);

}  // namespace sluice::clients
