#include "server/packing.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <unordered_map>

#include "fluid/sampling.hpp"
#include "fluid/setup.hpp"

namespace sluice::server {

namespace {

constexpr double kBand = 5.0;  // around a body in which particles move, in spacings
constexpr int kSweeps = 100;
constexpr double kShare = 0.1;        // of h^2 grad C that a sweep moves
constexpr double kLargestMove = 0.1;  // in spacings
constexpr double kNearest = 0.25;     // that a packed particle may be to a surface, in spacings

using Points = std::vector<Eigen::Vector3d>;

// Items by cubic cells of one support.
class Cells {
 public:
  Cells(const Points& points, double size) : points_(points), size_(size) {
    for (std::size_t i = 0; i < points.size(); ++i) cells_[key(cell(points[i]))].push_back(i);
  }
  template <typename Visit>
  void for_near(const Eigen::Vector3d& x, int dimension, const Visit& visit) const {
    const Eigen::Vector3i at = cell(x);
    const int depth = dimension == 3 ? 1 : 0;
    for (int i = -1; i <= 1; ++i)
      for (int j = -1; j <= 1; ++j)
        for (int k = -depth; k <= depth; ++k) {
          const auto found = cells_.find(key(at + Eigen::Vector3i(i, j, k)));
          if (found == cells_.end()) continue;
          for (const std::size_t p : found->second) visit(points_[p]);
        }
  }

 private:
  [[nodiscard]] Eigen::Vector3i cell(const Eigen::Vector3d& x) const {
    return (x / size_).array().floor().cast<int>();
  }
  static std::uint64_t key(const Eigen::Vector3i& c) {
    constexpr std::int64_t kOffset = 1 << 20;
    const auto at = [&](int a) { return static_cast<std::uint64_t>(c[a] + kOffset); };
    return at(0) << 42 | at(1) << 21 | at(2);
  }

  const Points& points_;
  double size_;
  std::unordered_map<std::uint64_t, std::vector<std::size_t>> cells_;
};

class Packing {
 public:
  Packing(const Scene& scene, const Region& region, const Points& particles)
      : scene_(scene),
        region_(region),
        particles_(particles),
        dimension_(static_cast<int>(scene.dimension())),
        dx_(scene.spacing()),
        h_(scene.formulation().smoothing() * dx_) {
    for (const Body& body : scene.body()) {
      bodies_.push_back(
          {to_shape(body, dimension_), initial_kinematics(body, dimension_), body.displaces_fluid(), {}});
      add_boundary(bodies_.back());
    }
  }

  Points run() {
    Points way(particles_.size(), Eigen::Vector3d::Zero());
    for (const Placed& body : bodies_)
      if (body.displaces && !fits(body) && stands_alone(body)) choose_band(body);
    if (moving_.empty()) return way;
    for (int sweep = 0; sweep < kSweeps; ++sweep) relax();
    if (!has_room()) return way;
    for (std::size_t m = 0; m < source_.size(); ++m)
      if (source_[m] >= 0)
        way[static_cast<std::size_t>(source_[m])] =
            moving_[m] - particles_[static_cast<std::size_t>(source_[m])];
    return way;
  }

 private:
  struct Placed {
    fluid::Shape shape;
    fluid::Kinematics pose;
    bool displaces;
    Points boundary;  // its particles
  };

  // Layers of a thin plate reach through it; those stand in nobody's way.
  void add_boundary(Placed& body) {
    const fluid::Boundary boundary = fluid::sample_body(body.shape, dx_, 2 * h_, dimension_);
    for (const Eigen::Vector3d& x : boundary.position)
      if (fluid::signed_distance(body.shape, x, dimension_) < 0)
        body.boundary.push_back(body.pose.position + body.pose.orientation * x);
    fixed_.insert(fixed_.end(), body.boundary.begin(), body.boundary.end());
  }

  [[nodiscard]] double distance_to(const Placed& body, const Eigen::Vector3d& x) const {
    return distance(body.shape, body.pose, x, dimension_);
  }

  // Whether the first layer stands half a spacing from the surface; at corners 0.71 of one.
  [[nodiscard]] bool fits(const Placed& body) const {
    return std::none_of(particles_.begin(), particles_.end(), [&](const Eigen::Vector3d& x) {
      const double d = distance_to(body, x) / dx_;
      return d < 0.45 || (d > 0.55 && d < 0.7);
    });
  }

  // Whether no other body and no other region of liquid is near: packed between them, liquid starts under
  // pressures that belong to nothing.
  [[nodiscard]] bool stands_alone(const Placed& body) const {
    if (scene_.fluid_size() > 1) return false;
    return std::all_of(bodies_.begin(), bodies_.end(), [&](const Placed& other) {
      return &other == &body ||
             std::none_of(other.boundary.begin(), other.boundary.end(),
                          [&](const auto& x) { return distance_to(body, x) < 2 * kBand * dx_; });
    });
  }

  // Whether every particle found a place in front of the bodies. Between bodies that are a few spacings apart
  // there may be none; then the lattice stays as it was cut.
  [[nodiscard]] bool has_room() const {
    for (std::size_t m = 0; m < moving_.size(); ++m)
      for (const Placed& body : bodies_)
        if (source_[m] >= 0 && distance_to(body, moving_[m]) < kNearest * dx_) return false;
    return true;
  }

  // Particles near the body move; the lattice goes on beyond the liquid, and is fixed beyond the tank.
  void choose_band(const Placed& body) {
    if (taken_.empty()) taken_.assign(particles_.size(), false);
    for (std::size_t i = 0; i < particles_.size(); ++i) {
      if (taken_[i] || distance_to(body, particles_[i]) > kBand * dx_) continue;
      taken_[i] = true;
      moving_.push_back(particles_[i]);
      source_.push_back(static_cast<std::int64_t>(i));
    }
    for (const Eigen::Vector3d& x : lattice_around(body)) {
      const bool is_near = distance_to(body, x) <= kBand * dx_;
      if (is_near && is_inside_tank(scene_, x)) {
        moving_.push_back(x);
        source_.push_back(-1);
      } else {
        fixed_.push_back(x);
      }
    }
  }

  // Points of the liquid's lattice that are neither liquid nor in a body.
  [[nodiscard]] Points lattice_around(const Placed& body) const {
    const double reach = kBand * dx_ + 2 * h_;
    const Eigen::Vector3d anchor = particles_.front();
    const fluid::CompoundShape in_its_pose{{{body.shape, body.pose.position, body.pose.orientation}}};
    const fluid::Bounds box = fluid::bounds(in_its_pose, dimension_);
    Eigen::Vector3d low = box.min.array() - reach;
    const Eigen::Vector3d high = box.max.array() + reach;
    Eigen::Vector3i count = ((high - low) / dx_).array().ceil().cast<int>();
    low = anchor + dx_ * ((low - anchor) / dx_).array().ceil().matrix();
    if (dimension_ == 2) {
      low.z() = 0;
      count.z() = 1;
    }
    Points points;
    for (int i = 0; i < count.x(); ++i)
      for (int j = 0; j < count.y(); ++j)
        for (int k = 0; k < count.z(); ++k) {
          const Eigen::Vector3d x = low + dx_ * Eigen::Vector3d(i, j, k);
          if (fluid::signed_distance(region_.shape, x - region_.center, dimension_) < 0) continue;
          const bool in_body = std::any_of(bodies_.begin(), bodies_.end(),
                                           [&](const Placed& b) { return distance_to(b, x) <= 0; });
          if (!in_body) points.push_back(x);
        }
    return points;
  }

  // -W'(r)/r of Wendland's C2 kernel, times the volume of a particle.
  [[nodiscard]] double slope(double r) const {
    const double q = r / h_;
    if (q >= 2) return 0;
    const double norm =
        dimension_ == 2 ? 7 / (4 * std::numbers::pi * h_ * h_) : 21 / (16 * std::numbers::pi * h_ * h_ * h_);
    return std::pow(dx_, dimension_) * norm * 5 * std::pow(1 - q / 2, 3) / (h_ * h_);
  }

  void relax() {
    Points all = fixed_;
    for (std::size_t i = 0; i < particles_.size(); ++i)
      if (!taken_[i]) all.push_back(particles_[i]);
    all.insert(all.end(), moving_.begin(), moving_.end());
    const Cells cells(all, 2 * h_);
    Points next = moving_;
    for (std::size_t m = 0; m < moving_.size(); ++m) {
      Eigen::Vector3d push = Eigen::Vector3d::Zero();
      cells.for_near(moving_[m], dimension_, [&](const Eigen::Vector3d& x) {
        const Eigen::Vector3d apart = moving_[m] - x;
        push += slope(apart.norm()) * apart;
      });
      push *= kShare * h_ * h_;
      const double length = push.norm();
      if (length > kLargestMove * dx_) push *= kLargestMove * dx_ / length;
      if (is_inside_tank(scene_, moving_[m] + push)) next[m] += push;
    }
    moving_ = next;
  }

  const Scene& scene_;
  const Region& region_;
  const Points& particles_;
  int dimension_;
  double dx_, h_;
  std::vector<Placed> bodies_;
  std::vector<bool> taken_;
  Points moving_, fixed_;
  std::vector<std::int64_t> source_;  // index in particles_, or -1
};

}  // namespace

std::vector<Eigen::Vector3d> packing(const Scene& scene, const Region& region,
                                     const std::vector<Eigen::Vector3d>& particles) {
  if (particles.empty()) return {};
  return Packing(scene, region, particles).run();
}

}  // namespace sluice::server
