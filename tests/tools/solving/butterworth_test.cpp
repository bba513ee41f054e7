#include "tools/solving/butterworth.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/setup_error.h"

namespace mocap {
namespace {

std::vector<double> Wave(double hz, double rate_hz, int count) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i)
    values.push_back(std::sin(2 * std::numbers::pi * hz * i / rate_hz));
  return values;
}

// Amplitude and delay of a wave in the middle of filtered values.
std::complex<double> ResponseAt(double hz, const NamedFilter& filter, double rate_hz) {
  const int count = static_cast<int>(40 * rate_hz / hz), from = count / 4;
  const std::vector<double> out = ZeroLagButterworth(Wave(hz, rate_hz, count), filter, rate_hz);
  const int length = static_cast<int>(std::lround(20 * rate_hz / hz));
  std::complex<double> sum = 0;
  for (int i = from; i < from + length; ++i)
    sum += out[i] * std::polar(2.0 / length, -2 * std::numbers::pi * hz * i / rate_hz);
  return sum * std::complex<double>(0, 1);
}

TEST(Butterworth, LeavesHalfOfThePowerAtTheCutOff) {
  for (const int order : {2, 4, 8})
    for (const double rate_hz : {60.0, 100.0})
      EXPECT_NEAR(std::abs(ResponseAt(6, {order, 6}, rate_hz)), std::numbers::sqrt2 / 2, 1e-3)
          << order << " at " << rate_hz;
}

TEST(Butterworth, DelaysNothing) {
  for (const double hz : {1.0, 4.0, 6.0, 9.0})
    EXPECT_NEAR(std::arg(ResponseAt(hz, {4, 6}, 100)), 0, 1e-3) << hz;
}

TEST(Butterworth, HoldsBackMoreWithAHigherOrder) {
  EXPECT_NEAR(std::abs(ResponseAt(1, {4, 6}, 100)), 1, 1e-2);
  EXPECT_LT(std::abs(ResponseAt(12, {8, 6}, 100)), std::abs(ResponseAt(12, {4, 6}, 100)));
  EXPECT_LT(std::abs(ResponseAt(12, {4, 6}, 100)), std::abs(ResponseAt(12, {2, 6}, 100)));
}

TEST(Butterworth, KeepsConstantsAndSlopes) {
  std::vector<double> slope;
  for (int i = 0; i < 50; ++i) slope.push_back(7 + 0.3 * i);
  const std::vector<double> out = ZeroLagButterworth(slope, {4, 6}, 30);
  for (std::size_t i = 0; i < slope.size(); ++i) EXPECT_NEAR(out[i], slope[i], 1e-9) << i;
  EXPECT_EQ(ZeroLagButterworth(std::vector<double>{3}, {4, 6}, 30), std::vector<double>{3});
}

TEST(Butterworth, DoesNothingAboveWhatTheRateShows) {
  const std::vector<double> wave = Wave(2, 10, 30);
  EXPECT_EQ(ZeroLagButterworth(wave, {4, 6}, 10), wave);
  EXPECT_EQ(ZeroLagButterworth(wave, {}, 100), wave);
}

TEST(NamedFilter, IsReadAndWrittenAlike) {
  for (const char* name : {"none", "butterworth:4:6", "butterworth:2:0.5"})
    EXPECT_EQ(ParseFilter(name).name(), name);
}

TEST(NamedFilter, SaysWhatIsExpected) {
  for (const char* name : {"", "butter", "butterworth:4", "butterworth:3:6", "butterworth:4:0",
                           "butterworth:4:nan", "butterworth:18:6", "butterworth:4:6:1"})
    EXPECT_THAT(testing::SetupErrorOf([&] { ParseFilter(name); }),
                ::testing::HasSubstr("expected none, or butterworth:ORDER:HZ"))
        << name;
}

}  // namespace
}  // namespace mocap
