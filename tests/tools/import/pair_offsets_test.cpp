// One clock from offsets between pairs.
#include "tools/import/pair_offsets.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace mocap {
namespace {

constexpr std::array kTrueOffsets_s = {0.0, 1.5, -0.25, 40.0};

PairOffset TruePair(int first, int second, double sigma_s = 0.001) {
  return {first, second, kTrueOffsets_s[second] - kTrueOffsets_s[first], 0, {}, sigma_s, 2};
}

std::vector<PairOffset> AllTruePairs() {
  std::vector<PairOffset> pairs;
  for (int i = 0; i < 4; ++i)
    for (int j = i + 1; j < 4; ++j) pairs.push_back(TruePair(i, j));
  return pairs;
}

void ExpectTrueOffsets(const std::vector<ClockFit>& fits, double tolerance_s) {
  for (std::size_t i = 0; i < kTrueOffsets_s.size(); ++i) {
    EXPECT_TRUE(fits[i].is_known);
    EXPECT_NEAR(fits[i].offset_s - fits[0].offset_s, kTrueOffsets_s[i], tolerance_s);
  }
}

TEST(FitClocks, FindsTheClocksThatAllPairsHave) {
  ExpectTrueOffsets(FitClocks(std::vector<ClockFit>(4), AllTruePairs()), 1e-9);
}

TEST(FitClocks, IsConnectedByAChainAsWell) {
  const std::vector pairs = {TruePair(2, 3), TruePair(0, 2), TruePair(1, 3)};
  ExpectTrueOffsets(FitClocks(std::vector<ClockFit>(4), pairs), 1e-9);
}

TEST(FitClocks, WeighsPairsByTheirDeviation) {
  std::vector<PairOffset> pairs = {TruePair(0, 1, 0.001), TruePair(0, 1, 0.003)};
  pairs[1].ahead_s += 0.01;
  // Variances 1 and 9: the second one has a tenth of the weight.
  EXPECT_NEAR(FitClocks(std::vector<ClockFit>(2), pairs)[1].offset_s, kTrueOffsets_s[1] + 0.001,
              1e-9);
}

TEST(FitClocks, LeavesOutAPairThatContradictsTheOthers) {
  std::vector<PairOffset> pairs = AllTruePairs();
  pairs[2].ahead_s += 3;
  const std::vector<ClockFit> fits = FitClocks(std::vector<ClockFit>(4), pairs);
  ExpectTrueOffsets(fits, 1e-9);
  EXPECT_LT(fits[0].worst_s, 1e-9);
}

TEST(FitClocks, TellsContradictionsThatRemain) {
  std::vector<PairOffset> pairs = AllTruePairs();
  pairs[0].ahead_s += 0.02;
  const std::vector<ClockFit> fits = FitClocks(std::vector<ClockFit>(4), pairs);
  EXPECT_GT(fits[0].worst_s, 0.005);
  EXPECT_GT(fits[1].worst_s, 0.005);
  EXPECT_GT(fits[0].sigma_s, fits[3].sigma_s);
}

TEST(FitClocks, DoesNotKnowWhatIsNotConnected) {
  const std::vector pairs = {TruePair(0, 1), TruePair(0, 2)};
  const std::vector<ClockFit> fits = FitClocks(std::vector<ClockFit>(4), pairs);
  EXPECT_TRUE(fits[2].is_known);
  EXPECT_FALSE(fits[3].is_known);
}

TEST(FitClocks, KeepsKnownClocks) {
  std::vector<ClockFit> known(4);
  known[3] = {100, 0, 0, 0, 1, true};
  const std::vector<ClockFit> fits = FitClocks(known, AllTruePairs());
  EXPECT_EQ(fits[3].offset_s, 100);
  EXPECT_NEAR(fits[0].offset_s, 60, 1e-9);
  EXPECT_NEAR(fits[1].offset_s, 61.5, 1e-9);
}

TEST(FitClocks, FindsDrift) {
  // The second clock loses 100 microseconds a second: T = 2 + 1.0001 t.
  const double at_s = 1000, other_s = (at_s - 2) / 1.0001;
  PairOffset pair{0, 1, at_s - other_s, at_s, {}, 0.001, 2};
  pair.rate_ppm = 100;
  const std::vector<ClockFit> fits = FitClocks(std::vector<ClockFit>(2), std::vector{pair});
  EXPECT_NEAR(fits[1].rate_ppm, 100, 1e-6);
  EXPECT_NEAR(fits[1].offset_s, 2, 1e-6);
}

}  // namespace
}  // namespace mocap
