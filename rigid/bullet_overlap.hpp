#pragma once

#include "rigid/shape.hpp"

namespace sluice::rigid {

// Penetration depth of two shapes in space by Bullet's narrow phase; 0 when they are apart. What a surface of
// triangles that is not convex hides inside it is not seen.
double bullet_penetration(const Placed& a, const Placed& b);

}  // namespace sluice::rigid
