#include "benchmark/report.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <fstream>

#include "benchmark/formulations.hpp"
#include "benchmark/selection.hpp"

namespace sluice::benchmark {
namespace {

using testing::HasSubstr;
using testing::Not;

Measurement row(const std::string& formulation, int resolution, double error, double seconds) {
  Measurement result;
  result.formulation = formulation;
  result.resolution = resolution;
  result.outcome = {{{"height", "%", 100 * error, 2}, {"left", "%", 90, 80, true}}, error, seconds, 100, 50};
  return result;
}

CaseTable table(std::vector<Measurement> rows, double least_order = NAN) {
  validation::Case what{.name = "drop",
                        .title = "A drop",
                        .reference = "theory",
                        .resolutions = {10, 20},
                        .quick = {10},
                        .bound_resolution = 20,
                        .least_order = least_order,
                        .run = {}};
  CaseTable result{what, std::move(rows)};
  rank(result);
  return result;
}

TEST(Rank, MarksWhatNothingIsBetterThan) {
  const CaseTable t = table({row("a", 10, 0.04, 1), row("a", 20, 0.01, 8), row("b", 10, 0.05, 2),
                             row("b", 20, 0.01, 9), row("c", 10, 0.005, 10)});
  std::vector<bool> front;
  for (const Measurement& m : t.rows) front.push_back(m.on_front);
  EXPECT_EQ(front, (std::vector<bool>{true, true, false, false, true}));
}

TEST(Rank, TakesTheOrderWithinAFormulation) {
  const CaseTable t = table({row("a", 10, 0.04, 1), row("a", 20, 0.01, 8), row("b", 10, 0.05, 2)});
  EXPECT_FALSE(t.rows[0].order);
  EXPECT_NEAR(t.rows[1].order.value(), 2, 1e-12);
  EXPECT_FALSE(t.rows[2].order);
}

TEST(Bounds, HoldFromTheirResolutionOn) {
  EXPECT_FALSE(table({row("a", 10, 0.04, 1), row("a", 20, 0.01, 8)}).any_missed("a"));
  const CaseTable t = table({row("a", 10, 0.04, 1), row("a", 20, 0.03, 8)});
  EXPECT_TRUE(t.any_missed("a"));
  EXPECT_FALSE(t.any_missed("b"));
  EXPECT_THAT(to_text(t), HasSubstr("3 %; at most 2: MISSED"));
  EXPECT_THAT(to_text(t), HasSubstr("90 %; at least 80\n"));
  EXPECT_THAT(to_text(t), Not(HasSubstr("4 %;")));
}

TEST(Bounds, HoldOfTheOrderWhereOneIsStated) {
  const std::vector<Measurement> rows{row("a", 10, 0.04, 1), row("a", 20, 0.01, 8)};
  EXPECT_FALSE(table(rows, 1.8).any_missed("a"));
  EXPECT_TRUE(table(rows, 2.2).any_missed("a"));
  EXPECT_THAT(to_text(table(rows, 2.2)), HasSubstr("at least 2.2: MISSED"));
}

TEST(Bounds, AreMissedByARunThatFails) {
  Measurement failed = row("a", 20, 0, 0);
  failed.failure = "it blew \"up\"";
  const CaseTable t = table({row("a", 10, 0.04, 1), failed});
  EXPECT_TRUE(t.any_missed("a"));
  EXPECT_THAT(to_text(t), HasSubstr("FAILED: it blew"));
  EXPECT_THAT(to_csv({t}), HasSubstr("drop,a,20,,,,,,,,,,,,,\"it blew \"\"up\"\"\"\n"));
}

TEST(Csv, HasALineAFigure) {
  const std::string text = to_csv({table({row("a", 20, 0.03, 8)})});
  EXPECT_THAT(text, HasSubstr("drop,a,20,100,50,0.03,,8,625,1,\"height\",\"%\",3,2,1,\n"));
  EXPECT_THAT(text, HasSubstr("drop,a,20,100,50,0.03,,8,625,1,\"left\",\"%\",90,80,0,\n"));
}

TEST(Readme, SaysWhatTheErrorOfEveryCaseIs) {
  std::ifstream file(SLUICE_SOURCE "/tests/benchmark/README.md");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  for (const validation::Case& what : validation::all_cases())
    EXPECT_THAT(text, HasSubstr("\n| `" + what.name + "` |"));
}

TEST(Selection, NamesWhatThereIs) {
  EXPECT_EQ(select(all_formulations(), {"default"}, "formulation").size(), 1u);
  try {
    select(all_formulations(), {"best"}, "formulation");
    FAIL();
  } catch (const protocol::InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("there is no formulation 'best'; there are default, "));
  }
}

}  // namespace
}  // namespace sluice::benchmark
