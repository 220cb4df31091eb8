#pragma once

#include "scene.pb.h"

namespace sluice::protocol {

// Whether the fluid's forces move the body at some time of the run: it has no prescribed motion, or one that
// releases it.
inline bool is_ever_free(const Body& body) {
  return !body.has_prescribed() || body.prescribed().has_release();
}

inline bool is_any_body_ever_free(const Scene& scene) {
  for (const Body& body : scene.body())
    if (is_ever_free(body)) return true;
  return false;
}

}  // namespace sluice::protocol
