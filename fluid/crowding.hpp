#pragma once

#include <tuple>
#include <vector>

#include "fluid/half_space.hpp"
#include "fluid/model.hpp"
#include "fluid/parallel.hpp"
#include "fluid/particles.hpp"

namespace sluice::fluid {

// Nothing ties the volumes m/rho to the room that particles take. Where they crowd there is more mass in a
// room than rho says, which gravity pulls down: README.md, "Crowding". It is measured by
//   c = m0 / (share of the support that liquid fills),
// about 1 on a lattice, at the surface too (half_space.hpp), and spread by Fick's law: particles drift with
//   -S h c0 grad c / (1 + |a|^2/(kRest g)^2),   grad c_i = sum_k V_k W_ik (g_i + G_i x_ki) (c_k - c_i),
// over the fluid. a is their acceleration: crowds sink slowly, in liquid at rest; where it is not, the drift
// would do the work m a.drift on the flow. Particles take their velocity and density with them, so momentum
// and elastic energy are kept. At the surface they drift along it only, so it does not move. Other than the
// shifting of shifting.hpp this sees no disorder of the lattice, only what changes over a support; it is
// slow, and done once in kInterval steps. Spray, and what sees it, stays.
template <int Dim>
class Crowding {
 public:
  // `strength` is S, `gravity` g [m/s^2]; without either there is no drift.
  template <typename Kernel>
  Crowding(double strength, double gravity, const Model<Dim, Kernel>& model)
      : strength_(strength), gravity_(gravity), half_space_(model.kernel, model.h) {}

  [[nodiscard]] bool is_used() const { return strength_ > 0.0 && gravity_ > 0.0; }

  // Goes on by dt [s]; whether it is time to spread.
  bool is_due(double dt) {
    elapsed_ += dt;
    return ++steps_ >= kInterval;
  }

  // Moves particles, from the fits at their present positions; images have the present velocities.
  // for_fluid_near(i, visit) calls visit(k) for the fluid near i, and maybe others beyond the support.
  template <typename Kernel, typename ForFluidNear>
  void spread(const Model<Dim, Kernel>& model, const ForFluidNear& for_fluid_near, const Parallel& parallel,
              Particles<Dim>& fluid) {
    measure(model, parallel, fluid);
    const double diffusion = strength_ * model.h * model.eos.sound_speed() * elapsed_;
    drift_.resize(fluid.size());
    parallel.for_each(fluid.size(),
                      [&](std::size_t i) { drift_[i] = drift(model, for_fluid_near, fluid, i, diffusion); });
    parallel.for_each(fluid.size(), [&](std::size_t i) { fluid.node[i].x += drift_[i]; });
    elapsed_ = 0.0;
    steps_ = 0;
  }

  auto state() { return std::tie(steps_, elapsed_); }

 private:
  // Steps between two drifts, of 0.2 h^2 grad c at S = 0.02 and a Courant number of 0.4. A tank at rest and a
  // drop gave the same with 1, 10 and 30.
  static constexpr int kInterval = 30;
  // |m1|/(m0 h) from which on a particle is at the surface: 0.24 in the outermost row, 0.02 in the next.
  static constexpr double kSurfaceOffset = 0.1;
  // Thinner liquid is no half space.
  static constexpr double kLeastShare = 0.6;
  // Acceleration over g at which the drift is halved. Standing waves 0.05 deep have 0.16 and at 0.1 gained
  // 0.4 % of their amplitude in five periods; a tank at rest has less than 0.002.
  static constexpr double kRest = 0.03;
  // Of the drift of liquid at rest, what is not worth computing: it moves so little from 0.3 g on.
  static constexpr double kLeastDrift = 0.01;

  // In the place of c, which is above 0.
  static constexpr double kSpray = -1.0;

  // What a fit that is not spray tells of where its particle is.
  struct Place {
    Vec<Dim> centre;  // of the weights from the particle, m1/m0 [m]
    double offset;    // its distance over h
    double share;     // of the support that liquid fills
  };
  [[nodiscard]] Place place(const Fit<Dim>& fit, double h) const {
    const Vec<Dim> centre = -symmetric_inverse<Dim>(fit.G) * fit.g;
    const double offset = centre.norm() / h;
    return {centre, offset, half_space_.share(offset)};
  }

  // Images have fits too, and are measured with the rest.
  template <typename Kernel>
  void measure(const Model<Dim, Kernel>& model, const Parallel& parallel, const Particles<Dim>& fluid) {
    crowd_.resize(fluid.node.size());
    parallel.for_each(crowd_.size(), [&](std::size_t i) {
      const Fit<Dim>& fit = fluid.fit[i];
      crowd_[i] = fit.floored ? kSpray : fit.m0 / place(fit, model.h).share;
    });
  }

  // The way [m]; `diffusion` is S h c0 t [m^2].
  template <typename Kernel, typename ForFluidNear>
  Vec<Dim> drift(const Model<Dim, Kernel>& model, const ForFluidNear& for_fluid_near,
                 const Particles<Dim>& fluid, std::size_t i, double diffusion) const {
    const double crowd = crowd_[i];
    const Vec<Dim> none = Vec<Dim>::Zero();
    if (crowd == kSpray || fluid.is_buffer(i)) return none;
    const double share = rest(fluid.acceleration[i]);
    if (share < kLeastDrift) return none;
    const Fit<Dim>& fit = fluid.fit[i];
    const Place at = place(fit, model.h);
    if (at.share < kLeastShare) return none;
    const double reach2 = model.kernel.support() * model.kernel.support();
    Vec<Dim> grad_c = none;
    bool sees_spray = false;
    for_fluid_near(i, [&](std::size_t k) {
      const Vec<Dim> x_ki = fluid.node[k].x - fluid.node[i].x;
      if (x_ki.squaredNorm() >= reach2) return;
      const double VW = fluid.node[k].volume * model.kernel.value(x_ki);
      sees_spray = sees_spray || crowd_[k] == kSpray;
      grad_c += (crowd_[k] - crowd) * VW * (fit.g + fit.G * x_ki);
    });
    if (sees_spray) return none;
    Vec<Dim> way = -diffusion * share * grad_c;
    if (at.offset > kSurfaceOffset) {
      const Vec<Dim> normal = at.centre.normalized();
      way -= way.dot(normal) * normal;
    }
    return way;
  }

  // 1 at rest, 0 far from it.
  [[nodiscard]] double rest(const Vec<Dim>& acceleration) const {
    const double limit = kRest * gravity_;
    return 1.0 / (1.0 + acceleration.squaredNorm() / (limit * limit));
  }

  double strength_, gravity_;
  HalfSpace<Dim> half_space_;
  int steps_ = 0;
  double elapsed_ = 0;  // since the last drift [s]
  // Of the drift in hand:
  std::vector<double> crowd_;  // c, or kSpray
  std::vector<Vec<Dim>> drift_;
};

}  // namespace sluice::fluid
