#pragma once

#include "fluid/setup.hpp"

namespace sluice::fluid {

// The same particles in rows, to and fro, so that those that follow each other are near each other: groups of
// them (group_list.hpp) share what is near. `cell` is the width of the rows [m].
template <int Dim>
Boundary in_rows(const Boundary& boundary, double cell);

}  // namespace sluice::fluid
