#pragma once

#include <string>
#include <vector>

#include "validation/support/case.hpp"

namespace sluice::benchmark {

// What one check of the stability benchmark found: a line an item, and figures with what is stated of them.
struct StabilityTable {
  struct Column {
    std::string name, unit;
  };
  struct Row {
    std::string item;
    std::vector<double> values;  // one a column
    std::string note;
  };

  std::string name, title;
  std::string items;  // what a row is about
  std::vector<Column> columns;
  std::vector<Row> rows;
  std::vector<validation::Figure> figures;

  [[nodiscard]] bool any_missed() const;
};

// For reading; and one line a value and a figure, with a line of column names.
std::string to_text(const StabilityTable& table);
std::string to_csv(const std::vector<StabilityTable>& tables);

}  // namespace sluice::benchmark
