#include "core/body/body_sizes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "config/load_config.h"
#include "core/body/body_model.h"
#include "core/body/stance.h"

namespace mocap {
namespace {

constexpr double kStature_mm = 1755;

class AverageMan : public ::testing::Test {
 protected:
  AverageMan() {
    pose_.theta =
        AnglesOf({.arm_l = {.raise = -90, .elbow = 0}, .leg_l = {0, 0, 0}, .leg_r = {0, 0, 0}},
                 body_.table());
    posture_ = body_.PostureAt(pose_);
    body_.PoseShape(posture_, shape_);
    points_ = body_.PointsAt(posture_);
  }
  Vector3 At(Point point) const { return points_.col(static_cast<int>(point)); }
  // Above the sole, as a share of the stature.
  double HeightOf(Point point) const {
    return (At(point).z() - At(Point::kFootL).z()) / kStature_mm;
  }
  // How far the flesh of the trunk and the left limbs reaches from a joint.
  double FleshFrom(Point joint, const Vector3& direction) const {
    double reach_mm = 0;
    while (std::ranges::any_of(shape_, [&](const PosedCapsule& capsule) {
      return capsule.DistanceTo(Vector3(At(joint) + reach_mm * direction)).outside_mm < 0;
    })) {
      reach_mm += 1;
    }
    return reach_mm;
  }

  BodyModel body_{LoadBodyTable("full"), AverageSizes(kStature_mm)};
  PoseState pose_;
  Posture posture_;
  std::vector<PosedCapsule> shape_;
  BodyPoints points_;
};

// docs/poses.md, "Where joints lie".
TEST_F(AverageMan, HasItsJointsAtTheHeightsOfAnatomy) {
  EXPECT_NEAR(HeightOf(Point::kNeck), 0.852, 0.002);
  EXPECT_NEAR(HeightOf(Point::kShoulderL), 0.791, 0.002);
  EXPECT_NEAR(HeightOf(Point::kElbowL), 0.630, 0.003);
  EXPECT_NEAR(HeightOf(Point::kHipL), 0.530, 0.002);
  EXPECT_NEAR(HeightOf(Point::kKneeL), 0.285, 0.002);
}

TEST_F(AverageMan, HasAsMuchFleshOverTheShoulderJointAsReachesToTheAcromion) {
  EXPECT_NEAR(FleshFrom(Point::kShoulderL, Vector3::UnitZ()), 50, 8);
}

TEST_F(AverageMan, HasMoreFleshBehindTheHipsThanInFrontOfThem) {
  const double behind = FleshFrom(Point::kHipL, -Vector3::UnitX());
  const double in_front = FleshFrom(Point::kHipL, Vector3::UnitX());
  EXPECT_NEAR(behind - in_front, 18, 6);
}

TEST_F(AverageMan, HasHairBehindTheSkullAndNoneInFrontOfIt) {
  const auto skull = std::ranges::find(body_.shape(), BodyPart::kHead, &Capsule::part);
  const Vector3 head_T = body_.reference_points_T().col(static_cast<int>(Point::kHead));
  const double behind_mm = head_T.x() - skull->a_T.x() + skull->radius_a_mm;
  const double in_front_mm = skull->b_T.x() - head_T.x() + skull->radius_b_mm;
  EXPECT_NEAR(behind_mm - in_front_mm, 15, 1e-6);
}

}  // namespace
}  // namespace mocap
