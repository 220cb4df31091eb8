#include "clients/replay/playback.hpp"

#include <gmock/gmock.h>

#include "protocol/error.hpp"

namespace sluice::clients {
namespace {

using std::chrono::milliseconds;
using Clock = Playback::Clock;

// Eleven frames, a tenth of a second apart.
class PlaybackTest : public testing::Test {
 protected:
  static std::vector<std::int64_t> times() {
    std::vector<std::int64_t> all;
    for (std::int64_t k = 0; k <= 10; ++k) all.push_back(k * 100'000'000);
    return all;
  }
  void obey(const std::string& line) { playback_.obey(line, now_); }
  // [ms] from now; -1: never.
  [[nodiscard]] std::int64_t wait() const {
    const auto due = playback_.due();
    return due ? std::chrono::round<milliseconds>(*due - now_).count() : -1;
  }

  Clock::time_point now_ = Clock::time_point() + std::chrono::hours(1);
  Playback playback_{times(), 2, 0, now_};
};

TEST_F(PlaybackTest, ShowsFramesAtItsSpeed) {
  for (std::uint64_t k = 0; k <= 10; ++k) {
    EXPECT_EQ(wait(), 50 * static_cast<std::int64_t>(k));
    EXPECT_EQ(playback_.take(), k);
  }
  EXPECT_TRUE(playback_.is_at_end());
  EXPECT_EQ(wait(), -1);
}

TEST_F(PlaybackTest, StandsWhilePausedAndGoesOnFromThere) {
  EXPECT_EQ(playback_.take(), 0u);
  obey("pause");
  EXPECT_EQ(wait(), -1);
  now_ += std::chrono::seconds(100);
  obey("play");
  EXPECT_EQ(wait(), 0);
  EXPECT_EQ(playback_.take(), 1u);
  EXPECT_EQ(wait(), 50);
}

TEST_F(PlaybackTest, StepsForwardsAndBack) {
  obey("step 3");
  for (const std::uint64_t k : {0u, 1u, 2u}) {
    EXPECT_EQ(wait(), 0);
    EXPECT_EQ(playback_.take(), k);
  }
  EXPECT_EQ(wait(), -1);
  obey("step -1");
  EXPECT_EQ(playback_.take(), 1u);
  EXPECT_EQ(wait(), -1);
  obey("step");
  EXPECT_EQ(playback_.take(), 2u);
  obey("step -100");
  EXPECT_EQ(playback_.take(), 0u);
}

TEST_F(PlaybackTest, SeeksByTime) {
  obey("seek 0.55");
  EXPECT_EQ(wait(), 0);
  EXPECT_EQ(playback_.take(), 6u);
  EXPECT_EQ(wait(), 50);
  obey("pause");
  obey("seek 0.2");  // shows where it is
  EXPECT_EQ(wait(), 0);
  EXPECT_EQ(playback_.take(), 2u);
  EXPECT_EQ(wait(), -1);
  obey("seek 7");
  EXPECT_TRUE(playback_.is_at_end());
  obey("seek -7");
  EXPECT_EQ(playback_.take(), 0u);
}

TEST_F(PlaybackTest, ChangesItsSpeed) {
  EXPECT_EQ(playback_.take(), 0u);
  obey("speed 0.5");
  EXPECT_EQ(playback_.take(), 1u);
  EXPECT_EQ(wait(), 200);
}

TEST_F(PlaybackTest, StartsWhereItIsTold) {
  Playback later(times(), 1, 0.3, now_);
  EXPECT_EQ(later.take(), 3u);
}

TEST_F(PlaybackTest, RefusesWhatIsNoCommand) {
  for (const char* line : {"stop", "seek", "seek x", "seek 1 2", "seek inf", "step x", "speed", "speed 0"})
    EXPECT_THROW(obey(line), protocol::InputError) << line;
  obey("");
  EXPECT_EQ(playback_.take(), 0u);
  EXPECT_FALSE(playback_.has_quit());
  obey("quit");
  EXPECT_TRUE(playback_.has_quit());
}

}  // namespace
}  // namespace sluice::clients
