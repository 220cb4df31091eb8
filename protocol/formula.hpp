#pragma once

#include <array>
#include <memory>
#include <stdexcept>
#include <string>

namespace sluice::protocol {

// What a formula's text or value is wrong in.
class FormulaError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// A formula of the place x, y, z [m], e.g. "0.1*sin(pi*x)", and where that is said of the time t [s]. The empty
// formula is zero.
class Formula {
 public:
  // Throws FormulaError with position and token when the text does not parse.
  explicit Formula(const std::string& text, bool has_time = false);
  Formula(Formula&&) noexcept;
  ~Formula();

  // Throws FormulaError naming the place when the value is not finite. Not for several threads at once.
  [[nodiscard]] double at(const std::array<double, 3>& place, double time = 0) const;

 private:
  struct Parser;
  std::unique_ptr<Parser> parser_;  // none: zero
};

}  // namespace sluice::protocol
