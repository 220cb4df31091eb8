#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "protocol/field_check.hpp"

namespace sluice::protocol {
namespace {

constexpr int kMostProbes = 1000;

void check_body(const std::string& name, bool needed, const std::string& field, const Scene& scene,
                FieldCheck& check) {
  if (name.empty() && !needed) return;
  const bool known = std::any_of(scene.body().begin(), scene.body().end(),
                                 [&](const Body& body) { return body.name() == name; });
  if (!known)
    check.report(field, fmt::format("there is no body \"{}\"; {}", name,
                                    needed ? "name one" : "name one, or leave it out for a fixed place"));
}

void check_kind(const Probe& probe, const Scene& scene, const std::string& field, FieldCheck& check) {
  switch (probe.kind_case()) {
    case Probe::kPoint:
      check.vector(probe.point().position(), field + ".point.position", "the place");
      return check_body(probe.point().body(), false, field + ".point.body", scene, check);
    case Probe::kSurface:
      check.vector(probe.surface().position(), field + ".surface.position", "a place on the line");
      return check_body(probe.surface().body(), false, field + ".surface.body", scene, check);
    case Probe::kForce:
      check.optional_vector(probe.force().about(), field + ".force.about", "the point of the moment");
      return check_body(probe.force().body(), true, field + ".force.body", scene, check);
    case Probe::kFlow: {
      const std::string& name = probe.flow().opening();
      const bool known = std::any_of(scene.opening().begin(), scene.opening().end(),
                                     [&](const Opening& opening) { return opening.name() == name; });
      if (!known)
        check.report(field + ".flow.opening", fmt::format("there is no opening \"{}\"; name one", name));
      return;
    }
    case Probe::KIND_NOT_SET:
      check.report(field, "has no kind; give point, surface, force or flow");
  }
}

}  // namespace

void check_probes(const Scene& scene, FieldCheck& check) {
  if (!check.count(scene.probe_size(), kMostProbes, "probe")) return;
  std::map<std::string, int> seen;
  for (int p = 0; p < scene.probe_size(); ++p) {
    const Probe& probe = scene.probe(p);
    const std::string field = fmt::format("probe[{}]", p);
    if (probe.name().empty()) check.report(field + ".name", "is missing; name the probe");
    if (const auto [first, fresh] = seen.emplace(probe.name(), p); !fresh)
      check.report(field + ".name", fmt::format("\"{}\" is the name of probe[{}] too; names must differ",
                                                probe.name(), first->second));
    check_kind(probe, scene, field, check);
  }
}

}  // namespace sluice::protocol
