#include "fluid/boundary_order.hpp"

#include "fluid/cell_grid.hpp"
#include "fluid/permute.hpp"

namespace sluice::fluid {

template <int Dim>
Boundary in_rows(const Boundary& boundary, double cell) {
  if (boundary.position.empty() || cell <= 0.0) return boundary;
  std::vector<Node<Dim>> nodes(boundary.position.size());
  for (std::size_t k = 0; k < nodes.size(); ++k) nodes[k].x = narrow<Dim>(boundary.position[k]);
  CellGrid<Dim> cells(nodes, cell);
  cells.file(nodes);
  Boundary sorted = boundary;
  permute(sorted.position, cells.item());
  permute(sorted.volume, cells.item());
  permute(sorted.to_surface, cells.item());
  permute(sorted.velocity, cells.item());
  permute(sorted.plate, cells.item());
  permute(sorted.face, cells.item());
  return sorted;
}

template Boundary in_rows<2>(const Boundary&, double);
template Boundary in_rows<3>(const Boundary&, double);

}  // namespace sluice::fluid
