#pragma once

#include <array>
#include <type_traits>

#include "fluid/gradient_sweep.hpp"

namespace sluice::fluid {

template <int Dim, typename Kernel>
struct OperatorGradients : Gradients<Dim> {
  typename Operator<Dim, Kernel>::Coefficients coefficients;
};

// Sweep 1 of the other operators (approximation.hpp) in two passes over the neighbours of particle i:
// moments, from which the coefficients of grad N_j follow, then
//   L = sum_j (v_j - v_i) (x) grad N_j,   grad rho = sum_j (rho_j - rho_i) grad N_j,
// CF (62) in the form (102). The fit is that of MLS for all: it tells spray and the free surface.
template <int Dim, typename Kernel>
class OperatorSweep {
 public:
  OperatorSweep(const Model<Dim, Kernel>& model, const Node<Dim>& i) : model_(model), i_(i) {
    sums_.add(i.volume * model.kernel.at_zero(), 0.0, Vec<Dim>::Zero());
  }

  // At most twice: fluid and boundary.
  void gather(std::span<const std::uint32_t> neighbors, const std::vector<Node<Dim>>& node) {
    near_[count_++] = {neighbors, &node};
    for (const std::uint32_t j : neighbors) {
      const Vec<Dim> x_ji = node[j].x - i_.x;
      const auto [W, F] = model_.kernel.value_and_slope(x_ji);
      sums_.add(node[j].volume * W, node[j].volume * F, x_ji);
    }
  }

  [[nodiscard]] OperatorGradients<Dim, Kernel> finish() const {
    OperatorGradients<Dim, Kernel> result;
    result.fit = fit(sums_.fit, model_.moment_floor);
    result.coefficients = Rule::coefficients(sums_, result.fit, model_.slope_floor);
    result.L = Mat<Dim>::Zero();
    result.grad_rho = Vec<Dim>::Zero();
    for (std::size_t k = 0; k < count_; ++k)
      for (const std::uint32_t j : near_[k].index) add((*near_[k].node)[j], result);
    return result;
  }

 private:
  using Rule = Operator<Dim, Kernel>;
  struct Near {
    std::span<const std::uint32_t> index;
    const std::vector<Node<Dim>>* node = nullptr;
  };

  void add(const Node<Dim>& j, OperatorGradients<Dim, Kernel>& result) const {
    const Vec<Dim> x_ji = j.x - i_.x;
    const Vec<Dim> grad_N =
        j.volume * Rule::gradient(result.coefficients, model_.kernel.value_and_slope(x_ji), x_ji);
    result.L += (j.v - i_.v) * grad_N.transpose();
    result.grad_rho += (j.rho - i_.rho) * grad_N;
  }

  const Model<Dim, Kernel>& model_;
  const Node<Dim>& i_;
  typename Rule::Sums sums_;
  std::array<Near, 2> near_;
  std::size_t count_ = 0;
};

// Sweep 1 of any operator.
template <int Dim, typename Kernel>
struct FirstSweepFor {
  using Type = std::conditional_t<Operator<Dim, Kernel>::kIsDefault, GradientSweep<Dim, Kernel>,
                                  OperatorSweep<Dim, Kernel>>;
};
template <int Dim, typename Kernel>
using FirstSweep = typename FirstSweepFor<Dim, Kernel>::Type;

}  // namespace sluice::fluid
