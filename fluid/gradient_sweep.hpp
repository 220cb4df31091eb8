#pragma once

#include <span>

#include "fluid/model.hpp"
#include "fluid/moments.hpp"
#include "fluid/particles.hpp"

namespace sluice::fluid {

// The linear fits of velocity and density at a particle.
template <int Dim>
struct Gradients {
  Fit<Dim> fit;
  Mat<Dim> L;         // velocity gradient, L_ab = dv_a/dx_b [1/s]
  Vec<Dim> grad_rho;  // [kg/m^4]
};

// Sweep 1: one pass over the neighbours of particle i collects
//   m0, m1, m2,   P = sum V W v_ji,   Q = sum V W v_ji (x) x_ji,   and the same of the density,
// from which L = P (x) g + Q G, CF (62). Differences to i may be used because sum grad N = 0, CF (103).
template <int Dim, typename Kernel = WendlandC2<Dim>>
class GradientSweep {
 public:
  GradientSweep(const Model<Dim, Kernel>& model, const Node<Dim>& i) : model_(model), i_(i) {
    moments_.add(i.volume * model.kernel.at_zero(), Vec<Dim>::Zero());
  }

  void gather(std::span<const std::uint32_t> neighbors, const std::vector<Node<Dim>>& node) {
    for (const std::uint32_t j : neighbors) add(node[j]);
  }

  [[nodiscard]] Gradients<Dim> finish() const {
    Gradients<Dim> result;
    result.fit = fit(moments_, model_.moment_floor);
    result.L = P_ * result.fit.g.transpose() + Q_ * result.fit.G;
    result.grad_rho = p_ * result.fit.g + result.fit.G * q_;
    return result;
  }

 private:
  void add(const Node<Dim>& j) {
    const Vec<Dim> x_ji = j.x - i_.x;
    const double VW = j.volume * model_.kernel.value(x_ji);
    moments_.add(VW, x_ji);
    const Vec<Dim> VWv = VW * (j.v - i_.v);
    P_ += VWv;
    Q_ += VWv * x_ji.transpose();
    const double VWrho = VW * (j.rho - i_.rho);
    p_ += VWrho;
    q_ += VWrho * x_ji;
  }

  const Model<Dim, Kernel>& model_;
  const Node<Dim>& i_;
  Moments<Dim> moments_;
  Vec<Dim> P_ = Vec<Dim>::Zero();
  Mat<Dim> Q_ = Mat<Dim>::Zero();
  double p_ = 0;
  Vec<Dim> q_ = Vec<Dim>::Zero();
};

}  // namespace sluice::fluid
