#include "core/reconstruction/carving/watershed.h"

#include <gtest/gtest.h>

#include "core/people/flesh_division.h"

namespace mocap {
namespace {

constexpr double kHillVoxelMm = 25;

// Flesh of blocks, as one piece.
class Flesh {
 public:
  Flesh() { grid_.Reset({0, 0, 0}, {140, 60, 90}, kHillVoxelMm); }

  // From one place to the other [voxels].
  void Fill(const Eigen::Vector3i& from, const Eigen::Vector3i& to) {
    for (int k = from.z(); k < to.z(); ++k)
      for (int j = from.y(); j < to.y(); ++j)
        for (int i = from.x(); i < to.x(); ++i) grid_.Set(i, j, k);
  }
  // Legs, a trunk with shoulders, and a head.
  void Stand(int x, int height) {
    Fill({x - 8, 25, 0}, {x + 8, 35, height - 12});
    Fill({x - 4, 26, height - 12}, {x + 4, 34, height});
  }
  const Watershed& Divide() {
    pieces_.Find(grid_);
    EXPECT_EQ(pieces_.sizes().size(), 1u);
    watershed_.Divide(pieces_.runs(), grid_, FleshDivision::kPerson);
    return watershed_;
  }

 private:
  VoxelGrid grid_;
  VoxelPieces pieces_;
  Watershed watershed_;
};

TEST(Watershed, TwoWhoShakeHandsAreTwo) {
  Flesh flesh;
  flesh.Stand(20, 70);
  flesh.Stand(60, 64);
  flesh.Fill({28, 28, 40}, {52, 31, 43});
  const Watershed& hills = flesh.Divide();
  ASSERT_EQ(hills.count(), 2);
  for (const int i : {12, 20, 27}) EXPECT_EQ(hills.HillAt(i, 30), hills.HillAt(20, 30));
  for (const int i : {53, 60, 67}) EXPECT_EQ(hills.HillAt(i, 30), hills.HillAt(60, 30));
  EXPECT_NE(hills.HillAt(20, 30), hills.HillAt(60, 30));
}

TEST(Watershed, ShoulderToShoulderStandTwo) {
  Flesh flesh;
  flesh.Stand(20, 70);
  flesh.Stand(36, 66);
  EXPECT_EQ(flesh.Divide().count(), 2);
}

TEST(Watershed, ARaisedArmIsNobody) {
  Flesh flesh;
  flesh.Stand(20, 64);
  flesh.Fill({28, 28, 48}, {40, 32, 52});
  flesh.Fill({38, 28, 48}, {42, 32, 84});
  EXPECT_EQ(flesh.Divide().count(), 1);
}

TEST(Watershed, WhoSitsOnTheFloorWithKneesUpIsOne) {
  Flesh flesh;
  flesh.Fill({10, 20, 0}, {26, 40, 26});
  flesh.Fill({14, 26, 26}, {22, 34, 36});
  flesh.Fill({26, 20, 0}, {34, 40, 8});
  flesh.Fill({34, 20, 0}, {44, 40, 22});
  EXPECT_EQ(flesh.Divide().count(), 1);
}

TEST(Watershed, WhoLiesIsOne) {
  Flesh flesh;
  flesh.Fill({5, 20, 0}, {75, 40, 10});
  flesh.Fill({60, 22, 10}, {70, 38, 13});
  flesh.Fill({20, 22, 10}, {30, 38, 14});
  EXPECT_EQ(flesh.Divide().count(), 1);
}

}  // namespace
}  // namespace mocap
