#pragma once

#include "clients/preflight/layout.hpp"

namespace sluice::clients {

// Liquid there at all, inside the tank, nowhere twice, deep enough to be resolved.
void check_liquid(const Layout& layout, Findings& findings);

// Bodies at time 0: thickness, overlap with liquid, with each other and with walls.
void check_bodies(const Layout& layout, Findings& findings);

// Prescribed motions over the run: start at offset zero, finite, inside the tank, slow against sound.
void check_motions(const Layout& layout, Findings& findings);

Estimate estimate(const Layout& layout);

}  // namespace sluice::clients
