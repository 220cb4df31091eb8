#include "benchmark/report.hpp"

#include <fmt/format.h>

#include <cmath>

#include "protocol/error.hpp"

namespace sluice::benchmark {

namespace {

using validation::Figure;

double rate(const validation::Outcome& o) {
  return static_cast<double>(o.particles * o.steps) / o.seconds;
}

std::string figure_text(const CaseTable& table, const Measurement& row, const Figure& figure) {
  std::string text = fmt::format("      {:<36}{:>12.4g} {}", figure.name, figure.value, figure.unit);
  if (!table.bounded(row) || std::isnan(figure.bound)) return text + "\n";
  return text + fmt::format("; {} {:g}{}\n", figure.at_least ? "at least" : "at most", figure.bound,
                            table.missed(row, figure) ? ": MISSED" : "");
}

std::string row_text(const CaseTable& table, const Measurement& row) {
  const std::string name = fmt::format("  {:<16}{:>11}", row.formulation, row.resolution);
  if (!row.failure.empty()) return name + "  FAILED: " + row.failure + "\n";
  const validation::Outcome& o = row.outcome;
  std::string text = name + fmt::format("{:>11}{:>12.3e}{:>7}{:>11.2f}{:>15.3f}{:>7}\n", o.particles, o.error,
                                        row.order ? fmt::format("{:.1f}", *row.order) : "", o.seconds,
                                        1e-6 * rate(o), row.on_front ? "*" : "");
  for (const Figure& figure : o.figures) text += figure_text(table, row, figure);
  return text;
}

std::string csv_lines(const CaseTable& table, const Measurement& row) {
  const std::string run = fmt::format("{},{},{}", table.what.name, row.formulation, row.resolution);
  if (!row.failure.empty()) return run + ",,,,,,,,,,,,," + csv_field(row.failure) + "\n";
  const validation::Outcome& o = row.outcome;
  std::string text;
  for (const Figure& figure : o.figures) {
    const bool bounded = table.bounded(row) && !std::isnan(figure.bound);
    text += fmt::format("{},{},{},{:.6g},{},{:.4g},{:.6g},{:d},{},{},{:.6g},{},\n", run, o.particles, o.steps,
                        o.error, row.order ? fmt::format("{:.3f}", *row.order) : "", o.seconds, rate(o),
                        row.on_front, csv_field(figure.name), csv_field(figure.unit), figure.value,
                        bounded ? fmt::format("{:g},{:d}", figure.bound, table.missed(row, figure)) : ",");
  }
  return text;
}

}  // namespace

std::ofstream open_output(const std::string& path) {
  std::ofstream file(path);
  if (!file) throw protocol::InputError(path + ": cannot be written; name a file in an existing directory");
  return file;
}

std::string csv_field(std::string text) {
  for (auto at = text.find('"'); at != std::string::npos; at = text.find('"', at + 2))
    text.insert(at, 1, '"');
  return '"' + text + '"';
}

std::string to_text(const CaseTable& table) {
  std::string text =
      fmt::format("{}: {}\n  reference: {}\n  {:<16}{:>11}{:>11}{:>12}{:>7}{:>11}{:>15}{:>7}\n",
                  table.what.name, table.what.title, table.what.reference, "formulation", "resolution",
                  "particles", "error", "order", "time [s]", "steps/s [1e6]", "front");
  for (const Measurement& row : table.rows) text += row_text(table, row);
  return text;
}

std::string to_csv(const std::vector<CaseTable>& tables) {
  std::string text =
      "case,formulation,resolution,particles,steps,error,order,seconds,particle_steps_per_s,on_front,figure,"
      "unit,"
      "value,bound,missed,failure\n";
  for (const CaseTable& table : tables)
    for (const Measurement& row : table.rows) text += csv_lines(table, row);
  return text;
}

}  // namespace sluice::benchmark
