#include "tools/witness/look_schedule.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

namespace mocap {
namespace {

using ::testing::ElementsAre;

constexpr std::int64_t kFrameNs = 33'333'333;

struct PlannedLook {
  std::int64_t frame;
  int camera;
  friend bool operator==(const PlannedLook&, const PlannedLook&) = default;
};

std::vector<PlannedLook> LooksOf(int frames, const std::function<bool(int)>& sees) {
  LookSchedule schedule(4, 3);
  std::vector<PlannedLook> looks;
  for (std::int64_t frame = 0; frame < frames; ++frame)
    if (const auto camera = schedule.Next(1, frame * kFrameNs, sees))
      looks.push_back({frame, *camera});
  return looks;
}

TEST(LookSchedule, LooksThroughOneCameraAfterTheOtherAtTheRate) {
  const std::vector<PlannedLook> looks = LooksOf(51, [](int) { return true; });
  ASSERT_EQ(looks.size(), 5u);
  std::vector<int> cameras;
  for (const PlannedLook& look : looks) cameras.push_back(look.camera);
  EXPECT_THAT(cameras, ElementsAre(1, 2, 3, 0, 1));
  EXPECT_NEAR(static_cast<double>(looks.back().frame), 40, 1);
}

TEST(LookSchedule, PassesOverCamerasThatDoNotSeeThePerson) {
  const std::vector<PlannedLook> looks = LooksOf(30, [](int camera) { return camera == 3; });
  ASSERT_EQ(looks.size(), 3u);
  for (const PlannedLook& look : looks) EXPECT_EQ(look.camera, 3);
  EXPECT_TRUE(LooksOf(30, [](int) { return false; }).empty());
}

TEST(LookSchedule, HasATurnForEachPerson) {
  LookSchedule schedule(4, 3);
  const auto all = [](int) { return true; };
  EXPECT_EQ(schedule.Next(1, 0, all), 1);
  EXPECT_EQ(schedule.Next(2, 0, all), 2);
  EXPECT_EQ(schedule.Next(1, kFrameNs, all), std::nullopt);
}

TEST(LookSchedule, DoesNotCatchUpAfterAGap) {
  LookSchedule schedule(4, 3);
  const auto all = [](int) { return true; };
  constexpr std::int64_t kLater = 10'000'000'000;
  EXPECT_TRUE(schedule.Next(1, 0, all));
  EXPECT_TRUE(schedule.Next(1, kLater, all));
  EXPECT_FALSE(schedule.Next(1, kLater + kFrameNs, all));
}

}  // namespace
}  // namespace mocap
