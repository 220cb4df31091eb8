#include "protocol/formula.hpp"

#include <fmt/format.h>
#include <muParser.h>

#include <array>
#include <cmath>
#include <numbers>

namespace sluice::protocol {

struct Formula::Parser {
  std::string text;
  mu::Parser parser;
  std::array<double, 3> place{};  // the parser holds their addresses
  double time = 0;
  bool has_time = false;
};

Formula::Formula(const std::string& text, bool has_time) {
  if (text.empty()) return;
  parser_ = std::make_unique<Parser>();
  parser_->text = text;
  mu::Parser& parser = parser_->parser;
  for (const int axis : {0, 1, 2}) parser.DefineVar(std::string(1, "xyz"[axis]), &parser_->place[axis]);
  if (has_time) parser.DefineVar("t", &parser_->time);
  parser_->has_time = has_time;
  parser.DefineConst("pi", std::numbers::pi);
  int results = 0;
  try {
    parser.SetExpr(text);
    parser.Eval(results);
  } catch (const mu::Parser::exception_type& error) {
    throw FormulaError(fmt::format(
        "formula '{}', position {}, token '{}': {} (known are x, y, z, {}pi and functions such as sin, sqrt, "
        "exp, min)",
        text, error.GetPos() + 1, error.GetToken(), error.GetMsg(), has_time ? "t, " : ""));
  }
  if (results != 1) throw FormulaError(fmt::format("formula '{}' has {} values; give one", text, results));
  if (parser_->place != std::array<double, 3>{} || parser_->time != 0)
    throw FormulaError(fmt::format("formula '{}' assigns to a coordinate; write == to compare", text));
}

Formula::Formula(Formula&&) noexcept = default;
Formula::~Formula() = default;

double Formula::at(const std::array<double, 3>& place, double time) const {
  if (!parser_) return 0;
  parser_->place = place;
  parser_->time = time;
  const double value = parser_->parser.Eval();
  if (!std::isfinite(value))
    throw FormulaError(fmt::format(
        "formula '{}' is {} at ({:g}, {:g}, {:g}) m{}; it must be finite wherever {}", parser_->text, value,
        place[0], place[1], place[2], parser_->has_time ? fmt::format(", t = {:g} s", time) : "",
        parser_->has_time ? "and whenever it is asked for" : "the region has a particle"));
  return value;
}

}  // namespace sluice::protocol
