#include "clients/sluice/progress.hpp"

#include <gmock/gmock.h>

#include <sstream>

namespace sluice::clients {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::HasSubstr;

const Position kHalfway{0.15, 0.3, 500, 1000, 100};

TEST(Progress, ABarShowsTimeSpeedAndWhatIsLeft) {
  const std::string line = bar_line(kHalfway, 120);
  EXPECT_THAT(line, HasSubstr("[====================>                   ]"));
  EXPECT_THAT(line, HasSubstr("50.0 %"));
  EXPECT_THAT(line, HasSubstr("0.1500 / 0.3000 s"));
  EXPECT_THAT(line, HasSubstr("100 steps/s"));
  EXPECT_THAT(line, HasSubstr("ETA 0:05"));
}

TEST(Progress, ABarNeverExceedsTheTerminal) {
  for (std::size_t columns = 0; columns < 200; ++columns)
    EXPECT_LE(bar_line(kHalfway, columns).size(), columns);
}

TEST(Progress, ABarIsFullAtTheEndAndEmptyAtTheStart) {
  EXPECT_THAT(bar_line({0.3, 0.3, 1000, 1000, 100}, 120), HasSubstr("[" + std::string(40, '=') + "]"));
  EXPECT_THAT(bar_line({0, 0.3, 0, 1000, 0}, 120), HasSubstr("[>" + std::string(39, ' ') + "]"));
  EXPECT_THAT(bar_line({0, 0.3, 0, 1000, 0}, 120), HasSubstr("ETA -:--"));
}

TEST(Progress, ClockTextGrowsWithTheTime) {
  EXPECT_EQ(clock_text(0), "0:00");
  EXPECT_EQ(clock_text(67.4), "1:07");
  EXPECT_EQ(clock_text(11045), "3:04:05");
  EXPECT_EQ(clock_text(-1), "-:--");
}

class Rhythm : public testing::Test {
 protected:
  LineRhythm rhythm;
  const LineRhythm::Instant start = std::chrono::steady_clock::now();
};

TEST_F(Rhythm, ALineAtEachTenth) {
  int lines = 0;
  for (int percent = 0; percent <= 100; ++percent)
    lines += rhythm.due(0.01 * percent, start + percent * seconds(1));
  EXPECT_EQ(lines, 11);
}

TEST_F(Rhythm, NeverTwoWithinTwoSeconds) {
  int lines = 0;
  for (int k = 0; k <= 1000; ++k)
    lines += rhythm.due(0.001 * k, start + k * milliseconds(10));  // ten seconds in all
  EXPECT_LE(lines, 6);
  EXPECT_GE(lines, 5);
}

TEST_F(Rhythm, ASlowRunShowsThatItLives) {
  EXPECT_TRUE(rhythm.due(0, start));
  EXPECT_FALSE(rhythm.due(0.001, start + seconds(59)));
  EXPECT_TRUE(rhythm.due(0.002, start + seconds(61)));
}

TEST(Progress, LinesHaveNoControlCharacters) {
  std::ostringstream out;
  Progress progress(out, false, 80);
  progress.show(kHalfway);
  progress.clear();
  EXPECT_EQ(out.str(), plain_line(kHalfway) + "\n");
}

TEST(Progress, ATerminalsLineIsRedrawnAndRemoved) {
  std::ostringstream out;
  Progress progress(out, true, 80);
  progress.show(kHalfway);
  progress.clear();
  EXPECT_EQ(out.str(), "\r" + bar_line(kHalfway, 80) + "\033[K\r\033[K");
}

}  // namespace
}  // namespace sluice::clients
