#include "protocol/scene_check.hpp"

namespace sluice::protocol {

std::vector<Problem> check_fields(const Scene&) {
  return {};
}

}  // namespace sluice::protocol
