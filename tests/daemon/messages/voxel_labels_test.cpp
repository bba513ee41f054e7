#include "daemon/messages/voxel_labels.h"

#include <gtest/gtest.h>

#include <array>

#include "config/load_config.h"
#include "core/body/stance.h"
#include "tests/support/voxelized_body.h"

namespace mocap {
namespace {

TEST(VoxelLabels, NameThePartThatAVoxelLiesIn) {
  const BodyModel body(LoadBodyTable("full"), AverageSizes(1750));
  PoseState pose;
  pose.X_WT.p = Vector3(0, 0, 1200);
  const ArmStance out{.raise = 0};
  pose.theta = AnglesOf({.arm_l = out, .arm_r = out}, body.table());
  VoxelGrid grid = Voxelize(body, pose, 25);
  grid.Set(0, 0, grid.size().z() - 1);  // Nobody is in that corner.
  std::vector<std::int8_t> labels;
  // Somebody else is far away, and as good as not there.
  PoseState elsewhere = pose;
  elsewhere.X_WT.p.x() = 9000;
  LabelForViewers(grid, std::array{BodyInPlace{body, elsewhere}, BodyInPlace{body, pose}}, labels);

  const BodyPoints points_W = body.PointsAt(body.PostureAt(pose));
  std::size_t index = 0;
  std::array<int, kBodyPartCount> seen{};
  for (int k = 0; k < grid.size().z(); ++k) {
    for (int j = 0; j < grid.size().y(); ++j) {
      for (int i = 0; i < grid.size().x(); ++i) {
        if (!grid.Test(i, j, k)) continue;
        const int label = labels.at(index++);
        // A part's own centroid lies in the part.
        for (int part = 0; part < kBodyPartCount; ++part) {
          if ((grid.CenterOf(i, j, k) - points_W.col(part)).norm() > 22) continue;
          EXPECT_EQ(label, part);
          ++seen[part];
        }
        if (i == 0 && j == 0) {
          EXPECT_EQ(label, -1);
        }
      }
    }
  }
  EXPECT_EQ(index, labels.size());
  for (int part = 0; part < kBodyPartCount; ++part) EXPECT_GT(seen[part], 0) << "part " << part;
}

}  // namespace
}  // namespace mocap
