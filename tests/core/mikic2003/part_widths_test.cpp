#include "core/mikic2003/part_widths.h"

#include <gtest/gtest.h>

#include "core/mikic2003/limbs.h"
#include "tests/support/voxelized_shapes.h"

namespace mocap::mikic2003 {
namespace {

// Two upright rods of 400 mm, 100 and 140 mm thick.
class Rods : public ::testing::Test {
 protected:
  Rods() {
    cloud_.Build(FillGrid({-300, -200, -250}, {300, 200, 250}, 12.5, [](const Vector3& p_W) {
      const double left = Eigen::Vector2d(p_W.x() + 60, p_W.y()).norm();
      const double right = Eigen::Vector2d(p_W.x() - 75, p_W.y()).norm();
      return std::abs(p_W.z()) < 200 && (left < 50 || right < 70);
    }));
    labels_.assign(cloud_.size(), kUnlabeled);
    for (int i = 0; i < cloud_.size(); ++i) {
      const bool is_left = cloud_.voxels()[i].center_W.x() < 0;
      labels_[i] = LabelOf(is_left ? BodyPart::kThighL : BodyPart::kThighR);
    }
  }

  VoxelCloud cloud_;
  Labels labels_;
  BodySizes sizes_;
};

TEST_F(Rods, WidthIsThatOfACylinderAndTheMeanOfBothSides) {
  MeasureLimbWidths(cloud_, labels_, sizes_);
  EXPECT_NEAR(sizes_.thigh_width, 120, 5);
}

TEST_F(Rods, OneSideAloneCounts) {
  SetLabel(VoxelsLabeled(labels_, LabelOf(BodyPart::kThighL)), kUnlabeled, labels_);
  MeasureLimbWidths(cloud_, labels_, sizes_);
  EXPECT_NEAR(sizes_.thigh_width, 140, 5);
}

TEST_F(Rods, APartWithoutVoxelsKeepsItsWidth) {
  sizes_.calf_width = 111;
  MeasureLimbWidths(cloud_, labels_, sizes_);
  EXPECT_EQ(sizes_.calf_width, 111);
}

}  // namespace
}  // namespace mocap::mikic2003
