#include "core/solving/standing_feet.h"

#include <gtest/gtest.h>

#include "config/load_config.h"
#include "tests/support/standing_height.h"

namespace mocap {
namespace {

class StandingFeet : public ::testing::Test {
 protected:
  // Somebody upright whose feet are this high above the floor.
  PoseState At(double x_mm, double above_mm) const {
    PoseState pose;
    pose.theta = JointAngles::Zero(body_.joint_count());
    pose.X_WT.p = Vector3(x_mm, 0, 0);
    const FurtherPoints further_W = body_.FurtherPointsAt(body_.PostureAt(pose));
    pose.X_WT.p.z() = above_mm - FootPlacesOf(further_W).row(2).minCoeff();
    return pose;
  }
  std::vector<Standing> Of(const std::vector<PoseState>& poses) const {
    return StandingFeetOf(body_, poses, std::vector<double>(poses.size(), 0.03));
  }

  const BodyModel body_{LoadBodyTable("full"), AverageSizes(1750)};
};

TEST_F(StandingFeet, TremblingFeetStandAtTheirMean) {
  std::vector<PoseState> poses;
  for (int i = 0; i < 20; ++i) poses.push_back(At(i % 2 == 0 ? -0.4 : 0.4, 0));
  const FootPlaces middle_W = FootPlacesOf(body_.FurtherPointsAt(body_.PostureAt(At(0, 0))));
  for (const Standing& standing : Of(poses))
    for (int i = 0; i < kContactCount; ++i) {
      EXPECT_GT(standing.contacts[i], kContactLimit);
      ASSERT_TRUE(standing.places_W[i]);
      EXPECT_NEAR((*standing.places_W[i] - middle_W.col(i)).norm(), 0, 1e-6);
    }
}

TEST_F(StandingFeet, FeetInTheAirOrInMotionStandNowhere) {
  std::vector<PoseState> flies, slides;
  for (int i = 0; i < 20; ++i) {
    flies.push_back(At(0, 200));
    slides.push_back(At(100 * i, 0));
  }
  for (const auto& poses : {flies, slides})
    for (const Standing& standing : Of(poses))
      for (const auto& place_W : standing.places_W) EXPECT_FALSE(place_W);
}

TEST_F(StandingFeet, BeginAndEndAlikeInBothDirectionsOfTime) {
  std::vector<PoseState> poses;
  for (int i = 0; i < 30; ++i) poses.push_back(At(i < 10 || i >= 20 ? 40.0 * i : 400, 0));
  std::vector<PoseState> back(poses.rbegin(), poses.rend());
  const std::vector<Standing> forward = Of(poses), backward = Of(back);
  for (std::size_t i = 0; i < forward.size(); ++i)
    EXPECT_NEAR((forward[i].contacts - backward[forward.size() - 1 - i].contacts).norm(), 0, 1e-9);
}

}  // namespace
}  // namespace mocap
