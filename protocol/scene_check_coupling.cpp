#include <fmt/format.h>

#include "protocol/field_check.hpp"

namespace sluice::protocol {

void check_coupling(const Scene& scene, FieldCheck& check) {
  const Coupling& c = scene.coupling();
  if (!CouplingScheme_IsValid(c.scheme()))
    check.report("coupling.scheme",
                 fmt::format("{} is none; give EXPLICIT, IMPLICIT or AUTO", static_cast<int>(c.scheme())));
  if (!WhenUnstable_IsValid(c.when_unstable()))
    check.report("coupling.when_unstable",
                 fmt::format("{} is none; give WARN or REFUSE", static_cast<int>(c.when_unstable())));
  if (c.has_steps_per_exchange()) check.within(c.steps_per_exchange(), 1, 256, "coupling.steps_per_exchange");
  if (c.scheme() == IMPLICIT && c.steps_per_exchange() > 1)
    for (int b = 0; b < scene.body_size(); ++b)
      if (!scene.body(b).owner().empty())
        check.report(
            "coupling.steps_per_exchange",
            fmt::format("{} steps are repeated together, but the owner of body[{}] is answered after each; "
                        "give 1",
                        c.steps_per_exchange(), b));
  if (c.has_tolerance()) check.within(c.tolerance(), 1e-14, 1, "coupling.tolerance");
  if (c.has_most_iterations()) check.within(c.most_iterations(), 1, 100, "coupling.most_iterations");
  if (c.has_shorten_steps() && (c.scheme() == IMPLICIT || c.scheme() == AUTO))
    check.report("coupling.shorten_steps", "belongs to the scheme EXPLICIT; set that or leave this out");
  if (c.scheme() == EXPLICIT || c.scheme() == COUPLING_UNSPECIFIED) {
    constexpr const char* kReason =
        "belongs to the schemes IMPLICIT and AUTO; set one of those or leave this out";
    if (c.has_tolerance()) check.report("coupling.tolerance", kReason);
    if (c.has_most_iterations()) check.report("coupling.most_iterations", kReason);
  }
}

}  // namespace sluice::protocol
