#include "core/people/keypoint_division.h"

#include <gtest/gtest.h>

#include "config/load_config.h"
#include "core/body/stance.h"
#include "tests/support/keypoints_of_body.h"

namespace mocap {
namespace {

class KeypointsOfTwo : public ::testing::Test {
 protected:
  KeypointsOfTwo() {
    for (int i = 0; i < 2; ++i) {
      poses_[i].theta = AnglesOf({}, body_.table());
      poses_[i].X_WT.p = Vector3(0, 800.0 * i, 1000);
      people_.emplace_back().Set(body_, poses_[i]);
    }
  }
  KeypointRays ViewOf(const PoseState& pose) const {
    return KeypointsOf(body_, pose, {4000, 300, 1800});
  }

  BodyModel body_{LoadBodyTable("full"), AverageSizes(1750)};
  std::array<PoseState, 2> poses_;
  std::vector<PosedBody> people_;
  KeypointDivision division_;
};

TEST_F(KeypointsOfTwo, GoToWhomTheyFit) {
  const std::vector<KeypointRays> views = {ViewOf(poses_[1]), ViewOf(poses_[0]), ViewOf(poses_[1])};
  division_.Divide(views, people_, {});
  ASSERT_EQ(division_.shares().size(), 2u);
  EXPECT_EQ(division_.shares()[0].size(), 1u);
  EXPECT_EQ(division_.shares()[1].size(), 2u);
}

TEST_F(KeypointsOfTwo, GoToThemAlsoWithSidesExchanged) {
  KeypointRays view = ViewOf(poses_[1]);
  for (KeypointRay& ray : view.rays) ray.landmark = Mirrored(ray.landmark);
  division_.Divide({{view}}, people_, {});
  EXPECT_TRUE(division_.shares()[0].empty());
  EXPECT_EQ(division_.shares()[1].size(), 1u);
}

TEST_F(KeypointsOfTwo, GoToAStrangerWhoIsThereOrToNobody) {
  PoseState stranger = poses_[0];
  stranger.X_WT.p.y() = -1500;
  const Eigen::AlignedBox3d box_W(Vector3(-600, -2100, 0), Vector3(600, -900, 2100));
  division_.Divide({{ViewOf(stranger)}}, people_, {{box_W}});
  ASSERT_EQ(division_.shares().size(), 3u);
  EXPECT_EQ(division_.shares()[2].size(), 1u);
  division_.Divide({{ViewOf(stranger)}}, people_, {});
  for (const auto& share : division_.shares()) EXPECT_TRUE(share.empty());
}

}  // namespace
}  // namespace mocap
