#include "core/mikic2003/cylinder.h"

#include <gtest/gtest.h>

#include <numeric>

#include "tests/support/voxelized_shapes.h"

namespace mocap::mikic2003 {
namespace {

// A solid elliptic cylinder of 600 mm that hangs from the origin.
class Trunk : public ::testing::Test {
 protected:
  Trunk() {
    cloud_.Build(FillGrid({-400, -400, -900}, {400, 400, 200}, 25,
                          [this](const Vector3& p_W) { return truth_.Contains(p_W); }));
    all_.resize(cloud_.size());
    std::iota(all_.begin(), all_.end(), 0);
  }
  static double DegreesBetween(const Vector3& a, const Vector3& b) {
    return std::acos(std::clamp(a.dot(b), -1.0, 1.0)) * 180 / EIGEN_PI;
  }

  const Vector3 axis_W_ = Vector3(0.3, -0.2, -1).normalized();
  const Cylinder truth_{
      Vector3(10, 20, 30), axis_W_, Vector3::UnitY().cross(axis_W_).normalized(), 600, 160, 110};
  VoxelCloud cloud_;
  VoxelIndices all_;
};

TEST_F(Trunk, Figure7TemplateTurnsUntilItsAxisMeetsTheCentroid) {
  const Vector3 start_W = Vector3(-0.4, 0.4, -1).normalized();
  ASSERT_GT(DegreesBetween(start_W, axis_W_), 40);
  const Cylinder fitted =
      FitCylinder(cloud_, all_, RoundCylinder(truth_.anchor_W, start_W, 550, 160));
  EXPECT_LT(DegreesBetween(fitted.axis_W, axis_W_), 2);
  EXPECT_EQ(fitted.anchor_W, truth_.anchor_W);
}

TEST_F(Trunk, Figure7TemplateStaysWhereNoVoxelsAre) {
  const Cylinder start = RoundCylinder({2000, 0, 0}, Vector3::UnitX(), 500, 100);
  EXPECT_EQ(FitCylinder(cloud_, all_, start).axis_W, start.axis_W);
}

TEST_F(Trunk, Figure10SmallTemplateGrowsToTheTrunksSize) {
  Cylinder small = RoundCylinder(truth_.anchor_W, axis_W_, 150, 60);
  small.side_W = truth_.side_W;
  const Cylinder grown = GrowCylinder(cloud_, all_, small, 0.5, 2000);
  EXPECT_NEAR(grown.length_mm, truth_.length_mm, 40);
  EXPECT_NEAR(grown.half_width_mm, truth_.half_width_mm, 25);
  EXPECT_NEAR(grown.half_depth_mm, truth_.half_depth_mm, 25);
  EXPECT_LT(DegreesBetween(grown.axis_W, axis_W_), 3);
}

TEST_F(Trunk, Figure10GrowthIsReorientedOnItsWay) {
  Cylinder small =
      RoundCylinder(truth_.anchor_W, (axis_W_ + Vector3(0.15, 0.1, 0)).normalized(), 150, 60);
  EXPECT_LT(DegreesBetween(GrowCylinder(cloud_, all_, small, 0.5, 2000).axis_W, axis_W_), 3);
}

TEST_F(Trunk, GrowthEndsAtTheLongestLength) {
  const Cylinder grown =
      GrowCylinder(cloud_, all_, RoundCylinder(truth_.anchor_W, axis_W_, 150, 60), 0.5, 400);
  EXPECT_LE(grown.length_mm, 400);
  EXPECT_GT(grown.length_mm, 350);
}

TEST(CylinderTemplate, TurnsTheShortestWay) {
  Cylinder cylinder = RoundCylinder(Vector3::Zero(), Vector3::UnitZ(), 100, 10);
  cylinder.side_W = Vector3::UnitX();
  cylinder.TurnTo(Vector3(0, 1, 1).normalized());
  EXPECT_LT((cylinder.side_W - Vector3::UnitX()).norm(), 1e-12);
  EXPECT_NEAR(cylinder.side_W.dot(cylinder.axis_W), 0, 1e-12);
}

}  // namespace
}  // namespace mocap::mikic2003
