#pragma once

#include <cstdint>
#include <stdexcept>

#include "messages.pb.h"

namespace sluice::clients {

// Calls the action with a value of the type of an array's elements.
template <typename Action>
decltype(auto) with_element(Array::Type type, Action action) {
  switch (type) {
    case Array::FLOAT32:
      return action(float{});
    case Array::FLOAT64:
      return action(double{});
    case Array::INT64:
      return action(std::int64_t{});
    default:
      throw std::logic_error("no recorded array has elements of type " + Array::Type_Name(type));
  }
}

}  // namespace sluice::clients
