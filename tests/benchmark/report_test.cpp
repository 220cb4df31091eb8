#include "benchmark/report.hpp"

#include <gmock/gmock.h>

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

CaseTable table(std::vector<Measurement> rows) {
  rank(rows);
  validation::Case what{"drop", "A drop", "theory", {10, 20}, {10}, 20, {}};
  return {what, rows};
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
