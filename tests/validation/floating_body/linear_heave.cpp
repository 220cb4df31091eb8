#include "validation/floating_body/linear_heave.hpp"

#include <Eigen/SparseCholesky>
#include <cmath>

namespace sluice::validation {

namespace {

constexpr double kGravity = 9.81, kDensity = 1000, kStep = 2e-3;

// State: surface elevation and potential of every surface cell, height and speed of the box.
using State = Eigen::VectorXd;

class LinearTank {
 public:
  LinearTank(const HeavingBox& box, double cell)
      : cell_(cell),
        columns_(cells(box.tank)),
        rows_(cells(box.depth)),
        first_(cells((box.tank - box.width) / 2)),
        last_(first_ + cells(box.width)),
        under_(rows_ - cells(box.draft)),
        width_(box.width),
        mass_(kDensity * box.width * box.draft) {
    number_cells();
    factorise();
    const Eigen::VectorXd still = Eigen::VectorXd::Zero(columns_);
    added_mass_ = kDensity * integral_below(solve(still, 1), 1);
  }

  [[nodiscard]] State start(double lift) const {
    State state = State::Zero(2 * columns_ + 2);
    state[2 * columns_] = lift;
    return state;
  }
  [[nodiscard]] double height(const State& state) const { return state[2 * columns_]; }

  // d eta/dt = phi_y,  d phi/dt = -g eta,  (m + m_a) dV/dt = -rho g b z - rho int phi_t dx
  [[nodiscard]] State rate(const State& s) const {
    const Eigen::VectorXd eta = s.head(columns_), phi = s.segment(columns_, columns_);
    const double z = s[2 * columns_], V = s[2 * columns_ + 1];
    State rate = State::Zero(s.size());
    const Eigen::VectorXd inside = solve(phi, V);
    for (int i = 0; i < columns_; ++i)
      if (is_surface(i)) rate[i] = (phi[i] - inside[number(i, rows_ - 1)]) / (cell_ / 2);
    rate.segment(columns_, columns_) = -kGravity * eta;
    const double held = kDensity * integral_below(solve(-kGravity * eta, 0), 0);
    rate[2 * columns_] = V;
    rate[2 * columns_ + 1] = -(kDensity * kGravity * width_ * z + held) / (mass_ + added_mass_);
    return rate;
  }

 private:
  [[nodiscard]] int cells(double length) const { return static_cast<int>(std::lround(length / cell_)); }
  [[nodiscard]] bool is_surface(int i) const { return i < first_ || i >= last_; }
  [[nodiscard]] bool is_fluid(int i, int j) const {
    return i >= 0 && i < columns_ && j >= 0 && j < (is_surface(i) ? rows_ : under_);
  }
  [[nodiscard]] int number(int i, int j) const { return number_[static_cast<std::size_t>(i * rows_ + j)]; }

  void number_cells() {
    number_.assign(static_cast<std::size_t>(columns_ * rows_), -1);
    for (int i = 0; i < columns_; ++i)
      for (int j = 0; j < rows_; ++j)
        if (is_fluid(i, j)) number_[static_cast<std::size_t>(i * rows_ + j)] = count_++;
  }

  void factorise() {
    std::vector<Eigen::Triplet<double>> entries;
    for (int i = 0; i < columns_; ++i)
      for (int j = 0; j < rows_; ++j) {
        if (!is_fluid(i, j)) continue;
        const int here = number(i, j);
        for (const auto& [di, dj] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
          if (!is_fluid(i + di, j + dj)) continue;
          entries.emplace_back(here, here, 1.0);
          entries.emplace_back(here, number(i + di, j + dj), -1.0);
        }
        if (is_surface(i) && j == rows_ - 1) entries.emplace_back(here, here, 2.0);  // half a cell away
      }
    Eigen::SparseMatrix<double> matrix(count_, count_);
    matrix.setFromTriplets(entries.begin(), entries.end());
    solver_.compute(matrix);
  }

  // The potential with these values at the surface and the box moving up at V.
  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& surface, double V) const {
    Eigen::VectorXd right = Eigen::VectorXd::Zero(count_);
    for (int i = 0; i < columns_; ++i) {
      if (is_surface(i))
        right[number(i, rows_ - 1)] += 2 * surface[i];
      else
        right[number(i, under_ - 1)] += cell_ * V;
    }
    return solver_.solve(right);
  }

  // Over the bottom of the box, half a cell above the cells' centres.
  [[nodiscard]] double integral_below(const Eigen::VectorXd& potential, double slope) const {
    double sum = 0;
    for (int i = first_; i < last_; ++i)
      sum += cell_ * (potential[number(i, under_ - 1)] + slope * cell_ / 2);
    return sum;
  }

  double cell_;
  int columns_, rows_, first_, last_, under_, count_ = 0;
  double width_, mass_, added_mass_ = 0;
  std::vector<int> number_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver_;
};

}  // namespace

Curve linear_heave(const HeavingBox& box, double cell, double duration) {
  const LinearTank tank(box, cell);
  State s = tank.start(box.lift);
  Curve curve;
  for (double t = 0; t <= duration; t += kStep) {
    curve.x.push_back(t);
    curve.y.push_back(tank.height(s));
    const State k1 = tank.rate(s), k2 = tank.rate(s + kStep / 2 * k1), k3 = tank.rate(s + kStep / 2 * k2),
                k4 = tank.rate(s + kStep * k3);
    s += kStep / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }
  return curve;
}

}  // namespace sluice::validation
