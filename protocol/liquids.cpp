#include "protocol/liquids.hpp"

#include <algorithm>
#include <cmath>

namespace sluice::protocol {

std::vector<LiquidProperties> liquids(const Scene& scene) {
  const Liquid& first = scene.liquid();
  std::vector<LiquidProperties> all{{first.density(), first.viscosity(), first.sound_speed()}};
  for (const OtherLiquid& other : scene.other_liquid())
    all.push_back({other.density(), other.viscosity(),
                   first.sound_speed() * std::sqrt(first.density() / other.density())});
  return all;
}

double slowest_sound(const Scene& scene) {
  const Liquid& first = scene.liquid();
  return first.sound_speed() * std::sqrt(first.density() / heaviest_density(scene));
}

double fastest_sound(const Scene& scene) {
  double fastest = 0;
  for (const LiquidProperties& liquid : liquids(scene)) fastest = std::max(fastest, liquid.sound_speed);
  return fastest;
}

double heaviest_density(const Scene& scene) {
  double heaviest = scene.liquid().density();
  for (const OtherLiquid& other : scene.other_liquid()) heaviest = std::max(heaviest, other.density());
  return heaviest;
}

std::optional<std::size_t> liquid_of(const FluidRegion& region, const Scene& scene) {
  if (region.liquid().empty()) return 0;
  for (int k = 0; k < scene.other_liquid_size(); ++k)
    if (scene.other_liquid(k).name() == region.liquid()) return static_cast<std::size_t>(k) + 1;
  return std::nullopt;
}

}  // namespace sluice::protocol
