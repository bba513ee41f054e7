#include "tools/interchange/skeleton_motion.h"

#include <gtest/gtest.h>

#include <cstdint>

#include "core/errors.h"
#include "tests/support/moving_body.h"

namespace mocap {
namespace {

using testing::Append;
using testing::GrownBody;
using testing::Swinging;
using testing::SwingingResult;

TEST(SkeletonMotion, SkipsWhatComesBeforeTrackingAndHoldsThePoseInGaps) {
  Result result = SwingingResult(6);
  result.poses[0].state = CaptureState::kAcquiring;
  result.poses[3].state = CaptureState::kLost;
  const SkeletonMotion motion = MakeSkeletonMotion(result);
  EXPECT_EQ(motion.skipped_frames, 1);
  EXPECT_EQ(motion.held_frames, 1);
  ASSERT_EQ(motion.frames.size(), 5u);
  EXPECT_EQ(motion.frames[2].offset[0], motion.frames[1].offset[0]);
  EXPECT_NE(motion.frames[3].offset[0], motion.frames[1].offset[0]);
  for (int i = 0; i < 5; ++i) EXPECT_EQ(motion.frames[i].time_ns, result.poses[i + 1].timestamp_ns);
}

TEST(SkeletonMotion, KeepsTimeThoughFramesAreMissing) {
  Result result = SwingingResult(20);
  // Jitter of a few milliseconds, and three frames gone.
  for (std::size_t i = 0; i < 20; ++i) result.poses[i].timestamp_ns += i % 3 * 2'000'000;
  result.poses.erase(result.poses.begin() + 8, result.poses.begin() + 11);
  const SkeletonMotion motion = MakeSkeletonMotion(result);
  EXPECT_EQ(motion.held_frames, 3);
  ASSERT_EQ(motion.frames.size(), 20u);
  EXPECT_NEAR(motion.period_s, 0.04, 0.0002);
  EXPECT_EQ(motion.frames[10].offset[0], motion.frames[7].offset[0]);
  EXPECT_NE(motion.frames[11].offset[0], motion.frames[7].offset[0]);
  for (int i = 1; i < 20; ++i) EXPECT_GT(motion.frames[i].time_ns, motion.frames[i - 1].time_ns);
}

TEST(SkeletonMotion, SaysHowFarJointsAreOffWhenBonesChange) {
  Result result = SwingingResult(5);
  EXPECT_LT(MakeSkeletonMotion(result).worst_mm, 1e-6);
  PoseRow& row = result.poses[2];
  const Vector3 calf = row.points_W.col(static_cast<int>(Point::kFootL)) -
                       row.points_W.col(static_cast<int>(Point::kKneeL));
  for (const Point point : {Point::kAnkleL, Point::kHeelL, Point::kBallL, Point::kToeL})
    FurtherOf(row.further_W, point) += 20 * calf.normalized();
  EXPECT_NEAR(MakeSkeletonMotion(result).worst_mm, 20, 1e-6);
}

TEST(SkeletonMotion, HasTheBonesThatTheSizesSettledOn) {
  Result result = SwingingResult(3, BodyModel(LoadBodyTable("full"), AverageSizes(1700)));
  const BodyModel settled = GrownBody();
  result.body = RecordOf(settled);
  Append(settled, Swinging(settled, 1), result);
  const SkeletonMotion motion = MakeSkeletonMotion(result);
  EXPECT_NEAR(motion.bones[static_cast<int>(SkeletonJoint::kLeftLeg)].norm(), settled.sizes().thigh,
              1e-6);
  EXPECT_GT(motion.worst_mm, 10);
}

TEST(SkeletonMotion, RefusesAPauseThatWouldFillTheMemory) {
  Result result = SwingingResult(9);
  result.poses[8].timestamp_ns = std::int64_t{1} << 60;
  EXPECT_THROW(MakeSkeletonMotion(result), SetupError);
}

TEST(SkeletonMotion, RefusesAResultWithoutATrackedFrame) {
  Result result = SwingingResult(2);
  for (PoseRow& row : result.poses) row.state = CaptureState::kSearching;
  EXPECT_THROW(MakeSkeletonMotion(result), SetupError);
}

}  // namespace
}  // namespace mocap
