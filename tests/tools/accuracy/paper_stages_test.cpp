#include "tools/accuracy/paper_stages.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/mikic2003/locate_body.h"
#include "core/mikic2003/measured_points.h"
#include "core/mikic2003/mikic_capture.h"
#include "tests/core/mikic2003/paper_person.h"

namespace mocap {
namespace {

using mikic2003::PaperPerson;

constexpr double kPeriodS = 0.1;

/// Somebody who swings arms and legs, leaps aside in the middle, and is gone for more than a second
/// at the end.
class PaperStagesTest : public ::testing::Test {
 protected:
  static constexpr int kLeap = 8, kGone = 16, kBack = 30, kEnd = 34;

  PoseState Truth(int frame) const {
    const double swing = std::sin(0.5 * frame);
    Stance stance = mikic2003::kSpread;
    stance.arm_l.forward = 20 * swing;
    stance.arm_r.forward = -20 * swing;
    stance.leg_l.hip = 10 + 10 * swing;
    stance.leg_r.hip = 10 - 10 * swing;
    const Vector3 at_W = frame < kLeap ? Vector3(60.0 * frame, 0, 1200) : Vector3(1500, 900, 1200);
    return person_.Pose(stance, frame < kLeap ? 0.4 : 2.1, at_W);
  }
  VoxelGrid See(int frame) const {
    if (frame < kGone || frame >= kBack) return person_.Grid(Truth(frame));
    VoxelGrid nothing;
    nothing.Reset({0, 0, 0}, {0, 0, 0}, 25);
    return nothing;
  }
  /// Locates a person of known sizes as the tracker does.
  void StartAsPublished(const VoxelGrid& flesh, const BodyModel& body) {
    VoxelCloud cloud;
    cloud.Build(flesh);
    const auto located = mikic2003::LocateBody(cloud);
    if (!located) return;
    stages_.Start(body, {body, located->R_WT, MeasurePoints(cloud, located->frame)});
  }
  /// Follows the person as the tracker does, and expects the same of both.
  void FollowAsPublished(const VoxelGrid& flesh, int frame, const BodyModel& body,
                         mikic2003::MikicCapture& capture) {
    const CaptureResult& published =
        capture.Update({flesh, {}}, std::llround(frame * kPeriodS * 1e9), nullptr);
    stages_.has_started() ? stages_.Follow(flesh, kPeriodS, nullptr)
                          : StartAsPublished(flesh, body);
    ASSERT_EQ(stages_.has_started(), published.state != CaptureState::kSearching) << frame;
    EXPECT_EQ(stages_.is_tracked(), published.state == CaptureState::kTracking) << frame;
    if (stages_.has_started()) {
      EXPECT_EQ(stages_.points_W(), published.points_W) << frame;
    }
  }
  double ErrorAt(int frame) const {
    const BodyPoints truth_W = person_.body.PointsAt(person_.body.PostureAt(Truth(frame)));
    return (stages_.points_W() - truth_W).colwise().norm().mean();
  }

  PaperPerson person_;
  PaperStages stages_;
};

TEST_F(PaperStagesTest, WithoutTruthAreThoseOfTheTracker) {
  mikic2003::MikicCapture capture(person_.body.table());
  capture.Expect(person_.body.sizes());
  bool was_lost = false, was_forgotten = false;
  for (int frame = 0; frame < kEnd; ++frame) {
    FollowAsPublished(See(frame), frame, person_.body, capture);
    was_lost = was_lost || (frame < kGone && !stages_.is_tracked());
    was_forgotten = was_forgotten || !stages_.has_started();
  }
  EXPECT_TRUE(was_lost);
  EXPECT_TRUE(was_forgotten);
  EXPECT_TRUE(stages_.is_tracked());
}

TEST_F(PaperStagesTest, AreLostAtTheSameDistance) {
  std::vector<VoxelGrid> seen;
  for (int frame = 0; frame < kLeap; ++frame) seen.push_back(See(frame));
  int tracked = 0, lost = 0;
  // The worse the sizes, the larger the distance.
  for (int stature_mm = 1000; stature_mm < 1500; stature_mm += 50) {
    const BodyModel body(person_.body.table(), PaperPerson::SizesOf(stature_mm));
    mikic2003::MikicCapture capture(body.table());
    capture.Expect(body.sizes());
    stages_ = {};
    for (int frame = 0; frame < kLeap; ++frame) {
      FollowAsPublished(seen[frame], frame, body, capture);
      stages_.is_tracked() ? ++tracked : ++lost;
    }
  }
  EXPECT_GT(tracked, 0);
  EXPECT_GT(lost, 0);
}

TEST_F(PaperStagesTest, TruePartsAreFoundWhereThePredictionMissesThem) {
  const auto truth_at = [&](int frame) -> TrueSubject {
    return {1750, ScoredPointsOf(person_.body.PointsAt(person_.body.PostureAt(Truth(frame))))};
  };
  // The arms and legs of the start are those of the other side.
  const PoseState elsewhere = [&] {
    Stance crossed = mikic2003::kSpread;
    crossed.arm_l = crossed.arm_r = {.forward = 90, .elbow = 10};
    crossed.leg_l.spread = crossed.leg_r.spread = -20;
    return person_.Pose(crossed, 0.4, Truth(0).X_WT.p);
  }();
  const auto follow = [&](bool has_true_parts) {
    stages_.Start(person_.body,
                  TrueStart(person_.body, {1750, ScoredPointsOf(person_.body.PointsAt(
                                                     person_.body.PostureAt(elsewhere)))}));
    for (int frame = 1; frame < 4; ++frame) {
      const TrueParts parts(truth_at(frame));
      stages_.Follow(See(frame), kPeriodS, has_true_parts ? &parts : nullptr);
    }
    return ErrorAt(3);
  };
  const double predicted_mm = follow(false), true_mm = follow(true);
  EXPECT_LT(true_mm, 50);
  EXPECT_GT(predicted_mm, 1.5 * true_mm);
}

}  // namespace
}  // namespace mocap
