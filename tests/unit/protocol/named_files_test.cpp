#include <gmock/gmock.h>

#include <fstream>

#include "protocol/mass_properties.hpp"
#include "scene_text.hpp"

namespace sluice::protocol {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

// kScene with its second body's motion from a table, or its first in space with a shape from a file.
const std::string kMoved = R"(dimension: 2 spacing: 0.01 duration: 1
domain { max: [1, 0.5] }
fluid { box { min: [0, 0] max: [0.3, 0.3] } }
body { name: "gate" box { size: [0.1, 0.2] } position: [0.5, 0.3]
  prescribed { keyframes { file: "motion.csv" } } }
)";
const std::string kShaped = R"(dimension: 3 spacing: 0.01 duration: 1
domain { max: [2, 2, 2] }
fluid { box { min: [0, 0, 0] max: [0.3, 0.3, 0.3] } }
body { name: "hull" position: [1, 1, 1] density: 500
  mesh { file: "FILE" } }
)";

struct Loaded {
  Scene scene;
  std::string errors;
};

Loaded load(const std::string& scene, const std::string& name, const std::string& content) {
  const TemporaryDirectory directory;
  (void)directory.write(name, content);
  const std::string path = directory.write("a.scene", scene);
  Loaded result;
  try {
    result.scene = SceneFile::load(path).scene();
  } catch (const SceneError& error) {
    result.errors = error.what();
  }
  const std::string prefix = directory.path().string() + "/";
  for (std::size_t at = result.errors.find(prefix); at != std::string::npos; at = result.errors.find(prefix))
    result.errors.erase(at, prefix.size());
  return result;
}

TEST(MotionTable, GivesTheKeys) {
  const Loaded loaded =
      load(kMoved, "motion.csv", "# lifted\n time [s], y,angle\n0,0,0\r\n\n0.5, 0.1,-2e-1 # up\n");
  EXPECT_EQ(loaded.errors, "");
  const Keyframes& keys = loaded.scene.body(0).prescribed().keyframes();
  ASSERT_EQ(keys.key_size(), 2);
  EXPECT_EQ(keys.file(), "");
  EXPECT_EQ(keys.key(1).time(), 0.5);
  EXPECT_THAT(keys.key(1).offset(), ElementsAre(0, 0.1));
  EXPECT_EQ(keys.key(1).angle(), -0.2);
}

struct BadTable {
  const char* content;
  const char* error;
};

TEST(MotionTable, NamesLineAndColumnOfWhatIsWrong) {
  const std::string field = "body[0].prescribed.keyframes.file: ";
  for (const auto& [content, error] :
       {BadTable{"time,z\n", ":1:6: F\"z\" is no column of a motion; headings are time, x, y, angle"},
        BadTable{"time,x,x\n", ":1:8: Fa second column \"x\"; remove one"},
        BadTable{"x,y\n", ":1:1: Fthere is no column \"time\"; add it"},
        BadTable{"time,x\n0,0\n1\n", ":3:1: F1 values for 2 columns (time, x)"},
        BadTable{"time,x\n0,0\n1,  1e\n", ":3:5: F\"1e\" is not a number (x)"},
        BadTable{"time,x\n0,nan\n", ":2:3: F\"nan\" is not a number (x)"},
        BadTable{"time,x\n0,0\n0,1\n",
                 ":3:1: F0 s is not after the key before; times must increase from 0 or later"},
        BadTable{"time,x\n-1,0\n", ":2:1: F-1 s is negative; times must increase from 0 or later"},
        BadTable{"# nothing\n", ": Fholds no keys; give a line of headings and one for each key"}}) {
    std::string expected = std::string("motion.csv") + error;
    expected.replace(expected.find(": F") + 2, 1, field);
    EXPECT_THAT(load(kMoved, "motion.csv", content).errors, HasSubstr(expected)) << content;
  }
  EXPECT_THAT(load(kMoved, "other.csv", "").errors, HasSubstr("motion.csv: " + field + "cannot be read"));
}

// The cube 0..1 as text STL; the triangle `open` is left out, `turned` goes round the other way.
std::string cube(int open = -1, int turned = -1) {
  const int corner[12][3] = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                             {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  std::string text = "solid cube\n";
  for (int t = 0; t < 12; ++t) {
    if (t == open) continue;
    text += "facet normal 0 0 0\nouter loop\n";
    for (int k = 0; k < 3; ++k) {
      const int v = corner[t][t == turned ? 2 - k : k];
      text += "vertex " + std::to_string(v & 1) + " " + std::to_string(v >> 1 & 1) + " " +
              std::to_string(v >> 2) + "\n";
    }
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid cube\n";
}

std::string shaped(const std::string& file, const std::string& more = "") {
  std::string text = kShaped;
  return text.replace(text.find("FILE\""), 5, file + "\" " + more);
}

void expect_cube(const Loaded& loaded, double edge) {
  ASSERT_EQ(loaded.errors, "");
  const Body& body = loaded.scene.body(0);
  EXPECT_EQ(body.mesh().vertex_size(), 8 * 3);
  EXPECT_EQ(body.mesh().triangle_size(), 12 * 3);
  const MassProperties properties = mass_properties(body, 3);
  const double mass = 500 * edge * edge * edge;
  EXPECT_NEAR(properties.mass, mass, 1e-12 * mass);
  EXPECT_TRUE(properties.center.isApprox(Eigen::Vector3d::Constant(edge / 2), 1e-12));
  EXPECT_TRUE(properties.inertia.isApprox(mass * edge * edge / 6 * Eigen::Matrix3d::Identity(), 1e-12));
}

TEST(Mesh, IsReadFromTextStl) {
  expect_cube(load(shaped("cube.stl"), "cube.stl", cube()), 1);
  expect_cube(load(shaped("cube.stl", "scale: 0.5"), "cube.stl", cube()), 0.5);
}

TEST(Mesh, IsReadFromBinaryStl) {
  const std::string text = cube();
  std::string binary(80, ' ');
  const std::uint32_t count = 12;
  binary.append(reinterpret_cast<const char*>(&count), 4);
  std::istringstream words(text);
  std::string word;
  int vertices = 0;
  while (words >> word) {
    if (word == "facet") binary.append(12, '\0');
    if (word != "vertex") continue;
    for (int a = 0; a < 3; ++a) {
      float x = 0;
      words >> x;
      binary.append(reinterpret_cast<const char*>(&x), 4);
    }
    if (++vertices % 3 == 0) binary.append(2, '\0');
  }
  expect_cube(load(shaped("cube.STL"), "cube.STL", binary), 1);
}

TEST(Mesh, IsReadFromObjWithQuadrilaterals) {
  expect_cube(load(shaped("cube.obj"), "cube.obj",
                   "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 0 0 1\nv 1 0 1\nv 0 1 1\nv 1 1 1\n"
                   "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n"),
              1);
}

TEST(Mesh, NamesTheTriangleThatIsWrong) {
  const std::string field = "body[0].mesh.file: cube.stl: ";
  EXPECT_THAT(load(shaped("cube.stl"), "cube.stl", cube(3)).errors,
              HasSubstr("a.scene:5:10: " + field +
                        "triangle 2 has no neighbour at the edge from (1, 0, 1) m to "
                        "(0, 1, 1) m: the surface is open; close it"));
  EXPECT_THAT(load(shaped("cube.stl"), "cube.stl", cube(-1, 4)).errors,
              HasSubstr(field + "triangles 0 and 4 go along the edge"));
  std::string inside_out = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 4 2\nf 2 4 3\nf 1 3 4\n";
  EXPECT_THAT(load(shaped("a.obj"), "a.obj", inside_out).errors,
              HasSubstr("a.obj: the triangles go round clockwise seen from outside"));
  EXPECT_THAT(load(shaped("a.ply"), "a.ply", "").errors, HasSubstr("\"a.ply\" is neither .stl nor .obj"));
  EXPECT_THAT(load(shaped("a.stl"), "b.stl", "").errors,
              HasSubstr("body[0].mesh.file: there is no file a.stl"));
}

TEST(Mesh, ConvexHullOfPoints) {
  std::string text = kShaped;
  text.replace(
      text.find("file: \"FILE\""), 12,
      "convex_hull: true vertex: [0,0,0, 1,0,0, 0,1,0, 1,1,0, 0,0,1, 1,0,1, 0,1,1, 1,1,1, 0.5,0.4,0.5]");
  expect_cube(load(text, "x", ""), 1);
}

TEST(MassProperties, OfACompoundAreThoseOfItsParts) {
  Body body;
  body.set_density(1000);
  Part& box = *body.mutable_compound()->add_part();
  for (const double x : {0.2, 0.4, 0.6}) box.mutable_box()->add_size(x);
  Part& light = *body.mutable_compound()->add_part();
  for (const double x : {0.2, 0.4, 0.6}) light.mutable_box()->add_size(x);
  for (const double x : {0.2, 0.0, 0.0}) light.add_position(x);
  MassProperties two = mass_properties(body, 3);
  EXPECT_NEAR(two.mass, 96, 1e-12);
  EXPECT_TRUE(two.center.isApprox(Eigen::Vector3d(0.1, 0, 0), 1e-14));
  const Eigen::Vector3d one_box(0.16 + 0.36, 0.16 + 0.36, 0.16 + 0.16);
  EXPECT_TRUE(two.inertia.isApprox(Eigen::Matrix3d((96.0 / 12 * one_box).asDiagonal()), 1e-13));
  light.set_density(200);
  EXPECT_NEAR(mass_properties(body, 3).mass, 57.6, 1e-12);
  EXPECT_NEAR(mass_properties(body, 3).center.x(), 0.2 * 9.6 / 57.6, 1e-14);
}

TEST(MassProperties, AreTheGivenOnes) {
  Body body;
  body.mutable_ball()->set_radius(0.1);
  body.set_mass(3);
  for (const double x : {1.0, 2.0, 2.5, 0.1, 0.2, 0.3}) body.add_inertia(x);
  for (const double x : {0.0, 0.0, -0.05}) body.add_center_of_mass(x);
  const MassProperties given = mass_properties(body, 3);
  EXPECT_EQ(given.center, Eigen::Vector3d(0, 0, -0.05));
  EXPECT_EQ(given.inertia(1, 1), 2);
  EXPECT_EQ(given.inertia(0, 1), 0.1);
  EXPECT_EQ(given.inertia(2, 0), 0.2);
  EXPECT_EQ(given.inertia(1, 2), 0.3);
}

}  // namespace
}  // namespace sluice::protocol
