#include "core/evidence/pose_history.h"

#include <gtest/gtest.h>

namespace mocap {
namespace {

constexpr std::int64_t kFrameNs = 33'000'000;

PoseState PoseAt(double x_mm) {
  PoseState pose;
  pose.X_WT.p.x() = x_mm;
  return pose;
}

TEST(PoseHistory, FindsTheNearestPoseOfTheLastSecond) {
  PoseHistory history;
  EXPECT_EQ(history.NearestTo(0), nullptr);
  for (int frame = 0; frame < 100; ++frame) {
    history.Add(frame * kFrameNs, PoseAt(frame));
    for (int before = 0; before < std::min(frame + 1, 30); ++before) {
      const PoseState* const pose = history.NearestTo((frame - before) * kFrameNs + kFrameNs / 4);
      ASSERT_NE(pose, nullptr);
      EXPECT_EQ(pose->X_WT.p.x(), frame - before);
    }
  }
  EXPECT_EQ(history.NearestTo(0)->X_WT.p.x(), 69) << "older ones are forgotten";
  history.Clear();
  EXPECT_EQ(history.NearestTo(0), nullptr);
  history.Add(5, PoseAt(7));
  EXPECT_EQ(history.NearestTo(0)->X_WT.p.x(), 7);
}

}  // namespace
}  // namespace mocap
