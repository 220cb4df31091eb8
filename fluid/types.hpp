#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace sluice::fluid {

template <int Dim>
using Vec = Eigen::Matrix<double, Dim, 1>;

template <int Dim>
using Mat = Eigen::Matrix<double, Dim, Dim>;

// The first Dim entries of a vector of the interface, which is three-dimensional for both dimensions.
template <int Dim>
Vec<Dim> narrow(const Eigen::Vector3d& v) {
  return v.head<Dim>();
}

template <int Dim>
Eigen::Vector3d widen(const Vec<Dim>& v) {
  Eigen::Vector3d w = Eigen::Vector3d::Zero();
  w.template head<Dim>() = v;
  return w;
}

// The larger of two; not-a-number wins, so that a lost particle is not overlooked.
inline double larger(double a, double b) {
  return b > a || b != b ? b : a;
}

}  // namespace sluice::fluid
