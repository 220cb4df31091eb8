#pragma once

#include <set>
#include <string>
#include <vector>

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

// Whether they move one of those that `sluice rigid` moves; bodies with an owner are its own business.
inline bool is_any_body_ever_free(const Scene& scene) {
  for (const Body& body : scene.body())
    if (body.owner().empty() && is_ever_free(body)) return true;
  return false;
}

// Who moves bodies, by Body.owner, each once: first, as "", `sluice rigid` where a body has no owner.
inline std::vector<std::string> owners(const Scene& scene) {
  std::set<std::string> names;
  for (const Body& body : scene.body()) names.insert(body.owner());
  return {names.begin(), names.end()};
}

// The bodies of an owner, as indices into Scene.body.
inline std::vector<int> bodies_of(const Scene& scene, const std::string& owner) {
  std::vector<int> bodies;
  for (int b = 0; b < scene.body_size(); ++b)
    if (scene.body(b).owner() == owner) bodies.push_back(b);
  return bodies;
}

}  // namespace sluice::protocol
