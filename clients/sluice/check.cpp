#include "clients/sluice/check.hpp"

namespace sluice::clients {

protocol::SceneFile load_checked(const CheckOptions& options) {
  return protocol::SceneFile::load(options.scene, options.overrides);
}

int check(const CheckOptions& options) {
  load_checked(options);
  return protocol::kDone;
}

}  // namespace sluice::clients
