#include "core/evaluation/accuracy.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace mocap {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr std::int64_t kPeriodNs = 100'000'000;

/// Stands upright and faces +x; the left elbow is bent by a right angle, the right arm hangs down.
ScoredPoints Standing() {
  ScoredPoints p;
  p.transpose() << 0, 0, 1700,       // head
      0, 0, 1500,                    // neck
      0, 180, 1450, 0, -180, 1450,   // shoulders
      0, 480, 1450, 0, -180, 1150,   // elbows
      400, 480, 1450, 0, -180, 750,  // fingertips
      0, 100, 900, 0, -100, 900,     // hips
      0, 100, 500, 0, -100, 500,     // knees
      0, 100, 50, 0, -100, 50;       // feet
  return p;
}

std::vector<ScoredFrame> Still(int frames) {
  std::vector<ScoredFrame> result(frames);
  for (int i = 0; i < frames; ++i) result[i] = {i * kPeriodNs, true, Standing()};
  return result;
}

TEST(ScoredAngles, FollowFromPointsAlone) {
  const ScoredAngles angles = ScoredAnglesOf(Standing());
  const double expected[] = {kPi / 2, kPi, kPi, kPi, kPi / 2, kPi, kPi, kPi};
  for (int i = 0; i < kScoredAngleCount; ++i) {
    EXPECT_NEAR(angles[i], expected[i], 1e-12) << kScoredAngleNames[i];
  }
}

TEST(ScoredPoints, ArePickedByName) {
  BodyPoints points;
  for (int i = 0; i < kPointCount; ++i) points.col(i).setConstant(i);
  const ScoredPoints scored = ScoredPointsOf(points);
  EXPECT_EQ(scored(0, 0), static_cast<int>(Point::kHead));
  EXPECT_EQ(scored(0, 7), static_cast<int>(Point::kFingertipsR));
  EXPECT_EQ(scored(0, 13), static_cast<int>(Point::kFootR));
}

TEST(Accuracy, OfAGrowingShiftIsAsWorkedOutByHand) {
  const std::vector<ScoredFrame> truth = Still(10);
  std::vector<ScoredFrame> output = Still(10);
  // Frames 2 … 9 are off by 5, 10, … 40 mm; the first two are not tracked.
  output[0].tracked = output[1].tracked = false;
  for (int k = 1; k <= 8; ++k) output[k + 1].points_W.colwise() += k * Vector3(3, 0, -4);
  const Accuracy accuracy = MeasureAccuracy(truth, output);
  EXPECT_EQ(accuracy.truth_frames, 10);
  EXPECT_EQ(accuracy.first_tracked_frame, 2);
  EXPECT_DOUBLE_EQ(accuracy.tracked_share, 1);
  EXPECT_DOUBLE_EQ(accuracy.head_found_share, 1);
  EXPECT_NEAR(accuracy.distance_mm.mean, 22.5, 1e-9);
  EXPECT_NEAR(accuracy.distance_mm.median, 25, 1e-9);  // The upper of the two in the middle.
  EXPECT_NEAR(accuracy.distance_mm.p95, 40, 1e-9);
  EXPECT_NEAR(accuracy.distance_mm.worst, 40, 1e-9);
  // Each point strays 5 |k - 4.5| from its mean offset.
  EXPECT_NEAR(accuracy.spread_mm, 10, 1e-9);
  for (const double point_mm : accuracy.point_mm) EXPECT_NEAR(point_mm, 22.5, 1e-9);
  EXPECT_NEAR(accuracy.mean_angle_rad, 0, 1e-12);
}

TEST(Accuracy, CountsAnElbowsErrorOnceAmongEightAngles) {
  const std::vector<ScoredFrame> truth = Still(4);
  std::vector<ScoredFrame> output = Still(4);
  for (ScoredFrame& frame : output) {
    // The left forearm opens by 0.3 rad in one half of the frames and closes in the other.
    const double sign = frame.timestamp_ns < 2 * kPeriodNs ? 1 : -1;
    frame.points_W.col(6) =
        frame.points_W.col(4) + 400 * Vector3(std::cos(0.3), sign * std::sin(0.3), 0);
  }
  const Accuracy accuracy = MeasureAccuracy(truth, output);
  EXPECT_NEAR(accuracy.angle_rad[0], 0.3, 1e-12);
  EXPECT_NEAR(accuracy.mean_angle_rad, 0.3 / 8, 1e-12);
  EXPECT_NEAR(accuracy.point_mm[6], 2 * 400 * std::sin(0.15), 1e-9);
}

TEST(Accuracy, SpreadForgivesAJointDefinedElsewhereOnItsBone) {
  const std::vector<ScoredFrame> truth = [] {
    std::vector<ScoredFrame> frames = Still(8);
    for (int i = 0; i < 8; ++i) {
      // The person turns on the spot: the offset turns with the bone.
      frames[i].points_W = ExpRotation(0.4 * i * Vector3::UnitZ()) * Standing();
    }
    return frames;
  }();
  std::vector<ScoredFrame> output = truth;
  for (ScoredFrame& frame : output) {
    const Vector3 shank = frame.points_W.col(12) - frame.points_W.col(10);
    frame.points_W.col(12) += 30 * shank.normalized();
  }
  const Accuracy accuracy = MeasureAccuracy(truth, output);
  EXPECT_NEAR(accuracy.point_mm[12], 30, 1e-9);
  EXPECT_NEAR(accuracy.spread_mm, 0, 1e-9);
}

TEST(Accuracy, HeadIsFoundUpToSixtyMillimetres) {
  std::vector<ScoredFrame> output = Still(4);
  output[1].points_W(0, 0) += 60;
  output[2].points_W(0, 0) += 60.001;
  EXPECT_DOUBLE_EQ(MeasureAccuracy(Still(4), output).head_found_share, 0.75);
}

TEST(Accuracy, MatchesFramesByTimeAndUsesATrueFrameOnce) {
  std::vector<ScoredFrame> output = Still(5);
  output[0].timestamp_ns -= kPeriodNs / 2 + 1;  // Before the truth begins.
  output[2].timestamp_ns += kPeriodNs / 2 - 1;  // Still frame 2.
  output[3].timestamp_ns = output[2].timestamp_ns;
  const Accuracy accuracy = MeasureAccuracy(Still(5), output);
  ASSERT_EQ(accuracy.frames.size(), 3u);
  EXPECT_EQ(accuracy.first_tracked_frame, 1);
  EXPECT_EQ(accuracy.frames[1].pose, 2);
  EXPECT_EQ(accuracy.frames[1].truth, 2);
  EXPECT_EQ(accuracy.frames[2].truth, 4);
  EXPECT_DOUBLE_EQ(accuracy.tracked_share, 0.75);
}

TEST(Accuracy, OfNothingTrackedIsEmpty) {
  std::vector<ScoredFrame> output = Still(3);
  for (ScoredFrame& frame : output) frame.tracked = false;
  const Accuracy accuracy = MeasureAccuracy(Still(3), output);
  EXPECT_EQ(accuracy.first_tracked_frame, -1);
  EXPECT_TRUE(accuracy.frames.empty());
  EXPECT_EQ(accuracy.tracked_share, 0);
}

}  // namespace
}  // namespace mocap
