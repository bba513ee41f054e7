#include "core/reconstruction/carving/room_blocks.h"

#include <gtest/gtest.h>

#include "tests/core/reconstruction/synthetic_studio.h"

namespace mocap {
namespace {

constexpr double kVoxelMm = 25;

// Whether the blocks hold a place.
bool Holds(const RoomBlocks& room, const Vector3& p_W) {
  const Eigen::Vector3i voxel = (p_W / kVoxelMm).array().floor().cast<int>();
  return std::ranges::any_of(room.blocks(), [&](const Eigen::Vector3i& block) {
    const Eigen::Array3i within = (voxel - room.first_voxel() - block).array();
    return (within >= 0).all() && (within < RoomBlocks::kBlock_voxels).all();
  });
}

TEST(RoomBlocks, HoldEverybodyAndLittleMore) {
  SyntheticStudio studio;
  std::vector<DrawnCapsule> both = StandingPerson(-900, 300);
  for (const DrawnCapsule& part : StandingPerson(900, -600)) both.push_back(part);
  studio.Show(both);
  RoomBlocks room;
  room.Find(studio.Views(), 3, kVoxelMm);
  for (const DrawnCapsule& part : both) {
    EXPECT_TRUE(Holds(room, part.a_W));
    EXPECT_TRUE(Holds(room, part.b_W));
  }
  EXPECT_LT(room.blocks().size() * 0.4 * 0.4 * 0.4, 30);  // Of the room's 250 m³.
}

TEST(RoomBlocks, NobodyLeavesNone) {
  SyntheticStudio studio;
  studio.Show({});
  RoomBlocks room;
  room.Find(studio.Views(), 3, kVoxelMm);
  EXPECT_TRUE(room.blocks().empty());
}

TEST(RoomBlocks, DoNotReachBelowTheFloorsTolerance) {
  SyntheticStudio studio;
  studio.Show({{{0, 0, -400}, {0, 0, 500}, 100}});
  RoomBlocks room;
  room.Find(studio.Views(), 3, kVoxelMm);
  ASSERT_FALSE(room.blocks().empty());
  EXPECT_NEAR(room.first_voxel().z() * kVoxelMm, -50, 1e-6);
}

}  // namespace
}  // namespace mocap
