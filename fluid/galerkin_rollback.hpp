#pragma once

// Going back to an earlier state in memory, for exchanges with bodies that are iterated.

#include "fluid/galerkin_solver.hpp"

namespace sluice::fluid {

// Neighbour lists are most of the state, and seldom change: they are copied after a rebuild only.
template <int Dim, typename Kernel>
void GalerkinSolver<Dim, Kernel>::save() {
  saved_.save(state());
  if (!saved_search_.is_empty() && saved_rebuilds_ == search_.rebuilds()) return;
  saved_search_.save(std::tie(search_));
  saved_rebuilds_ = search_.rebuilds();
}

template <int Dim, typename Kernel>
void GalerkinSolver<Dim, Kernel>::restore() {
  saved_.restore(state());
  if (saved_rebuilds_ != search_.rebuilds()) saved_search_.restore(std::tie(search_));
}

}  // namespace sluice::fluid
