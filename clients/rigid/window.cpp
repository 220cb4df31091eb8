#include "clients/rigid/window.hpp"

#include <cmath>
#include <stdexcept>
#include <utility>

namespace sluice::clients {
namespace {

using rigid::Wrench;

Wrench operator+(const Wrench& a, const Wrench& b) {
  return {a.force + b.force, a.moment + b.moment};
}
Wrench operator-(const Wrench& a, const Wrench& b) {
  return {a.force - b.force, a.moment - b.moment};
}
Wrench operator*(double s, const Wrench& w) {
  return {s * w.force, s * w.moment};
}

// The explicit guess lies on the line through the mean of the last window, at its middle, and the force at
// its end; this far from the middle, in half windows, so a quarter of a window ahead. An impulse I where I -
// J was guessed makes the energy I.J/2m. A guess that lags gives J the sign of the change of I, and the I.J
// add up to the squares of the changes; one that is half a window ahead takes energy away, and is the first
// to be unstable. Measured in server/README.md, "Light bodies".
constexpr double kAhead = 1.5;

}  // namespace

Window::Window(rigid::World& world, const Coupling& coupling, const Eigen::Vector3d& gravity,
               std::span<const double> indicators, Wrenches initial)
    : world_(world),
      is_implicit_(coupling.scheme() == IMPLICIT),
      tolerance_(coupling.tolerance()),
      most_iterations_(static_cast<int>(coupling.most_iterations())),
      gravity_(gravity) {
  for (std::size_t b = 0; b < world_.size(); ++b)
    aitken_.emplace_back(1.0 / (1.0 + (b < indicators.size() ? indicators[b] : 0.0)));
  world_.start(initial);
  mean_ = initial;
  guess_.push_back(std::move(initial));
}

void Window::begin(std::vector<Step> steps) {
  steps_ = std::move(steps);
  const Wrenches known = guess_.back();
  Wrenches ahead = known;
  if (!is_implicit_)
    for (std::size_t b = 0; b < ahead.size(); ++b) ahead[b] = mean_[b] + kAhead * (known[b] - mean_[b]);
  guess_.assign(steps_.size() + 1, ahead);
  guess_.front() = known;
  residuals_.clear();
  iterations_ = 0;
  if (is_implicit_) world_.save();
}

Wrench Window::mean_guess(std::size_t step, std::size_t body) const {
  return 0.5 * (guess_[step][body] + guess_[step + 1][body]);
}

std::vector<Window::Motion> Window::predict() {
  std::vector<Motion> motion;
  if (iterations_ > 0) world_.restore();
  for (std::size_t k = 0; k < steps_.size(); ++k) {
    Wrenches after = guess_[k + 1];
    if (is_implicit_) {
      for (std::size_t b = 0; b < after.size(); ++b) after[b] = mean_guess(k, b);
      world_.start(after);
    }
    motion.push_back(world_.predict(steps_[k].end, steps_[k].length));
    if (is_implicit_ || k + 1 < steps_.size()) world_.correct(steps_[k].length, after);
  }
  ++iterations_;
  return motion;
}

// What the answer gave to the fluid's steps, by kicks with the forces at both ends of each, less what predict
// gave to the body.
Wrench Window::missing_impulse(const std::vector<Wrenches>& answer, std::size_t body) const {
  Wrench sum;
  for (std::size_t k = 0; k < steps_.size(); ++k) {
    double share = 0.5 * steps_[k].length;
    if (k + 1 < steps_.size()) {
      share += 0.5 * steps_[k + 1].length;
    } else if (!is_implicit_) {
      continue;  // the last kick is still to come
    }
    sum = sum + share * (answer[k][body] - guess_[k + 1][body]);
  }
  return sum;
}

double Window::relative(const Wrench& missing, std::size_t body) const {
  Wrench given, weight;
  for (std::size_t k = 0; k < steps_.size(); ++k) {
    given = given + steps_[k].length * mean_guess(k, body);
    weight.force += steps_[k].length * world_.mass(body) * gravity_;
  }
  const double scale =
      std::sqrt(world_.impulse_energy(body, given)) + std::sqrt(world_.impulse_energy(body, weight));
  const double change = std::sqrt(world_.impulse_energy(body, missing));
  return change > 0.0 ? change / (scale + change) : 0.0;
}

bool Window::accept(const std::vector<Wrenches>& answer) {
  Wrenches missing(world_.size());
  residual_ = 0;
  for (std::size_t b = 0; b < world_.size(); ++b) {
    if (!world_.is_free(b)) continue;
    missing[b] = missing_impulse(answer, b);
    residual_ = std::max(residual_, relative(missing[b], b));
  }
  if (is_implicit_ && residual_ > tolerance_ && iterations_ < most_iterations_) {
    relax(answer);
    return false;
  }
  finish(answer, missing);
  return true;
}

void Window::finish(const std::vector<Wrenches>& answer, const Wrenches& missing) {
  world_.push(missing);
  if (is_implicit_) {
    world_.start(answer.back());
  } else {
    world_.correct(steps_.back().length, answer.back());
  }
  guess_.back() = answer.back();
  mean_ = answer.back();
  for (std::size_t b = 0; b < mean_.size(); ++b) {
    for (std::size_t k = 0; k + 1 < answer.size(); ++k) mean_[b] = mean_[b] + answer[k][b];
    mean_[b] = 1.0 / static_cast<double>(answer.size()) * mean_[b];
  }
}

std::vector<double> Window::write_state() {
  std::vector<double> row = world_.write_state();
  for (std::size_t b = 0; b < world_.size(); ++b) {
    row.insert(row.end(), mean_[b].force.begin(), mean_[b].force.end());
    row.insert(row.end(), mean_[b].moment.begin(), mean_[b].moment.end());
    row.push_back(aitken_[b].omega());
  }
  return row;
}

void Window::read_state(std::span<const double> row) {
  constexpr std::size_t kOwn = 7;  // numbers of a body here
  const std::span<const double> own = world_.read_state(row);
  if (own.size() != kOwn * world_.size())
    throw std::invalid_argument("the state of the bodies is that of another scene");
  for (std::size_t b = 0; b < world_.size(); ++b) {
    const double* numbers = own.data() + kOwn * b;
    mean_[b] = {Eigen::Vector3d(numbers), Eigen::Vector3d(numbers + 3)};
    aitken_[b].set_omega(numbers[6]);
  }
}

// Residuals are measured by what their impulses would do to the body.
void Window::relax(const std::vector<Wrenches>& answer) {
  std::vector<Wrenches> now = answer;
  for (std::size_t b = 0; b < world_.size(); ++b) {
    if (!world_.is_free(b)) continue;
    double old_dot_change = 0, change_dot_change = 0;
    for (std::size_t k = 0; k < now.size(); ++k) {
      now[k][b] = answer[k][b] - guess_[k + 1][b];
      if (residuals_.empty()) continue;
      const Wrench& old = residuals_[k][b];
      const Wrench change = now[k][b] - old;
      // <a, b> = (|a + b|^2 - |a - b|^2)/4
      old_dot_change += 0.25 * (world_.impulse_energy(b, now[k][b]) - world_.impulse_energy(b, old - change));
      change_dot_change += world_.impulse_energy(b, change);
    }
    const double omega =
        residuals_.empty() ? aitken_[b].omega() : aitken_[b].update(old_dot_change, change_dot_change);
    for (std::size_t k = 0; k < now.size(); ++k) guess_[k + 1][b] = guess_[k + 1][b] + omega * now[k][b];
  }
  residuals_ = std::move(now);
}

}  // namespace sluice::clients
