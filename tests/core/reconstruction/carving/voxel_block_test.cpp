#include "core/reconstruction/carving/voxel_block.h"

#include <gtest/gtest.h>

#include <random>

namespace mocap {
namespace {

using Eigen::AlignedBox3i;
using Eigen::Vector3i;

// Rows of more than two words, a third of the voxels set.
VoxelGrid Speckled() {
  std::mt19937 random(7);
  VoxelGrid grid;
  grid.Reset({-20, 5, -2}, {150, 7, 5}, 25);
  for (int k = 0; k < 5; ++k)
    for (int j = 0; j < 7; ++j)
      for (int i = 0; i < 150; ++i)
        if (random() % 3 == 0) grid.Set(i, j, k);
  return grid;
}

class BlockOfCells : public ::testing::TestWithParam<AlignedBox3i> {
 protected:
  const VoxelGrid grid_ = Speckled();
};

TEST_P(BlockOfCells, HasTheVoxelsOfItsPlaces) {
  VoxelGrid block;
  CopyBlock(grid_, GetParam(), block);
  EXPECT_EQ(block.first_voxel(), grid_.first_voxel() + GetParam().min());
  ASSERT_EQ(block.size(), GetParam().sizes() + Vector3i::Ones());
  int words_beyond = 0;
  for (int k = 0; k < block.size().z(); ++k) {
    for (int j = 0; j < block.size().y(); ++j) {
      for (int i = 0; i < block.size().x(); ++i) {
        const Vector3i at = GetParam().min() + Vector3i(i, j, k);
        ASSERT_EQ(block.Test(i, j, k), grid_.Test(at.x(), at.y(), at.z()));
      }
      for (int i = block.size().x(); i < 64 * block.words_per_row(); ++i)
        words_beyond += block.row(j, k)[i >> 6] >> (i & 63) & 1;
    }
  }
  EXPECT_EQ(words_beyond, 0);
}

TEST_P(BlockOfCells, AndWhatLiesBesideAreAll) {
  VoxelGrid block;
  CopyBlock(grid_, GetParam(), block);
  const AlignedBox3i nothing;
  EXPECT_NEAR(LitresBeside(grid_, GetParam()) + LitresBeside(block, nothing),
              LitresBeside(grid_, nothing), 1e-9);
}

INSTANTIATE_TEST_SUITE_P(VoxelBlock, BlockOfCells,
                         ::testing::Values(AlignedBox3i(Vector3i(0, 0, 0), Vector3i(149, 6, 4)),
                                           AlignedBox3i(Vector3i(3, 1, 1), Vector3i(66, 5, 3)),
                                           AlignedBox3i(Vector3i(64, 0, 0), Vector3i(127, 6, 4)),
                                           AlignedBox3i(Vector3i(70, 2, 2), Vector3i(149, 2, 2)),
                                           AlignedBox3i(Vector3i(149, 6, 4), Vector3i(149, 6, 4))));

TEST(VoxelBlock, OfABoxAreTheCellsThatItTouches) {
  const VoxelGrid grid = Speckled();
  const Vector3 corner = grid.origin_W();
  const AlignedBox3i cells =
      CellsWithin(grid, {corner + Vector3(30, 0, 49), corner + Vector3(75, 26, 51)});
  EXPECT_EQ(cells.min(), Vector3i(1, 0, 1));
  EXPECT_EQ(cells.max(), Vector3i(2, 1, 2));
  EXPECT_EQ(CellsWithin(grid, {corner - Vector3(99, 99, 99), grid.end_W()}).max(),
            Vector3i(149, 6, 4));
  EXPECT_TRUE(CellsWithin(grid, {}).isEmpty());
}

TEST(VoxelBlock, OfNoCellsHasNone) {
  VoxelGrid block;
  CopyBlock(Speckled(), {}, block);
  EXPECT_EQ(block.size(), Vector3i::Zero());
}

}  // namespace
}  // namespace mocap
