#include "protocol/scene_files.hpp"

#include <fmt/format.h>

#include "protocol/mesh_file.hpp"
#include "protocol/motion_table.hpp"

namespace sluice::protocol {
namespace {

class NamedFiles {
 public:
  NamedFiles(const std::filesystem::path& scene_file, ParsedScene& parsed)
      : scene_file_(scene_file), parsed_(parsed), dimension_(parsed.scene.dimension() == 3 ? 3 : 2) {}

  void read() {
    for (int b = 0; b < parsed_.scene.body_size(); ++b) {
      Body& body = *parsed_.scene.mutable_body(b);
      const std::string field = fmt::format("body[{}]", b);
      if (body.has_mesh()) read(*body.mutable_mesh(), field + ".mesh");
      for (int p = 0; p < body.compound().part_size(); ++p)
        if (body.compound().part(p).has_mesh())
          read(*body.mutable_compound()->mutable_part(p)->mutable_mesh(),
               fmt::format("{}.compound.part[{}].mesh", field, p));
      if (body.prescribed().has_keyframes())
        read(*body.mutable_prescribed()->mutable_keyframes(), field + ".prescribed.keyframes");
    }
  }

 private:
  void read(Keyframes& keyframes, const std::string& field) {
    if (keyframes.file().empty()) return;
    if (!keyframes.key().empty()) return report(field + ".file", "keys are given too; leave one of them out");
    read_motion_table(path_of(keyframes.file()), field + ".file", dimension_, keyframes, parsed_.problems);
    keyframes.clear_file();
  }

  void read(Mesh& mesh, const std::string& field) {
    if (!mesh.file().empty() && !mesh.vertex().empty())
      return report(field + ".file", "vertices are given too; leave one of them out");
    if (!mesh.file().empty()) {
      const std::string problem = read_mesh(path_of(mesh.file()), mesh.has_scale() ? mesh.scale() : 1, mesh);
      if (!problem.empty()) return report(field + ".file", problem);
    }
    // A scene that has been read already has the hull's triangles.
    if (mesh.convex_hull() && (!mesh.file().empty() || mesh.triangle().empty())) {
      if (const std::string problem = take_convex_hull(mesh); !problem.empty()) return report(field, problem);
    }
    if (mesh.file().empty()) return;
    if (const std::string problem = check_surface(mesh); !problem.empty())
      return report(field + ".file", fmt::format("{}: {}", mesh.file(), problem));
    mesh.clear_file();
    mesh.clear_scale();
  }

  [[nodiscard]] std::filesystem::path path_of(const std::string& name) const {
    return scene_file_.parent_path() / name;
  }

  void report(const std::string& field, std::string text) {
    const auto found = parsed_.positions.find(field);
    const Location where =
        found == parsed_.positions.end() ? Location{scene_file_.string(), 0, 0} : found->second;
    parsed_.problems.push_back({where, field, std::move(text)});
  }

  const std::filesystem::path& scene_file_;
  ParsedScene& parsed_;
  int dimension_;
};

}  // namespace

void read_named_files(const std::filesystem::path& scene_file, ParsedScene& parsed) {
  NamedFiles(scene_file, parsed).read();
}

}  // namespace sluice::protocol
