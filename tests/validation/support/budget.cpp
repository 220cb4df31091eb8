#include "validation/support/budget.hpp"

#include <algorithm>

namespace sluice::validation {

double energy(const SceneRun& run) {
  const fluid::Diagnostics d = run.solver().diagnostics();
  return d.kinetic + d.potential + d.elastic;
}

void EnergyRise::look(const SceneRun& run) {
  const double now = energy(run);
  lowest_ = std::min(lowest_, now);
  most_ = std::max(most_, now - lowest_);
}

int lost_below_or_beside(const SceneRun& run) {
  const fluid::Snapshot s = run.solver().snapshot();
  const Domain& domain = run.scene().domain();
  const double slack = 0.5 * run.scene().spacing();
  int count = 0;
  for (std::size_t i = 0; i < s.density.size(); ++i) {
    const double x = s.position[3 * i], y = s.position[3 * i + 1];
    count += !(x > domain.min(0) - slack && x < domain.max(0) + slack && y > domain.min(1) - slack);
  }
  return count;
}

}  // namespace sluice::validation
