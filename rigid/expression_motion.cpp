#include <fmt/format.h>
#include <muParser.h>

#include <array>
#include <cmath>
#include <numbers>

#include "rigid/difference.hpp"
#include "rigid/motion.hpp"

namespace sluice::rigid {
namespace {

// Distance of the samples for derivatives [s]. With the seven-point stencil a motion A sin(w t) has its
// acceleration to a relative (w h)^6 / 560, 2e-6 at 200 Hz, plus round-off of about 6e-16 A / h^2 = 1.5e-8 A
// / s^2. A kink in the formula is smeared over 3 h to each side. Within 3 h of t = 0 the stencil stands to
// the right of t, because a formula need not be defined before 0; the error is then of fifth order for the
// acceleration.
constexpr double kStep = 2e-4;

class Formula {
 public:
  Formula(std::string part, const std::string& text) : part_(std::move(part)), text_(text) {
    if (text_.empty()) return;
    parser_.DefineVar("t", &t_);
    parser_.DefineConst("pi", std::numbers::pi);
    try {
      parser_.SetExpr(text_);
      int results = 0;
      parser_.Eval(results);
      if (results != 1)
        throw MotionError(part_, fmt::format("formula '{}' has {} values; give one", text_, results));
    } catch (const mu::Parser::exception_type& error) {
      throw MotionError(
          part_, fmt::format("formula '{}', position {}, token '{}': {} (known are t, pi and functions "
                             "such as sin, sqrt, exp, min)",
                             text_, error.GetPos() + 1, error.GetToken(), error.GetMsg()));
    }
    if (t_ != 0)
      throw MotionError(part_, fmt::format("formula '{}' assigns to t; write == to compare", text_));
  }
  Formula(const Formula&) = delete;  // the parser holds the address of t_
  Formula& operator=(const Formula&) = delete;

  Derivatives at(double t) const {
    if (text_.empty()) return {0, 0, 0};
    const double center = std::max(t, 3 * kStep);
    std::array<double, kStencil> samples{};
    for (int k = 0; k < kStencil; ++k) samples[k] = evaluate(center + (k - 3) * kStep);
    Derivatives result = differentiate(samples, (t - center) / kStep, kStep);
    result.value = evaluate(t);
    return result;
  }

 private:
  double evaluate(double t) const {
    t_ = std::max(t, 0.0);
    const double value = parser_.Eval();
    if (!std::isfinite(value))
      throw MotionError(
          part_, fmt::format("formula '{}' is {} at t = {:g} s; it must be finite over the whole run", text_,
                             value, t_));
    return value;
  }

  std::string part_, text_;
  mutable double t_ = 0;
  mu::Parser parser_;
};

class ExpressionMotion final : public Motion {
 public:
  explicit ExpressionMotion(const Formulas& f)
      : x_("x", f.x), y_("y", f.y), z_("z", f.z), angle_("angle", f.angle) {}

  Offset at(double t) const override {
    const Derivatives x = x_.at(t), y = y_.at(t), z = z_.at(t), angle = angle_.at(t);
    Offset offset;
    offset.position = {x.value, y.value, z.value};
    offset.rotation.z() = angle.value;
    offset.velocity = {x.first, y.first, z.first};
    offset.angular_velocity.z() = angle.first;
    offset.acceleration = {x.second, y.second, z.second};
    offset.angular_acceleration.z() = angle.second;
    return offset;
  }

 private:
  Formula x_, y_, z_, angle_;
};

}  // namespace

MotionPtr expression_motion(const Formulas& formulas) {
  return std::make_shared<ExpressionMotion>(formulas);
}

}  // namespace sluice::rigid
