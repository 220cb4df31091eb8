#pragma once

#include <algorithm>
#include <span>
#include <stdexcept>
#include <vector>

#include "rigid/kinematics.hpp"
#include "rigid/motion.hpp"
#include "rigid/shape.hpp"

namespace sluice::rigid {

// A state as a row of numbers and back: both visit the same values in the same order.
template <typename Derived>
class NumberVisitor {
 public:
  void visit(double& value) { self().numbers(&value, 1); }
  void visit(Eigen::Vector3d& v) { self().numbers(v.data(), 3); }
  void visit(Eigen::Quaterniond& q) { self().numbers(q.coeffs().data(), 4); }
  void visit(Wrench& wrench) { visit_all(wrench.force, wrench.moment); }
  void visit(Pose& pose) { visit_all(pose.position, pose.orientation); }
  void visit(Offset& at) {
    visit_all(at.position, at.rotation, at.velocity, at.angular_velocity, at.acceleration,
              at.angular_acceleration);
  }
  template <typename... Values>
  void visit_all(Values&... values) {
    (visit(values), ...);
  }

 private:
  Derived& self() { return static_cast<Derived&>(*this); }
};

class NumberWriter : public NumberVisitor<NumberWriter> {
 public:
  void numbers(const double* values, std::size_t count) { row_.insert(row_.end(), values, values + count); }
  [[nodiscard]] std::vector<double> take() { return std::move(row_); }

 private:
  std::vector<double> row_;
};

class NumberReader : public NumberVisitor<NumberReader> {
 public:
  explicit NumberReader(std::span<const double> row) : row_(row) {}
  // Throws std::invalid_argument when the row ends too early.
  void numbers(double* values, std::size_t count) {
    if (count > row_.size()) throw std::invalid_argument("the state of the bodies ends too early");
    std::copy_n(row_.begin(), count, values);
    row_ = row_.subspan(count);
  }
  [[nodiscard]] std::span<const double> rest() const { return row_; }

 private:
  std::span<const double> row_;
};

}  // namespace sluice::rigid
