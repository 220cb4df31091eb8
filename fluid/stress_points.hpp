#pragma once

#include <array>
#include <span>

#include "fluid/operator_sweep.hpp"

namespace sluice::fluid {

// Sweep 1 for stress points: the sums of GradientSweep at the particle, and at each of its points the moments
// and the interpolated difference of the density to the particle's, CF (49).
template <int Dim, typename Kernel>
class StressPointSweep {
 public:
  StressPointSweep(const Model<Dim, Kernel>& model, const Node<Dim>& i)
      : model_(model), i_(i), center_(model, i) {
    for (std::size_t s = 0; s < Rule::kPoints; ++s)
      point_[s].moments.add(i.volume * model.kernel.value(model.points[s]), -model.points[s]);
  }

  void gather(std::span<const std::uint32_t> neighbors, const std::vector<Node<Dim>>& node) {
    center_.gather(neighbors, node);
    for (const std::uint32_t j : neighbors) {
      const Vec<Dim> x_ji = node[j].x - i_.x;
      for (std::size_t s = 0; s < Rule::kPoints; ++s) {
        const Vec<Dim> x_js = x_ji - model_.points[s];
        const double VW = node[j].volume * model_.kernel.value(x_js);
        point_[s].moments.add(VW, x_js);
        point_[s].rho += VW * (node[j].rho - i_.rho);
        point_[s].rho_x += VW * (node[j].rho - i_.rho) * x_js;
      }
    }
  }

  [[nodiscard]] OperatorGradients<Dim, Kernel> finish() const {
    OperatorGradients<Dim, Kernel> result;
    static_cast<Gradients<Dim>&>(result) = center_.finish();
    for (std::size_t s = 0; s < Rule::kPoints; ++s) {
      const Fit<Dim> f = fit(point_[s].moments, model_.moment_floor);
      const bool spray = f.floored || result.fit.floored;
      const double difference = spray ? 0.0 : shape_constant(f) * point_[s].rho + f.g.dot(point_[s].rho_x);
      result.coefficients[s] = {f.g, f.G, difference, f.floored};
    }
    return result;
  }

 private:
  using Rule = Operator<Dim, Kernel>;
  struct Point {
    Moments<Dim> moments;
    double rho = 0;
    Vec<Dim> rho_x = Vec<Dim>::Zero();
  };

  const Model<Dim, Kernel>& model_;
  const Node<Dim>& i_;
  GradientSweep<Dim, Kernel> center_;
  std::array<Point, Rule::kPoints> point_;
};

template <int Dim, typename Base>
struct FirstSweepFor<Dim, WithStressPoints<Base>> {
  using Type = StressPointSweep<Dim, WithStressPoints<Base>>;
};

}  // namespace sluice::fluid
