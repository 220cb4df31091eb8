#include "clients/rigid/own_part.hpp"

#include <set>
#include <string>

namespace sluice::clients {
namespace {

// Indices into the scene's bodies.
std::vector<int> own_bodies(const Welcome& welcome) {
  std::vector<int> bodies(welcome.body().begin(), welcome.body().end());
  for (int b = 0; welcome.body().empty() && b < welcome.scene().body_size(); ++b) bodies.push_back(b);
  return bodies;
}

}  // namespace

Scene own_part(const Welcome& welcome) {
  const Scene& whole = welcome.scene();
  Scene part = whole;
  part.clear_body();
  part.clear_joint();
  std::set<std::string> names;
  for (const int b : own_bodies(welcome)) {
    *part.add_body() = whole.body(b);
    names.insert(whole.body(b).name());
  }
  for (const Joint& joint : whole.joint())
    if (names.contains(joint.body())) *part.add_joint() = joint;
  return part;
}

std::vector<double> own_indicators(const Welcome& welcome) {
  std::vector<double> values;
  if (welcome.stability_size() == 0) return values;
  for (const int b : own_bodies(welcome)) values.push_back(welcome.stability(b).indicator());
  return values;
}

}  // namespace sluice::clients
