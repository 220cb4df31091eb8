#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "fluid/types.hpp"

namespace sluice::fluid {

// A symmetric matrix by its upper half, for what is kept of every particle: two thirds of the memory in
// space. What is made of one is a Mat, and a Mat that is symmetric becomes one.
template <int Dim>
class Symmetric {
 public:
  static constexpr std::size_t kEntries = Dim * (Dim + 1) / 2;

  // Place of an entry by rows: xx xy yy, or xx xy xz yy yz zz.
  static constexpr std::size_t place(int a, int b) {
    const int row = a < b ? a : b, column = a < b ? b : a;
    return static_cast<std::size_t>(row * Dim - row * (row - 1) / 2 + column - row);
  }

  Symmetric() = default;
  template <typename Matrix>
  Symmetric(const Eigen::MatrixBase<Matrix>& m) {  // NOLINT: both ways without a word
    for (int a = 0; a < Dim; ++a)
      for (int b = a; b < Dim; ++b) entry_[place(a, b)] = m(a, b);
  }

  [[nodiscard]] double operator()(int a, int b) const { return entry_[place(a, b)]; }
  // The k-th of the upper half.
  [[nodiscard]] double& operator[](std::size_t k) { return entry_[k]; }
  [[nodiscard]] double operator[](std::size_t k) const { return entry_[k]; }

  [[nodiscard]] Mat<Dim> full() const {
    Mat<Dim> m;
    for (int a = 0; a < Dim; ++a)
      for (int b = 0; b < Dim; ++b) m(a, b) = (*this)(a, b);
    return m;
  }
  operator Mat<Dim>() const { return full(); }  // NOLINT

  [[nodiscard]] double norm() const { return full().norm(); }

  Symmetric& operator+=(const Symmetric& other) {
    for (std::size_t k = 0; k < kEntries; ++k) entry_[k] += other.entry_[k];
    return *this;
  }
  friend Symmetric operator+(Symmetric a, const Symmetric& b) { return a += b; }
  template <typename Matrix>
  friend auto operator*(const Symmetric& m, const Eigen::MatrixBase<Matrix>& x) {
    if constexpr (Matrix::ColsAtCompileTime == 1) {
      const Vec<Dim> of = x;
      Vec<Dim> y;
      for (int a = 0; a < Dim; ++a) {
        y[a] = m(a, 0) * of[0];
        for (int b = 1; b < Dim; ++b) y[a] += m(a, b) * of[b];
      }
      return y;
    } else {
      return Mat<Dim>(m.full() * x);
    }
  }
  template <typename Matrix>
  friend Mat<Dim> operator*(const Eigen::MatrixBase<Matrix>& a, const Symmetric& b) {
    return a * b.full();
  }
  friend Mat<Dim> operator*(double a, const Symmetric& b) { return a * b.full(); }

 private:
  std::array<double, kEntries> entry_{};
};

}  // namespace sluice::fluid
