#pragma once

#include <cstdint>
#include <filesystem>

#include "scene.pb.h"

namespace sluice::benchmark {

// A violent scene: blocks and drops of liquid that fall, fly and meet in a tank with or without a lid, with
// gates that move at up to 10 m/s and floating and heavy bodies. A few hundred to three thousand particles,
// in the plane or in space. The same seed gives the same scene everywhere; it passes every check.
Scene random_scene(std::uint64_t seed);

// Writes it as DIRECTORY/seed_N.scene. Throws InputError when that cannot be done.
void write_scene(const Scene& scene, std::uint64_t seed, const std::filesystem::path& directory);

}  // namespace sluice::benchmark
