#include "server/liquid.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "fluid/equation_of_state.hpp"
#include "fluid/sampling.hpp"
#include "server/geometry.hpp"

namespace sluice::server {

namespace {

// Beyond this a scene is refused: at about 1 kB a particle it would not fit any machine's memory.
constexpr double kMostParticles = 1e8;
// A particle nearer than this to a surface, in spacings, is cut away by a body that displaces liquid ...
constexpr double kCut = 0.5;
// ... and an error at one that does not. Less than kCut, so that liquid up to a body's face is no error.
constexpr double kTooNear = 0.25;

[[noreturn]] void fail(const std::string& field, const std::string& text) {
  protocol::Problem problem;
  problem.field = field;
  problem.text = text;
  throw protocol::SceneError(std::vector<protocol::Problem>{problem});
}

std::string region_name(int index) {
  return fmt::format("fluid[{}]", index);
}

std::string place(const Eigen::Vector3d& x, int dimension) {
  return dimension == 2 ? fmt::format("({:g}, {:g}) m", x.x(), x.y())
                        : fmt::format("({:g}, {:g}, {:g}) m", x.x(), x.y(), x.z());
}

class Filling {
 public:
  explicit Filling(const Scene& scene) : scene_(scene), dimension_(static_cast<int>(scene.dimension())) {
    for (const FluidRegion& region : scene.fluid()) regions_.push_back(to_region(region));
  }

  fluid::FluidParticles run() {
    for (int r = 0; r < scene_.fluid_size(); ++r) add_region(r);
    if (liquid_.position.empty()) fail("fluid", "no liquid is left; give at least one region a larger shape");
    liquid_.volume = fluid::particle_volume(scene_.spacing(), dimension_);
    return std::move(liquid_);
  }

 private:
  void add_region(int r) {
    check_count(r);
    const Region& region = regions_[r];
    std::vector<Eigen::Vector3d> lattice =
        fluid::fill(region.shape, region.center, scene_.spacing(), dimension_);
    check_inside_tank(r, lattice);
    check_overlap(r, lattice);
    cut_bodies(lattice);

    const Eigen::Vector3d velocity = to_vector(scene_.fluid(r).velocity());
    for (const Eigen::Vector3d& x : lattice) {
      liquid_.position.push_back(x);
      liquid_.velocity.push_back(velocity);
      liquid_.pressure.push_back(pressure(r, x));
    }
  }

  void check_count(int r) const {
    const auto [min, max] = fluid::bounds(regions_[r].shape, dimension_);
    double count = 1;
    for (int a = 0; a < dimension_; ++a) count *= (max[a] - min[a]) / scene_.spacing();
    if (count + static_cast<double>(liquid_.position.size()) > kMostParticles) {
      fail("spacing",
           fmt::format("{:g} m gives about {:.2g} particles in {}; at most {:g}: take a larger spacing",
                       scene_.spacing(), count, region_name(r), kMostParticles));
    }
  }

  void check_inside_tank(int r, const std::vector<Eigen::Vector3d>& lattice) const {
    const Eigen::Vector3d min = to_vector(scene_.domain().min()), max = to_vector(scene_.domain().max());
    for (const Eigen::Vector3d& x : lattice) {
      for (int a = 0; a < dimension_; ++a) {
        if (x[a] > min[a] && x[a] < max[a]) continue;
        fail(region_name(r),
             fmt::format("liquid at {} stands outside the tank, which reaches from {} to {}",
                         place(x, dimension_), place(min, dimension_), place(max, dimension_)));
      }
    }
  }

  // Two shapes overlap when particles of one stand inside the other.
  void check_overlap(int r, const std::vector<Eigen::Vector3d>& lattice) {
    for (int other = 0; other < r; ++other) {
      const bool inside = holds_any(other, lattice) || holds_any(r, lattices_[other]);
      if (inside)
        fail(region_name(r), fmt::format("overlaps {}; shrink or move one of them", region_name(other)));
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

  void cut_bodies(std::vector<Eigen::Vector3d>& lattice) const {
    for (int b = 0; b < scene_.body_size(); ++b) {
      const Body& body = scene_.body(b);
      const fluid::Shape shape = to_shape(body);
      const fluid::Kinematics pose = initial_kinematics(body, dimension_);
      const double clearance = (body.displaces_fluid() ? kCut : kTooNear) * scene_.spacing();
      // The tolerance keeps a lattice that touches the body from losing a layer to round-off.
      const double nearest = clearance - 1e-6 * scene_.spacing();
      const auto cut = std::remove_if(lattice.begin(), lattice.end(), [&](const Eigen::Vector3d& x) {
        return distance(shape, pose, x, dimension_) < nearest;
      });
      if (cut != lattice.end() && !body.displaces_fluid()) {
        fail(fmt::format("body[{}]", b),
             fmt::format("\"{}\" stands in liquid ({} particles); move it or set displaces_fluid: true",
                         body.name(), lattice.end() - cut));
      }
      lattice.erase(cut, lattice.end());
    }
  }

  // Hydrostatic, with the density that the pressure makes: z the height of x against gravity, H that of the
  // region's highest point. CF (65) has the pressure of an incompressible column, with which the start is not
  // quite at rest.
  double pressure(int r, const Eigen::Vector3d& x) const {
    const Eigen::Vector3d g = to_vector(scene_.gravity());
    if ((scene_.fluid(r).has_hydrostatic() && !scene_.fluid(r).hydrostatic()) || g.isZero(0)) return 0;
    const Region& region = regions_[r];
    const double g_height = support(region.shape, -g) - g.dot(region.center);  // g H
    const fluid::EquationOfState eos(scene_.liquid().density(), scene_.liquid().sound_speed());
    return eos.pressure(eos.hydrostatic_density(g_height + g.dot(x)));
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
