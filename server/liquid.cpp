#include "server/liquid.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "fluid/sampling.hpp"
#include "protocol/liquids.hpp"
#include "server/geometry.hpp"
#include "server/initial_fields.hpp"
#include "server/packing.hpp"

namespace sluice::server {

using protocol::SceneError;

namespace {

// Beyond this a scene is refused: at about 1 kB a particle it would not fit any machine's memory.
constexpr double kMostParticles = 1e8;
// A particle nearer than this to a surface, in spacings, is cut away by a body that displaces liquid: those
// whose volume is there in the mean. ...
constexpr double kCut = 0.0;
// ... and an error at one that does not. Nearer than this the penetration guard (fluid/force_sweep.hpp) would
// throw it off in the first step.
constexpr double kTooNear = 0.25;

std::string region_name(int index) {
  return fmt::format("fluid[{}]", index);
}

std::string place(const Eigen::Vector3d& x, int dimension) {
  return dimension == 2 ? fmt::format("({:g}, {:g}) m", x.x(), x.y())
                        : fmt::format("({:g}, {:g}, {:g}) m", x.x(), x.y(), x.z());
}

struct Particle {
  Eigen::Vector3d position, origin;  // origin: its lattice point, from which the displacement moves it
};

class Filling {
 public:
  explicit Filling(const Scene& scene) : scene_(scene), dimension_(static_cast<int>(scene.dimension())) {
    for (const FluidRegion& region : scene.fluid()) regions_.push_back(to_region(region));
  }

  fluid::FluidParticles run() {
    for (int r = 0; r < scene_.fluid_size(); ++r) add_region(r);
    const bool is_fed = std::any_of(scene_.opening().begin(), scene_.opening().end(),
                                    [](const Opening& opening) { return opening.has_inflow(); });
    if (liquid_.position.empty() && !is_fed)
      throw SceneError("fluid", "no liquid is left; give at least one region a larger shape");
    liquid_.volume = fluid::particle_volume(scene_.spacing(), dimension_);
    return std::move(liquid_);
  }

 private:
  void add_region(int r) {
    check_count(r);
    const Region& region = regions_[r];
    std::vector<Eigen::Vector3d> lattice =
        fluid::fill(region.shape, region.center, scene_.spacing(), dimension_);
    check_overlap(r, lattice);
    const InitialFields fields(scene_, r);
    std::vector<Particle> particles;
    for (const Eigen::Vector3d& x : lattice) particles.push_back({x + fields.displacement(x), x});
    check_inside_tank(r, particles);
    cut_bodies(particles);
    pack(r, particles);
    clear_surfaces(particles);

    for (const auto& [position, origin] : particles) {
      liquid_.position.push_back(position);
      liquid_.velocity.push_back(fields.velocity(origin));
      liquid_.pressure.push_back(fields.pressure(origin));
      if (scene_.other_liquid_size() > 0)
        liquid_.liquid.push_back(
            static_cast<std::uint8_t>(protocol::liquid_of(scene_.fluid(r), scene_).value()));
    }
  }

  void check_count(int r) const {
    const auto [min, max] = fluid::bounds(regions_[r].shape, dimension_);
    double count = 1;
    for (int a = 0; a < dimension_; ++a) count *= (max[a] - min[a]) / scene_.spacing();
    if (count + static_cast<double>(liquid_.position.size()) > kMostParticles) {
      throw SceneError(
          "spacing",
          fmt::format("{:g} m gives about {:.2g} particles in {}; at most {:g}: take a larger spacing",
                      scene_.spacing(), count, region_name(r), kMostParticles));
    }
  }

  void check_inside_tank(int r, const std::vector<Particle>& particles) const {
    for (const auto& [x, origin] : particles) {
      if (is_inside_tank(scene_, x)) continue;
      throw SceneError(region_name(r),
                       fmt::format("liquid at {} stands outside the tank, which reaches from {} to {}",
                                   place(x, dimension_), place(to_vector(scene_.domain().min()), dimension_),
                                   place(to_vector(scene_.domain().max()), dimension_)));
    }
  }

  // Two shapes overlap when particles of one stand inside the other.
  void check_overlap(int r, const std::vector<Eigen::Vector3d>& lattice) {
    for (int other = 0; other < r; ++other) {
      const bool inside = holds_any(other, lattice) || holds_any(r, lattices_[other]);
      if (inside)
        throw SceneError(region_name(r),
                         fmt::format("overlaps {}; shrink or move one of them", region_name(other)));
    }
    lattices_.push_back(lattice);
  }

  bool holds_any(int r, const std::vector<Eigen::Vector3d>& lattice) const {
    const Region& region = regions_[r];
    const double round_off = 1e-6 * scene_.spacing();
    return std::any_of(lattice.begin(), lattice.end(), [&](const Eigen::Vector3d& x) {
      return fluid::signed_distance(region.shape, x - region.center, dimension_) < -round_off;
    });
  }

  void cut_bodies(std::vector<Particle>& particles) const {
    for (int b = 0; b < scene_.body_size(); ++b) {
      const Body& body = scene_.body(b);
      const fluid::Shape shape = to_shape(body, dimension_);
      const fluid::Kinematics pose = initial_kinematics(body, dimension_);
      const double clearance = (body.displaces_fluid() ? kCut : kTooNear) * scene_.spacing();
      // The tolerance keeps a lattice that touches the body from losing a layer to round-off.
      const double nearest = clearance - 1e-6 * scene_.spacing();
      const auto cut = std::remove_if(particles.begin(), particles.end(), [&](const Particle& p) {
        return distance(shape, pose, p.position, dimension_) < nearest;
      });
      if (cut != particles.end() && !body.displaces_fluid()) {
        throw SceneError(
            fmt::format("body[{}]", b),
            fmt::format("\"{}\" stands in liquid ({} particles); move it or set displaces_fluid: true",
                        body.name(), particles.end() - cut));
      }
      particles.erase(cut, particles.end());
    }
  }

  // Only where the lattice is as it was filled.
  void pack(int r, std::vector<Particle>& particles) const {
    const bool displaces = std::any_of(scene_.body().begin(), scene_.body().end(),
                                       [](const Body& body) { return body.displaces_fluid(); });
    if (!displaces || scene_.fluid(r).has_displacement()) return;
    std::vector<Eigen::Vector3d> positions;
    for (const Particle& p : particles) positions.push_back(p.position);
    const std::vector<Eigen::Vector3d> way =
        packing(scene_, regions_[static_cast<std::size_t>(r)], positions);
    for (std::size_t i = 0; i < particles.size(); ++i) {
      particles[i].position += way[i];
      particles[i].origin += way[i];
    }
  }

  // Moves the particles that the cut left too near to a body off its surface; between it and the tank there
  // may be no room for them.
  void clear_surfaces(std::vector<Particle>& particles) const {
    const double clearance = kTooNear * scene_.spacing();
    for (const Body& body : scene_.body()) {
      if (!body.displaces_fluid()) continue;
      const fluid::Shape shape = to_shape(body, dimension_);
      const fluid::Kinematics pose = initial_kinematics(body, dimension_);
      for (Particle& p : particles) {
        const double missing = clearance - distance(shape, pose, p.position, dimension_);
        if (missing <= 0) continue;
        const Eigen::Vector3d way = missing * outward(shape, pose, p.position);
        p.position += way;
        p.origin += way;
      }
      std::erase_if(particles, [&](const Particle& p) { return !is_inside_tank(scene_, p.position); });
    }
  }

  // The direction in which the distance from a body's surface grows.
  Eigen::Vector3d outward(const fluid::Shape& shape, const fluid::Kinematics& pose,
                          const Eigen::Vector3d& x) const {
    const double step = 1e-3 * scene_.spacing();
    Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
    for (int a = 0; a < dimension_; ++a) {
      const Eigen::Vector3d along = step * Eigen::Vector3d::Unit(a);
      gradient[a] =
          distance(shape, pose, x + along, dimension_) - distance(shape, pose, x - along, dimension_);
    }
    return gradient.stableNormalized();
  }

  const Scene& scene_;
  int dimension_;
  std::vector<Region> regions_;
  std::vector<std::vector<Eigen::Vector3d>> lattices_;  // before bodies are cut out
  fluid::FluidParticles liquid_;
};

}  // namespace

fluid::FluidParticles fill_liquid(const Scene& scene) {
  return Filling(scene).run();
}

}  // namespace sluice::server
