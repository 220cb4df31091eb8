#pragma once

#include "scene.pb.h"

namespace sluice::protocol {

// Whether its motion is prescribed along some axes only.
inline bool is_partly_free(const Body& body) {
  return body.has_prescribed() && (body.free_size() > 0 || body.free_rotation_size() > 0);
}

// Whether the fluid's forces move the body from the start on.
inline bool starts_free(const Body& body) {
  return !body.has_prescribed() || is_partly_free(body);
}

// Whether they move it at some time of the run: it may have a motion that releases it.
inline bool is_ever_free(const Body& body) {
  return starts_free(body) || body.prescribed().has_release();
}

inline bool is_any_body_ever_free(const Scene& scene) {
  for (const Body& body : scene.body())
    if (is_ever_free(body)) return true;
  return false;
}

}  // namespace sluice::protocol
