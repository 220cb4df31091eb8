#include "benchmark/random_scene.hpp"

#include <fmt/format.h>
#include <google/protobuf/text_format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <vector>

#include "benchmark/random.hpp"
#include "protocol/error.hpp"
#include "protocol/scene_check.hpp"

namespace sluice::benchmark {
namespace {

constexpr double kG = 9.81;                 // [m/s^2]
constexpr double kFastest = 10;             // of gates [m/s]
constexpr double kFastestFlow = 3;          // of liquid and bodies at the start, along an axis [m/s]
constexpr int kFewest = 200, kMost = 3000;  // particles

// Four digits, so that the scene is readable and does not depend on the last bit of a logarithm.
double rounded(double value) {
  return std::strtod(fmt::format("{:.4g}", value).c_str(), nullptr);
}

// An axis-parallel box in cells of the lattice, from `min` up to `min + size`.
struct Cells {
  std::array<int, 3> min{}, size{};

  [[nodiscard]] bool overlaps(const Cells& other, int dimension) const {
    for (int a = 0; a < dimension; ++a)
      if (min[a] >= other.min[a] + other.size[a] || other.min[a] >= min[a] + size[a]) return false;
    return true;
  }
  [[nodiscard]] int count(int dimension) const { return size[0] * size[1] * (dimension == 3 ? size[2] : 1); }
};

class Generator {
 public:
  explicit Generator(std::uint64_t seed) : random_(seed) {
    scene_.set_name(fmt::format("random scene {}", seed));
  }

  Scene run() {
    make_tank();
    add_liquid();
    if (random_.chance(0.4)) add_gate();
    for (int count = random_.integer(0, 2); count > 0; --count) add_free_body(count);
    set_liquid();
    return scene_;
  }

 private:
  void make_tank() {
    dimension_ = random_.chance(0.15) ? 3 : 2;
    up_ = dimension_ - 1;
    scene_.set_dimension(static_cast<unsigned>(dimension_));
    if (dimension_ == 2)
      tank_ = {random_.integer(20, 60), random_.integer(15, 50), 0};
    else
      tank_ = {random_.integer(8, 16), random_.integer(4, 8), random_.integer(8, 16)};
    spacing_ = rounded(random_.spread(0.2, 2) / tank_[0]);
    scene_.set_spacing(spacing_);
    const bool snapped = random_.chance(0.75);
    Domain& domain = *scene_.mutable_domain();
    for (int a = 0; a < dimension_; ++a)
      domain.add_max(metres(tank_[a]) + (snapped ? 0 : rounded(random_.uniform(0, spacing_))));
    open_ = random_.chance(0.6);
    if (open_) domain.add_open(dimension_ == 2 ? Y_MAX : Z_MAX);
    if (random_.chance(0.2)) domain.set_surface(NO_SLIP);
  }

  void add_liquid() {
    Cells block;
    do {
      for (int a = 0; a < dimension_; ++a)
        block.size[a] = random_.integer(std::max(4, tank_[a] / 5), a == up_ ? tank_[a] * 7 / 10 : tank_[a]);
    } while (block.count(dimension_) < kFewest || block.count(dimension_) > kMost * 3 / 4);
    for (int a = 0; a < up_; ++a) block.min[a] = random_.chance(0.5) ? 0 : place(block, a);
    if (random_.chance(0.2)) block.min[up_] = place(block, up_);
    add_block(block);
    if (random_.chance(0.6)) add_second(block);
  }

  // A block or a drop where there is room for it.
  void add_second(const Cells& first) {
    const bool drop = random_.chance(0.6);
    for (int attempt = 0; attempt < 20; ++attempt) {
      Cells cells;
      const int width = 2 * random_.integer(2, std::max(3, tank_[0] / 8));
      for (int a = 0; a < dimension_; ++a) {
        const int wished = drop ? width : random_.integer(3, std::max(4, tank_[a] / 2));
        cells.size[a] = wished;
      }
      if (!fits(cells) || cells.count(dimension_) > kMost / 4) continue;
      for (int a = 0; a < dimension_; ++a) cells.min[a] = place(cells, a);
      if (cells.overlaps(first, dimension_)) continue;
      return drop ? add_drop(cells) : add_block(cells);
    }
  }

  void add_block(const Cells& cells) {
    FluidRegion& region = *scene_.add_fluid();
    for (int a = 0; a < dimension_; ++a) {
      region.mutable_box()->add_min(metres(cells.min[a]));
      region.mutable_box()->add_max(metres(cells.min[a] + cells.size[a]));
    }
    if (random_.chance(0.3)) set_velocity(*region.mutable_velocity());
  }

  void add_drop(const Cells& cells) {
    FluidRegion& region = *scene_.add_fluid();
    for (int a = 0; a < dimension_; ++a)
      region.mutable_ball()->add_center(metres(cells.min[a] + cells.size[a] / 2));
    region.mutable_ball()->set_radius(metres(cells.size[0] / 2));
    set_velocity(*region.mutable_velocity());
  }

  // A plate or a block that moves along an axis: up and out of an open tank, or to and fro inside it.
  void add_gate() {
    constexpr int kRoom = 3;  // cells left to the walls where it swings
    const bool rises = open_ && random_.chance(0.5);
    const int axis = rises ? up_ : random_.integer(0, up_);
    Cells gate;
    for (int a = 0; a < dimension_; ++a) gate.size[a] = random_.integer(2, std::max(3, tank_[a] / 2));
    const int thin = random_.integer(0, up_);
    gate.size[thin] = random_.chance(0.6) ? random_.integer(1, 3) : random_.integer(4, 8);
    const int stroke = tank_[axis] - gate.size[axis] - 2 * kRoom;
    if (!fits(gate) || (!rises && stroke < 2)) return;
    for (int a = 0; a < dimension_; ++a) gate.min[a] = place(gate, a);
    if (!rises) gate.min[axis] = kRoom;

    Body& body = new_body("gate", gate);
    for (int a = 0; a < dimension_; ++a) body.mutable_box()->add_size(metres(gate.size[a]));
    const double speed = rounded(random_.spread(0.2, kFastest));
    fastest_ = std::max(fastest_, speed);
    if (rises)
      rise(*body.mutable_prescribed()->mutable_constant(), speed);
    else
      swing(*body.mutable_prescribed()->mutable_expression(), axis, metres(random_.integer(2, stroke)),
            speed);
  }

  void rise(ConstantVelocity& motion, double speed) {
    for (int a = 0; a < dimension_; ++a) motion.add_velocity(a == up_ ? speed : 0);
    if (random_.chance(0.5)) motion.set_start(rounded(random_.uniform(0, 0.1)));
  }

  // From rest over the stroke and back; the speed is that of its middle.
  static void swing(Expression& motion, int axis, double stroke, double speed) {
    const std::string formula = fmt::format("{:.6g}*(1 - cos({:.4g}*t))", stroke / 2, 2 * speed / stroke);
    (axis == 0 ? *motion.mutable_x() : axis == 1 ? *motion.mutable_y() : *motion.mutable_z()) = formula;
  }

  void add_free_body(int number) {
    const int smallest = *std::min_element(tank_.begin(), tank_.begin() + dimension_);
    const bool ball = random_.chance(0.5);
    const int width = random_.integer(3, std::max(3, std::min(10, smallest / 2)));
    // The room that it takes in every orientation; a box is as wide as a square of that diagonal.
    Cells room;
    std::fill_n(room.size.begin(), dimension_, ball ? width : width + (width + 1) / 2);
    if (!find_place(room)) return;
    Body& body = new_body(fmt::format("body_{}", number), room);
    if (ball) {
      body.mutable_ball()->set_radius(metres(width) / 2);
    } else {
      for (int a = 0; a < dimension_; ++a) body.mutable_box()->add_size(metres(random_.integer(2, width)));
      if (dimension_ == 2 && random_.chance(0.5)) body.set_angle(rounded(random_.uniform(0, M_PI)));
    }
    body.set_density(rounded(1000 * random_.spread(0.05, 20)));
    if (random_.chance(0.3)) set_velocity(*body.mutable_velocity());
  }

  bool find_place(Cells& cells) {
    if (!fits(cells)) return false;
    for (int attempt = 0; attempt < 20; ++attempt) {
      for (int a = 0; a < dimension_; ++a) cells.min[a] = place(cells, a);
      if (std::none_of(bodies_.begin(), bodies_.end(),
                       [&](const Cells& other) { return cells.overlaps(other, dimension_); }))
        return true;
    }
    return false;
  }

  Body& new_body(const std::string& name, const Cells& room) {
    bodies_.push_back(room);
    Body& body = *scene_.add_body();
    body.set_name(name);
    body.set_displaces_fluid(true);
    for (int a = 0; a < dimension_; ++a) body.add_position(metres(room.min[a]) + metres(room.size[a]) / 2);
    return body;
  }

  // Viscosity, and the speed that the speed of sound follows from, where a body is faster than the liquid.
  void set_liquid() {
    if (random_.chance(0.3)) scene_.mutable_liquid()->set_viscosity(rounded(random_.spread(1e-3, 1)));
    const double expected = protocol::with_defaults(scene_).liquid().max_speed();
    if (fastest_ > expected) scene_.mutable_liquid()->set_max_speed(fastest_);
    // Fast gates have done their worst earlier.
    const double times = random_.uniform(2, 5) * std::sqrt(std::min(1.0, expected / fastest_));
    scene_.set_duration(rounded(times * std::sqrt(metres(tank_[up_]) / kG)));
  }

  template <typename Vector>
  void set_velocity(Vector& velocity) {
    double square = 0;
    for (int a = 0; a < dimension_; ++a) {
      velocity.Add(rounded(random_.uniform(-kFastestFlow, kFastestFlow)));
      square += velocity[a] * velocity[a];
    }
    fastest_ = std::max(fastest_, std::sqrt(square));
  }

  [[nodiscard]] bool fits(const Cells& cells) const {
    for (int a = 0; a < dimension_; ++a)
      if (cells.size[a] > tank_[a]) return false;
    return true;
  }
  int place(const Cells& cells, int axis) { return random_.integer(0, tank_[axis] - cells.size[axis]); }
  [[nodiscard]] double metres(int cells) const { return spacing_ * cells; }

  Random random_;
  Scene scene_;
  int dimension_ = 2, up_ = 1;
  std::array<int, 3> tank_{};  // cells along each axis
  double spacing_ = 0;
  bool open_ = false;
  double fastest_ = 1e-9;  // of what moves from the start or by itself [m/s]
  std::vector<Cells> bodies_;
};

}  // namespace

Scene random_scene(std::uint64_t seed) {
  return Generator(seed).run();
}

void write_scene(const Scene& scene, std::uint64_t seed, const std::filesystem::path& directory) {
  std::string text;
  google::protobuf::TextFormat::PrintToString(scene, &text);
  const auto path = directory / fmt::format("seed_{}.scene", seed);
  std::ofstream file(path);
  file << fmt::format("# sluice bench stability --case random_scenes --seed {}\n", seed) << text;
  file.close();
  if (!file) throw protocol::InputError(path.string() + ": cannot be written; name an existing directory");
}

}  // namespace sluice::benchmark
