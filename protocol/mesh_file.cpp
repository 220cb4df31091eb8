#include "protocol/mesh_file.hpp"

#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <array>
#include <assimp/Importer.hpp>
#include <map>

namespace sluice::protocol {
namespace {

using Point = std::array<double, 3>;

std::string extension(const std::filesystem::path& path) {
  std::string text = path.extension().string();
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

// Vertices that are equal become one: STL repeats them for every triangle.
class Welder {
 public:
  Welder(double scale, Mesh& mesh) : scale_(scale), mesh_(mesh) {}

  void add(const aiVector3D& v) {
    const Point point{v.x, v.y, v.z};
    const auto [found, fresh] = seen_.emplace(point, static_cast<std::uint32_t>(seen_.size()));
    if (fresh)
      for (const double x : point) mesh_.add_vertex(scale_ * x);
    mesh_.add_triangle(found->second);
  }

 private:
  double scale_;
  Mesh& mesh_;
  std::map<Point, std::uint32_t> seen_;
};

}  // namespace

std::string read_mesh(const std::filesystem::path& path, double scale, Mesh& mesh) {
  if (const std::string kind = extension(path); kind != ".stl" && kind != ".obj")
    return fmt::format("\"{}\" is neither .stl nor .obj; give one of them", path.filename().string());
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error))
    return fmt::format("there is no file {}", path.string());
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile(path.string(), aiProcess_Triangulate);
  if (scene == nullptr) return fmt::format("{} cannot be read: {}", path.string(), importer.GetErrorString());
  Welder welder(scale, mesh);
  for (unsigned m = 0; m < scene->mNumMeshes; ++m) {
    const aiMesh& part = *scene->mMeshes[m];
    for (unsigned f = 0; f < part.mNumFaces; ++f) {
      if (part.mFaces[f].mNumIndices != 3) continue;  // points and lines
      for (unsigned corner = 0; corner < 3; ++corner)
        welder.add(part.mVertices[part.mFaces[f].mIndices[corner]]);
    }
  }
  if (mesh.triangle().empty()) return fmt::format("{} holds no triangles", path.string());
  return "";
}

}  // namespace sluice::protocol
