#include "daemon/pipeline/synchronizer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <optional>
#include <random>
#include <vector>

namespace mocap {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;

constexpr std::int64_t kMs = 1'000'000;
constexpr std::int64_t kPeriod = 33 * kMs;

/// The times of one set, by camera; empty where a camera is not in it.
using Set = std::vector<std::optional<std::int64_t>>;

/// Feeds whole streams to a synchronizer, each camera ending with its stream.
std::vector<Set> Match(std::vector<std::deque<std::int64_t>> streams,
                       std::vector<std::int64_t>* late = nullptr) {
  const int cameras = static_cast<int>(streams.size());
  Synchronizer synchronizer(cameras, kPeriod, Synchronizer::kWaitForever);
  std::vector<std::int64_t> fronts(cameras);
  std::vector<std::uint64_t> sequences(cameras);
  std::vector<Set> sets;
  for (;;) {
    for (int i = 0; i < cameras; ++i) {
      while (!synchronizer.has_front(i) && !streams[i].empty()) {
        fronts[i] = streams[i].front();
        streams[i].pop_front();
        synchronizer.Offer(i, fronts[i], sequences[i]++);
      }
      // Cameras are a frame ahead of what is matched.
      if (!streams[i].empty()) synchronizer.NoteNewest(i, streams[i].front());
      if (!synchronizer.has_front(i)) synchronizer.Expect(i, Expectation::kNone);
    }
    const Synchronizer::Decision decision = synchronizer.Decide();
    if (decision == Synchronizer::Decision::kWait) break;
    if (decision == Synchronizer::Decision::kLetGo) continue;
    Set& set = sets.emplace_back(cameras);
    for (int i = 0; i < cameras; ++i) {
      if (synchronizer.members()[i]) set[i] = fronts[i];
    }
  }
  if (late) {
    for (int i = 0; i < cameras; ++i) late->push_back(synchronizer.late(i));
  }
  return sets;
}

std::deque<std::int64_t> Stream(int frames, std::int64_t period_ns, std::int64_t offset_ns = 0) {
  std::deque<std::int64_t> times;
  for (int i = 0; i < frames; ++i) times.push_back(offset_ns + i * period_ns);
  return times;
}

int CountOf(const Set& set) {
  return static_cast<int>(
      std::ranges::count_if(set, [](const auto& time) { return time.has_value(); }));
}

TEST(Synchronizer, JitteredFramesOfOneInstantMakeOneSet) {
  std::mt19937 random(3);
  std::uniform_int_distribution<std::int64_t> jitter(-5 * kMs, 5 * kMs);
  std::vector<std::deque<std::int64_t>> streams(6, Stream(200, kPeriod));
  for (auto& stream : streams) {
    for (auto& time : stream) time += jitter(random);
  }
  const std::vector<Set> sets = Match(streams);
  ASSERT_EQ(sets.size(), 200u);
  for (std::size_t n = 0; n < sets.size(); ++n) {
    for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(sets[n][i], streams[i][n]);
  }
}

TEST(Synchronizer, AMissingFrameLeavesItsCameraOutOfThatSetOnly) {
  std::vector<std::deque<std::int64_t>> streams(4, Stream(30, kPeriod));
  streams[2].erase(streams[2].begin() + 10, streams[2].begin() + 12);
  streams[0].erase(streams[0].begin() + 20);
  const std::vector<Set> sets = Match(streams);
  ASSERT_EQ(sets.size(), 30u);
  for (int n = 0; n < 30; ++n) {
    for (int i = 0; i < 4; ++i) {
      const bool missing = (i == 2 && (n == 10 || n == 11)) || (i == 0 && n == 20);
      EXPECT_EQ(sets[n][i].has_value(), !missing) << "set " << n << ", camera " << i;
      if (!missing) {
        EXPECT_EQ(sets[n][i], n * kPeriod);
      }
    }
  }
}

TEST(Synchronizer, AFrameThatOnlyOneCameraTookIsLetGo) {
  std::vector<std::deque<std::int64_t>> streams(4, Stream(30, kPeriod));
  for (int i : {0, 1, 3}) streams[i].erase(streams[i].begin() + 10);
  std::vector<std::int64_t> late;
  const std::vector<Set> sets = Match(streams, &late);
  ASSERT_EQ(sets.size(), 29u);
  for (const Set& set : sets) EXPECT_EQ(CountOf(set), 4);
  EXPECT_THAT(late, ElementsAre(0, 0, 1, 0));
}

TEST(Synchronizer, ACameraAtHalfTheRateIsInEveryOtherSet) {
  std::vector<std::deque<std::int64_t>> streams(5, Stream(40, kPeriod));
  streams[1] = Stream(20, 2 * kPeriod, 2 * kMs);
  const std::vector<Set> sets = Match(streams);
  ASSERT_EQ(sets.size(), 40u);
  for (int n = 0; n < 40; ++n) EXPECT_EQ(CountOf(sets[n]), n % 2 ? 4 : 5);
}

TEST(Synchronizer, ACameraThatEndsEarlyIsGoneOnWithout) {
  std::vector<std::deque<std::int64_t>> streams(3, Stream(20, kPeriod));
  streams[0].resize(7);
  const std::vector<Set> sets = Match(streams);
  ASSERT_EQ(sets.size(), 20u);
  for (int n = 0; n < 20; ++n) EXPECT_EQ(CountOf(sets[n]), n < 7 ? 3 : 2);
}

TEST(Synchronizer, UnsynchronizedCamerasFallIntoStableSetsWithinHalfAPeriodOfTheMedian) {
  std::vector<std::deque<std::int64_t>> streams;
  for (const std::int64_t phase_ms : {0, 9, 14, 31}) {
    streams.push_back(Stream(60, kPeriod, phase_ms * kMs));
  }
  const std::vector<Set> sets = Match(streams);
  ASSERT_GE(sets.size(), 59u);
  for (std::size_t n = 2; n + 2 < sets.size(); ++n) {
    EXPECT_EQ(CountOf(sets[n]), 4);
    for (const auto& time : sets[n]) EXPECT_LE(std::abs(*time - *sets[n][0]), kPeriod / 2);
  }
}

TEST(Synchronizer, LearnsAPeriodThatIsNotTheNominalOne) {
  std::vector<std::deque<std::int64_t>> streams(3, Stream(40, 5 * kMs));
  streams[1].erase(streams[1].begin() + 25);
  const std::vector<Set> sets = Match(streams);
  // The nominal 33 ms would throw most sets together, and fill the gap with the next frame.
  ASSERT_EQ(sets.size(), 40u);
  EXPECT_EQ(sets[25], (Set{25 * 5 * kMs, std::nullopt, 25 * 5 * kMs}));
  EXPECT_EQ(sets[26], (Set{26 * 5 * kMs, 26 * 5 * kMs, 26 * 5 * kMs}));
}

TEST(Synchronizer, SaysHowFarTheTimesOfASetLieApart) {
  Synchronizer synchronizer(3, kPeriod, Synchronizer::kWaitForever);
  synchronizer.Offer(0, 100 * kMs, 0);
  synchronizer.Offer(1, 103 * kMs, 0);
  synchronizer.Offer(2, 98 * kMs, 0);
  ASSERT_EQ(synchronizer.Decide(), Synchronizer::Decision::kSet);
  EXPECT_EQ(synchronizer.spread_ns(), 5 * kMs);
  EXPECT_EQ(synchronizer.set_ns(), 301 * kMs / 3) << "the mean";
}

TEST(Synchronizer, WaitsForASilentCameraUntilTheOthersHaveRunAhead) {
  Synchronizer synchronizer(3, kPeriod, 2.0);
  synchronizer.Offer(0, 0, 0);
  synchronizer.Offer(1, 0, 0);
  EXPECT_EQ(synchronizer.Decide(), Synchronizer::Decision::kWait);
  synchronizer.NoteNewest(2 * kPeriod);
  EXPECT_EQ(synchronizer.Decide(), Synchronizer::Decision::kWait);
  synchronizer.NoteNewest(2 * kPeriod + 1);
  ASSERT_EQ(synchronizer.Decide(), Synchronizer::Decision::kSet);
  EXPECT_THAT(synchronizer.members(), ElementsAre(true, true, false));
}

TEST(Synchronizer, WaitsForAFrameThatIsUnderWayHoweverFarTheOthersAre) {
  Synchronizer synchronizer(3, kPeriod, 2.0);
  synchronizer.Offer(0, 0, 0);
  synchronizer.Offer(1, 0, 0);
  synchronizer.Expect(2, Expectation::kCertain);
  synchronizer.NoteNewest(100 * kPeriod);
  EXPECT_EQ(synchronizer.Decide(), Synchronizer::Decision::kWait);
}

TEST(Synchronizer, DoesNotWaitAgainForACameraThatStaysSilent) {
  Synchronizer synchronizer(3, kPeriod, 2.0);
  for (int i : {0, 1}) synchronizer.Offer(i, 0, 0);
  synchronizer.NoteNewest(3 * kPeriod);
  ASSERT_EQ(synchronizer.Decide(), Synchronizer::Decision::kSet);
  for (int i : {0, 1}) synchronizer.Offer(i, 3 * kPeriod, 3);
  EXPECT_EQ(synchronizer.Decide(), Synchronizer::Decision::kSet);
  for (int i : {0, 1, 2}) synchronizer.Offer(i, 4 * kPeriod, 4);
  EXPECT_EQ(synchronizer.Decide(), Synchronizer::Decision::kSet);
  for (int i : {0, 1}) synchronizer.Offer(i, 5 * kPeriod, 5);
  EXPECT_EQ(synchronizer.Decide(), Synchronizer::Decision::kWait) << "it had come back";
}

TEST(Synchronizer, LetsFramesGoWhoseSetWentWithoutThem) {
  Synchronizer synchronizer(4, kPeriod, 0.5);
  synchronizer.Offer(0, 0, 0);
  synchronizer.Offer(1, 1 * kMs, 0);
  synchronizer.NoteNewest(kPeriod);
  ASSERT_EQ(synchronizer.Decide(), Synchronizer::Decision::kSet);
  for (int i : {0, 1}) synchronizer.Offer(i, kPeriod, 0);
  for (int i : {2, 3}) synchronizer.Offer(i, 2 * kMs, 0);
  for (int i = 0; i < 2; ++i) {
    ASSERT_EQ(synchronizer.Decide(), Synchronizer::Decision::kLetGo);
    synchronizer.Offer(synchronizer.camera(), kPeriod, 0);
  }
  ASSERT_EQ(synchronizer.Decide(), Synchronizer::Decision::kSet);
  EXPECT_THAT(synchronizer.members(), Each(true));
  EXPECT_EQ(synchronizer.set_ns(), kPeriod);
  EXPECT_EQ(synchronizer.late(2), 1);
}

TEST(Synchronizer, RefusesTimesThatGoBack) {
  Synchronizer synchronizer(1, kPeriod, Synchronizer::kWaitForever);
  EXPECT_TRUE(synchronizer.Offer(0, 5, 0));
  ASSERT_EQ(synchronizer.Decide(), Synchronizer::Decision::kSet);
  EXPECT_FALSE(synchronizer.Offer(0, 5, 0));
  EXPECT_FALSE(synchronizer.has_front(0));
  EXPECT_EQ(synchronizer.late(0), 1);
}

TEST(Synchronizer, AClockThatIsPutBackBeginsAnew) {
  constexpr std::int64_t kHour = 3'600'000 * kMs;
  std::vector<std::deque<std::int64_t>> streams(3, Stream(10, kPeriod, kHour));
  streams[1].pop_back();
  for (auto& stream : streams) {
    for (const std::int64_t time : Stream(10, kPeriod)) stream.push_back(time);
  }
  const std::vector<Set> sets = Match(streams);
  ASSERT_FALSE(sets.empty());
  EXPECT_THAT(sets.back(), Each(std::optional(9 * kPeriod)));
  // The frames around the step do not find each other.
  EXPECT_GE(std::ranges::count_if(sets, [](const Set& set) { return CountOf(set) == 3; }), 17);
}

TEST(Synchronizer, OneStampFarInTheFutureCostsOneFrame) {
  Synchronizer synchronizer(2, kPeriod, 2.0);
  ASSERT_TRUE(synchronizer.Offer(0, 1000 * kPeriod, 0));
  synchronizer.NoteNewest(0, kPeriod);
  ASSERT_TRUE(synchronizer.Offer(1, 0, 0));
  synchronizer.NoteNewest(1, kPeriod);
  EXPECT_FALSE(synchronizer.has_front(0)) << "its camera is elsewhere by now";
  ASSERT_TRUE(synchronizer.Offer(0, kPeriod, 1));
  ASSERT_EQ(synchronizer.Decide(), Synchronizer::Decision::kLetGo);
  ASSERT_TRUE(synchronizer.Offer(1, kPeriod, 1));
  EXPECT_EQ(synchronizer.Decide(), Synchronizer::Decision::kSet);
  EXPECT_EQ(synchronizer.set_ns(), kPeriod);
  EXPECT_EQ(synchronizer.late(0), 1);
}

TEST(Synchronizer, SetTimesNeverGoBackWhateverTheStreamsDo) {
  for (int seed = 0; seed < 200; ++seed) {
    std::mt19937 random(seed);
    std::uniform_int_distribution<std::int64_t> jitter(-15 * kMs, 15 * kMs);
    std::vector<std::deque<std::int64_t>> streams(5);
    for (auto& stream : streams) {
      const std::int64_t phase = 2 * jitter(random);
      for (int n = 0; n < 40; ++n) {
        if (random() % 4 != 0) stream.push_back(phase + n * kPeriod + jitter(random));
      }
    }
    const std::vector<Set> sets = Match(streams);
    std::vector<std::int64_t> last(5, std::numeric_limits<std::int64_t>::min());
    std::int64_t last_median = std::numeric_limits<std::int64_t>::min();
    for (const Set& set : sets) {
      std::vector<std::int64_t> times;
      for (int i = 0; i < 5; ++i) {
        if (!set[i]) continue;
        EXPECT_GT(*set[i], last[i]);
        times.push_back(last[i] = *set[i]);
      }
      std::ranges::sort(times);
      ASSERT_GE(times.size(), 2u);
      EXPECT_GT(times[(times.size() - 1) / 2], last_median);
      last_median = times[(times.size() - 1) / 2];
    }
  }
}

}  // namespace
}  // namespace mocap
