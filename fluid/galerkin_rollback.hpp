#pragma once

// Going back to an earlier state: in memory, for exchanges with bodies that are iterated, and as bytes.

#include "fluid/galerkin_solver.hpp"
#include "fluid/state_bytes.hpp"

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

template <int Dim, typename Kernel>
void GalerkinSolver<Dim, Kernel>::write_state(std::vector<std::byte>& bytes) {
  bytes.clear();
  StateWriter writer(bytes);
  writer.visit(state());
  writer.visit(search_);
}

template <int Dim, typename Kernel>
void GalerkinSolver<Dim, Kernel>::read_state(std::span<const std::byte> bytes) {
  const std::size_t particles = fluid_.size(), boundary = boundary_.size(), bodies = bodies_.size();
  StateReader reader(bytes);
  reader.visit(state());
  reader.visit(search_);
  reader.finish();
  if ((fluid_.size() != particles && !openings_.is_used()) || boundary_.size() != boundary ||
      bodies_.size() != bodies)
    throw std::invalid_argument("state: it is that of another setup");
}

}  // namespace sluice::fluid
