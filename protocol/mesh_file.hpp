#pragma once

#include <filesystem>
#include <string>

#include "scene.pb.h"

namespace sluice::protocol {

// Reads an STL (text or binary) or OBJ file into vertices, each but once, and triangles, times `scale`.
// Returns what is wrong, empty if nothing is.
std::string read_mesh(const std::filesystem::path& path, double scale, Mesh& mesh);

// Replaces the triangles by those of the convex hull of the vertices. Returns what is wrong, as above.
std::string take_convex_hull(Mesh& mesh);

// Whether the triangles are a closed surface that is oriented outward. Returns what is wrong with the
// triangle that it names, as above.
std::string check_surface(const Mesh& mesh);

}  // namespace sluice::protocol
