#include "daemon/pipeline/grid_memory.h"

#include <gtest/gtest.h>

#include <vector>

namespace mocap {
namespace {

constexpr int kSmall = 64, kLarge = 256;
constexpr double kVoxel_mm = 25;

class GridMemoryTest : public ::testing::Test {
 protected:
  /// A set on its way: its grid is filled, used, and given back.
  void Pass(VoxelGrid& grid, int side) {
    const std::size_t before = grid.capacity_bytes();
    grid.Reset(Eigen::Vector3i::Zero(), Eigen::Vector3i::Constant(side), kVoxel_mm);
    memory_.NoteGrowth(before, grid);
    memory_.Bound(grid);
  }
  static std::size_t BytesOf(int side) {
    VoxelGrid grid;
    grid.Reset(Eigen::Vector3i::Zero(), Eigen::Vector3i::Constant(side), kVoxel_mm);
    return grid.capacity_bytes();
  }
  std::size_t Kept() const {
    std::size_t kept = 0;
    for (const VoxelGrid& grid : grids_) kept += grid.capacity_bytes();
    return kept;
  }

  std::vector<VoxelGrid> grids_ = std::vector<VoxelGrid>(130);
  GridMemory memory_{BytesOf(kSmall), 4 * BytesOf(kLarge)};
};

TEST_F(GridMemoryTest, WhatIsUsualIsKeptForEver) {
  for (int i = 0; i < 3; ++i) {
    for (VoxelGrid& grid : grids_) Pass(grid, kSmall);
  }
  EXPECT_EQ(Kept(), grids_.size() * BytesOf(kSmall));
  EXPECT_EQ(memory_.beyond_bytes(), 0u);
}

TEST_F(GridMemoryTest, LargeOnesAreKeptUpToALimitForAll) {
  for (int i = 0; i < 3; ++i) {
    for (VoxelGrid& grid : grids_) Pass(grid, kLarge);
    EXPECT_LE(Kept(), 5 * BytesOf(kLarge));
  }
  EXPECT_GT(Kept(), 0u) << "some stay";
  const std::size_t kept = Kept();
  for (VoxelGrid& grid : grids_) Pass(grid, kSmall);
  EXPECT_LE(Kept(), kept + grids_.size() * BytesOf(kSmall));
}

TEST_F(GridMemoryTest, AGridThatGaveItsMemoryBackIsUsedAgain) {
  for (VoxelGrid& grid : grids_) Pass(grid, kLarge);
  VoxelGrid& grid = grids_.back();
  grid.Reset(Eigen::Vector3i::Zero(), Eigen::Vector3i::Constant(kLarge), kVoxel_mm);
  grid.Set(kLarge - 1, kLarge - 1, kLarge - 1);
  EXPECT_TRUE(grid.Test(kLarge - 1, kLarge - 1, kLarge - 1));
}

}  // namespace
}  // namespace mocap
