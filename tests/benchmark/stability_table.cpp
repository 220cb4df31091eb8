#include "benchmark/stability_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "benchmark/report.hpp"

namespace sluice::benchmark {

namespace {

using validation::Figure;

constexpr int kWidth = 16;  // of a column

std::string heading(const StabilityTable::Column& column) {
  return column.unit.empty() ? column.name : fmt::format("{} [{}]", column.name, column.unit);
}

std::string row_text(const StabilityTable& table, const StabilityTable::Row& row) {
  std::string text = fmt::format("  {:<34}", row.item);
  for (std::size_t c = 0; c < row.values.size(); ++c)
    text += fmt::format("{:>{}.4g}", row.values[c],
                        std::max<std::size_t>(kWidth, heading(table.columns[c]).size() + 2));
  return text + (row.note.empty() ? "" : "  " + row.note) + "\n";
}

std::string figure_text(const Figure& figure) {
  std::string text = fmt::format("      {:<46}{:>12.4g} {}", figure.name, figure.value, figure.unit);
  if (std::isnan(figure.bound)) return text + "\n";
  return text + fmt::format("; {} {:g}{}\n", figure.at_least ? "at least" : "at most", figure.bound,
                            figure.missed() ? ": MISSED" : "");
}

}  // namespace

bool StabilityTable::any_missed() const {
  return std::any_of(figures.begin(), figures.end(), [](const Figure& f) { return f.missed(); });
}

std::string to_text(const StabilityTable& table) {
  std::string text = fmt::format("{}: {}\n", table.name, table.title);
  if (!table.rows.empty()) {
    text += fmt::format("  {:<34}", table.items);
    for (const auto& column : table.columns) {
      const std::string name = heading(column);
      text += fmt::format("{:>{}}", name, std::max<std::size_t>(kWidth, name.size() + 2));
    }
    text += "\n";
  }
  for (const auto& row : table.rows) text += row_text(table, row);
  for (const Figure& figure : table.figures) text += figure_text(figure);
  return text;
}

std::string to_csv(const std::vector<StabilityTable>& tables) {
  std::string text = "check,item,quantity,unit,value,bound,missed,note\n";
  for (const StabilityTable& table : tables) {
    for (const auto& row : table.rows)
      for (std::size_t c = 0; c < row.values.size(); ++c)
        text += fmt::format("{},{},{},{},{:.6g},,,{}\n", table.name, csv_field(row.item),
                            csv_field(table.columns[c].name), csv_field(table.columns[c].unit), row.values[c],
                            row.note.empty() ? "" : csv_field(row.note));
    for (const Figure& figure : table.figures)
      text += fmt::format(
          "{},,{},{},{:.6g},{},\n", table.name, csv_field(figure.name), csv_field(figure.unit), figure.value,
          std::isnan(figure.bound) ? "," : fmt::format("{:g},{:d}", figure.bound, figure.missed()));
  }
  return text;
}

}  // namespace sluice::benchmark
