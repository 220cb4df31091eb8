#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scene.pb.h"

namespace sluice::protocol {

// Largest density over the smallest that is allowed in one scene.
inline constexpr double kLargestDensityRatio = 1000;

struct LiquidProperties {
  double density;      // at zero pressure [kg/m^3]
  double viscosity;    // [Pa s]
  double sound_speed;  // [m/s]
};

// Scene.liquid, then the others, of a scene with its defaults. They are equally stiff: density *
// sound_speed^2 is the same.
std::vector<LiquidProperties> liquids(const Scene& scene);
// Of the slowest and the fastest of them [m/s].
double slowest_sound(const Scene& scene);
double fastest_sound(const Scene& scene);

// [kg/m^3]
double heaviest_density(const Scene& scene);

// The number of a region's liquid in liquids(); nothing where it names one that is not there.
std::optional<std::size_t> liquid_of(const FluidRegion& region, const Scene& scene);

}  // namespace sluice::protocol
