#include "daemon/pipeline/grid_shelf.h"

#include <gtest/gtest.h>

#include <deque>
#include <vector>

#include "tests/support/allocation_counter.h"

namespace mocap {
namespace {

constexpr int kPersonSide = 64, kRoomSide = 256;
constexpr double kVoxelMm = 25;

VoxelGrid GridOf(int side) {
  VoxelGrid grid;
  grid.Reset(Eigen::Vector3i::Zero(), Eigen::Vector3i::Constant(side), kVoxelMm);
  return grid;
}

/// Sets that go round in order, as in the queue between carving and tracking.
class GridShelfTest : public ::testing::Test {
 protected:
  /// Brings sets on their way, of which so many wait at once.
  void Pass(int sets, int side, std::size_t waiting = 1) {
    for (int i = 0; i < sets; ++i) {
      shelf_.Take(slots_.front());
      slots_.front().Reset(Eigen::Vector3i::Zero(), Eigen::Vector3i::Constant(side), kVoxelMm);
      Turn(slots_, under_way_);
      if (under_way_.size() < waiting) continue;
      shelf_.Give(under_way_.front());
      Turn(under_way_, slots_);
    }
    while (!under_way_.empty()) {
      shelf_.Give(under_way_.front());
      Turn(under_way_, slots_);
    }
  }
  /// Memory of the sets, none of which is under way.
  std::size_t KeptBySets() const {
    std::size_t kept = 0;
    for (const VoxelGrid& grid : slots_) kept += grid.capacity_bytes();
    return kept;
  }
  std::size_t KeptOnShelf() {
    std::size_t kept = 0;
    for (std::size_t i = 0; i <= GridShelf::kPlaces; ++i) {
      VoxelGrid grid;
      shelf_.Take(grid);
      kept += grid.capacity_bytes();
    }
    return kept;
  }

  std::deque<VoxelGrid> slots_ = std::deque<VoxelGrid>(130);
  std::deque<VoxelGrid> under_way_;
  GridShelf shelf_{GridOf(kPersonSide)};

 private:
  static void Turn(std::deque<VoxelGrid>& from, std::deque<VoxelGrid>& to) {
    to.push_back(std::move(from.front()));
    from.pop_front();
  }
};

TEST_F(GridShelfTest, KeepsTheSameMemoryHoweverManySetsPass) {
  Pass(1000, kRoomSide);
  EXPECT_EQ(KeptBySets(), 0u);
  EXPECT_EQ(KeptOnShelf(), GridShelf::kPlaces * GridOf(kRoomSide).capacity_bytes());
}

TEST_F(GridShelfTest, FreesWhatWasNeededWhileManyWaited) {
  Pass(300, kRoomSide, 120);
  EXPECT_EQ(KeptBySets(), 0u);
  EXPECT_EQ(KeptOnShelf(), GridShelf::kPlaces * GridOf(kRoomSide).capacity_bytes());
}

TEST_F(GridShelfTest, HasMemoryFromTheBeginning) {
  EXPECT_EQ(KeptOnShelf(), GridShelf::kPlaces * GridOf(kPersonSide).capacity_bytes());
}

TEST_F(GridShelfTest, AllocatesNothingForAFewSetsAtOnce) {
  if (!kCountsAllocations) GTEST_SKIP() << "the sanitizer allocates by itself";
  const int places = static_cast<int>(GridShelf::kPlaces);
  std::vector<VoxelGrid> sets(GridShelf::kPlaces);
  const auto pass = [&] {
    for (VoxelGrid& grid : sets) {
      shelf_.Take(grid);
      grid.Reset(Eigen::Vector3i::Zero(), Eigen::Vector3i::Constant(kRoomSide), kVoxelMm);
    }
    for (VoxelGrid& grid : sets) shelf_.Give(grid);
  };
  pass();
  const std::int64_t before = Allocations();
  for (int i = 0; i < places; ++i) pass();
  EXPECT_EQ(Allocations() - before, 0);
}

TEST_F(GridShelfTest, GivesGridsThatAreUsedAgain) {
  Pass(300, kRoomSide, 120);
  VoxelGrid grid;
  shelf_.Take(grid);
  grid.Reset(Eigen::Vector3i::Zero(), Eigen::Vector3i::Constant(kRoomSide), kVoxelMm);
  EXPECT_FALSE(grid.Test(kRoomSide - 1, kRoomSide - 1, kRoomSide - 1));
  grid.Set(kRoomSide - 1, kRoomSide - 1, kRoomSide - 1);
  EXPECT_TRUE(grid.Test(kRoomSide - 1, kRoomSide - 1, kRoomSide - 1));
}

}  // namespace
}  // namespace mocap
