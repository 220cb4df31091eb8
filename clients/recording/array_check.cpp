#include "clients/recording/array_check.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace sluice::clients {

using protocol::ProtocolError;

void check_array(const protocol::Message& message, int i, const std::string& name, const h5::Shape& expected,
                 Array::Type type) {
  const bool present = i < message.header.array_size();
  const Array& array = present ? message.header.array(i) : Array::default_instance();
  if (array.name() == name && array.type() == type &&
      std::equal(array.shape().begin(), array.shape().end(), expected.begin(), expected.end()))
    return;
  throw ProtocolError(
      fmt::format("array {} must be {} of type {} and shape [{}], not {} of type {} and shape [{}]", i, name,
                  Array::Type_Name(type), fmt::join(expected, ", "), present ? array.name() : "absent",
                  Array::Type_Name(array.type()), fmt::join(array.shape(), ", ")));
}

}  // namespace sluice::clients
