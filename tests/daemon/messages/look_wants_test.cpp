#include "daemon/messages/look_wants.h"

#include <gtest/gtest.h>

#include <limits>
#include <mocap/look_t.hpp>

namespace mocap {
namespace {

constexpr std::int64_t kSecondNs = 1'000'000'000;

look_request_t RequestOf(const std::string& asker, double rate_hz, double hold_s = 10) {
  look_request_t request{};
  request.asker = asker;
  request.rate_hz = rate_hz;
  request.hold_s = hold_s;
  return request;
}

TEST(LookWants, NobodyAsksUntilThereIsARequestAndAfterItsTime) {
  LookWants wants;
  EXPECT_FALSE(wants.At(0));
  wants.Take(RequestOf("a", 3), 0);
  ASSERT_TRUE(wants.At(10 * kSecondNs - 1));
  EXPECT_EQ(wants.At(1)->rate_hz, 3);
  EXPECT_FALSE(wants.At(10 * kSecondNs));
}

TEST(LookWants, ANewRequestReplacesTheAskersLast) {
  LookWants wants;
  wants.Take(RequestOf("a", 10), 0);
  wants.Take(RequestOf("a", 2), 1);
  EXPECT_EQ(wants.At(2)->rate_hz, 2);
  wants.Take(RequestOf("a", 0), 3);
  EXPECT_FALSE(wants.At(4));
}

TEST(LookWants, WhatIsTakenSatisfiesAll) {
  LookWants wants;
  look_request_t one = RequestOf("a", 3);
  one.person = 1;
  one.side_px = 256;
  one.encoding = look_t::BGR;
  wants.Take(one, 0);
  EXPECT_EQ(wants.At(1)->person, 1);
  EXPECT_TRUE(wants.At(1)->is_raw);
  look_request_t other = RequestOf("b", 5);
  other.person = 2;
  other.side_px = 192;
  wants.Take(other, 0);
  const LookWant both = *wants.At(1);
  EXPECT_EQ(both.rate_hz, 5);
  EXPECT_EQ(both.person, 0);
  EXPECT_EQ(both.side_px, 256);
  EXPECT_FALSE(both.is_raw);
  wants.Take(RequestOf("c", 1), 0);
  EXPECT_EQ(wants.At(1)->side_px, 0);
}

TEST(LookWants, HostileRequestsAreBoundedOrIgnored) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  LookWants wants;
  for (const double bad : {kNan, -kInfinity, -1.0, 0.0}) {
    wants.Take(RequestOf("a", bad), 0);
    wants.Take(RequestOf("b", 1, bad), 0);
  }
  EXPECT_FALSE(wants.At(1));
  wants.Take(RequestOf("a", kInfinity, kInfinity), 0);
  EXPECT_EQ(wants.At(1)->rate_hz, LookWants::kMostHz);
  EXPECT_FALSE(wants.At(61 * kSecondNs));
  wants.Take(RequestOf("a", 1e-300), 0);
  EXPECT_EQ(wants.At(1)->rate_hz, LookWants::kLeastHz);
  for (int i = 0; i < 1000; ++i) wants.Take(RequestOf(std::to_string(i), 30), 0);
  EXPECT_EQ(wants.At(1)->rate_hz, LookWants::kMostHz);
}

}  // namespace
}  // namespace mocap
