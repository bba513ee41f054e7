#include "daemon/service/clock_watch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace mocap {
namespace {

using ::testing::HasSubstr;

TEST(ClockWatch, TellsOfEachStepOnceWithItsDirectionAndSize) {
  ClockWatch watch;
  EXPECT_EQ(watch.Add(0), "");
  EXPECT_THAT(watch.Add(-800'000'000), HasSubstr("set back by 0.80 s"));
  EXPECT_EQ(watch.Add(-800'000'000), "");
  EXPECT_THAT(watch.Add(3'599'200'000'000), HasSubstr("set forward by 3600.00 s"));
  EXPECT_EQ(watch.Add(3'599'200'000'000), "");
}

TEST(ClockWatch, SmallStepsAreToldOnceTheyAddUp) {
  ClockWatch watch;
  EXPECT_EQ(watch.Add(ClockWatch::kLeastNs / 2), "");
  EXPECT_THAT(watch.Add(ClockWatch::kLeastNs), HasSubstr("forward by 0.01 s"));
}

}  // namespace
}  // namespace mocap
