#pragma once

#include <string>

#include "clients/recording/hdf5.hpp"
#include "protocol/message.hpp"

namespace sluice::clients {

// Throws ProtocolError unless the i-th array of the message is of that name, shape and type.
void check_array(const protocol::Message& message, int i, const std::string& name, const h5::Shape& shape,
                 Array::Type type = Array::FLOAT64);

}  // namespace sluice::clients
