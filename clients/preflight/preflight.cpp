#include "clients/preflight/preflight.hpp"

#include <stdexcept>

#include "clients/preflight/checks.hpp"

namespace sluice::clients {

Preflight preflight(const protocol::SceneFile& file) {
  Findings findings(file);
  const Layout layout = lay_out(file.scene(), findings);
  check_liquid(layout, findings);
  check_bodies(layout, findings);
  check_motions(layout, findings);
  try {
    findings.result.estimate = estimate(layout);
  } catch (const std::invalid_argument& error) {  // from the step clock
    findings.error("spacing",
                   std::string(error.what()) + "; take a larger spacing or a smaller liquid.sound_speed");
  }
  return std::move(findings.result);
}

}  // namespace sluice::clients
