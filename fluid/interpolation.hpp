#pragma once

#include <span>

#include "fluid/approximation.hpp"
#include "fluid/model.hpp"

namespace sluice::fluid {

// The velocity of the fluid at particle i, CF (75) in the form (79), which leaves a uniform velocity as it
// is:
//   v-hat_i = v_i + sum_j (v_j - v_i) N_j(x_i),   N_j = V_j W (a + b.x_ji), b = 0 for Shepard's.
// Operators whose shape functions have not the sum one are not asked. Cost: a sweep like sweep 1.
template <int Dim, typename Kernel>
class VelocityInterpolation {
 public:
  VelocityInterpolation(const Model<Dim, Kernel>& model, const Node<Dim>& i) : model_(model), i_(i) {
    moments_.add(i.volume * model.kernel.at_zero(), Vec<Dim>::Zero());
  }

  void gather(std::span<const std::uint32_t> neighbors, const std::vector<Node<Dim>>& node) {
    for (const std::uint32_t j : neighbors) {
      const Vec<Dim> x_ji = node[j].x - i_.x;
      const double VW = node[j].volume * model_.kernel.value(x_ji);
      moments_.add(VW, x_ji);
      const Vec<Dim> VWv = VW * (node[j].v - i_.v);
      P_ += VWv;
      Q_ += VWv * x_ji.transpose();
    }
  }

  [[nodiscard]] Vec<Dim> finish() const {
    const ShapeFunction<Dim> N = Operator<Dim, Kernel>::shape_function(fit(moments_, model_.moment_floor));
    return i_.v + N.a * P_ + Q_ * N.b;
  }

 private:
  const Model<Dim, Kernel>& model_;
  const Node<Dim>& i_;
  Moments<Dim> moments_;
  Vec<Dim> P_ = Vec<Dim>::Zero();
  Mat<Dim> Q_ = Mat<Dim>::Zero();
};

}  // namespace sluice::fluid
