#include "core/reconstruction/carving/voxel_cloud.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/evidence/bounding_edges.h"

namespace mocap {
namespace {

constexpr double kVoxelMm = 25;

// Fills a ball of voxels; coordinates in voxels.
void AddBall(const Vector3& center, double radius, VoxelGrid& grid) {
  for (int k = 0; k < grid.size().z(); ++k) {
    for (int j = 0; j < grid.size().y(); ++j) {
      for (int i = 0; i < grid.size().x(); ++i) {
        if ((Vector3(i, j, k) - center).norm() <= radius) grid.Set(i, j, k);
      }
    }
  }
}

VoxelGrid Room() {
  VoxelGrid grid;
  grid.Reset({-20, -10, 0}, {70, 40, 40}, kVoxelMm);
  return grid;
}

TEST(Cloud, DropsIslandsButKeepsALargePieceNearby) {
  VoxelGrid grid = Room();
  AddBall({15, 20, 20}, 10, grid);
  VoxelCloud body;
  body.Build(grid);
  const int size = body.size();
  AddBall({29, 20, 20}, 2, grid);  // A hand, cut off at the wrist.
  AddBall({60, 20, 20}, 3, grid);  // Larger, but far away.
  grid.Set(28, 10, 10);            // Near, but nothing.
  VoxelCloud cloud;
  cloud.Build(grid);
  EXPECT_EQ(cloud.size(), size + 33);
  EXPECT_LT(cloud.IndexAt(Eigen::Vector3i(60, 20, 20)), 0);
  EXPECT_LT(cloud.IndexAt(Eigen::Vector3i(28, 10, 10)), 0);
  const int index = cloud.IndexAt(grid.CenterOf(29, 20, 20));
  ASSERT_GE(index, 0);
  EXPECT_EQ(cloud.voxels()[index].cell, Eigen::Vector3i(29, 20, 20));
}

TEST(Cloud, EveryVoxelIsFoundInItsCell) {
  VoxelGrid grid;
  grid.Reset({0, 0, 0}, {150, 30, 30}, kVoxelMm);
  for (const double x : {10.0, 62.0, 70.0, 140.0}) AddBall({x, 15, 15}, 8, grid);
  for (int i = 10; i < 140; ++i) grid.Set(i, 15, 15);
  VoxelCloud cloud;
  cloud.Build(grid);
  for (int i = 0; i < cloud.size(); ++i) EXPECT_EQ(cloud.IndexAt(cloud.voxels()[i].cell), i);
}

TEST(Cloud, IsMetWhereALineFirstAndLastHoldsAVoxel) {
  VoxelGrid grid = Room();
  AddBall({30, 20, 20}, 9, grid);
  AddBall({45, 20, 20}, 3, grid);
  VoxelCloud cloud;
  cloud.Build(grid);
  const Vector3 through_W = grid.CenterOf(0, 20, 20);
  for (double turn = -0.5; turn <= 0.5; turn += 0.05) {
    const Vector3 step_W(0.8 * kVoxelMm, turn * kVoxelMm, 0.3 * turn * kVoxelMm);
    constexpr int kSteps = 61;
    int first = -1, last = -1;
    for (int i = 0; i < kSteps; ++i) {
      if (!cloud.IsFlesh(through_W + i * step_W)) continue;
      if (first < 0) first = i;
      last = i;
    }
    // Places outside the block of voxels are not looked at.
    const int count = std::min(kSteps, static_cast<int>(20 / std::max(0.01, std::abs(turn))));
    const VoxelCloud::Places places = cloud.PlacesAlong(through_W, step_W);
    const VoxelCloud::Stretch stretch = cloud.StretchOf(places, count);
    EXPECT_LE(stretch.end - stretch.begin, 40);
    const std::optional<int> found = cloud.FirstHeld(places, stretch);
    ASSERT_EQ(found.value_or(-1), first);
    if (found) {
      EXPECT_EQ(cloud.LastHeld(places, stretch), last);
    }
  }
}

TEST(Cloud, SurfaceNormalsPointOutOfABall) {
  VoxelGrid grid = Room();
  const Eigen::Vector3i center(20, 20, 20);
  AddBall(center.cast<double>(), 8, grid);
  VoxelCloud cloud;
  cloud.Build(grid);
  ASSERT_FALSE(cloud.surface().empty());
  for (const int index : cloud.surface()) {
    const Voxel& voxel = cloud.voxels()[index];
    const Vector3 out = (voxel.cell - center).cast<double>().normalized();
    EXPECT_GT(cloud.NormalAt(voxel).dot(out), 0.9);
  }
}

TEST(Cloud, SurfaceAtTheGridsEdgeHasNormalsToo) {
  VoxelGrid grid;
  grid.Reset({0, 0, 0}, {4, 4, 4}, kVoxelMm);
  AddBall({1.5, 1.5, 1.5}, 10, grid);
  VoxelCloud cloud;
  cloud.Build(grid);
  EXPECT_EQ(cloud.size(), 64);
  EXPECT_EQ(cloud.surface().size(), 56u);
  const Voxel& corner = cloud.voxels()[cloud.IndexAt(Eigen::Vector3i(0, 0, 0))];
  EXPECT_NEAR(cloud.NormalAt(corner).dot(Vector3(-1, -1, -1).normalized()), 1, 1e-9);
}

TEST(Cloud, HasNoSurfaceWhereItTouchesOthers) {
  VoxelGrid room = Room();
  AddBall({20, 20, 20}, 8, room);
  VoxelGrid person = Room();
  for (int k = 0; k < 40; ++k)
    for (int j = 0; j < 40; ++j)
      for (int i = 0; i < 20; ++i)
        if (room.Test(i, j, k)) person.Set(i, j, k);
  VoxelCloud cloud, whole;
  cloud.Build(person, room);
  whole.Build(room);
  for (const Voxel& voxel : cloud.voxels()) {
    const Voxel& same = whole.voxels()[whole.IndexAt(voxel.cell)];
    EXPECT_EQ(voxel.surface, same.surface);
    if (!voxel.surface) continue;
    EXPECT_EQ(cloud.NormalAt(voxel), whole.NormalAt(same));
  }
  EXPECT_LT(cloud.IndexAt(Eigen::Vector3i(24, 20, 20)), 0);
  EXPECT_TRUE(cloud.IsFlesh(room.CenterOf(24, 20, 20)));
}

// Rays along x that pass a ball above its highest voxels, and a camera's share of rays that miss
// it.
class Edges : public ::testing::Test {
 protected:
  Edges() {
    VoxelGrid grid = Room();
    AddBall({20, 20, 20}, 8, grid);
    cloud_.Build(grid);
    top_W_ = grid.CenterOf(20, 20, 28) + Vector3(0, 0, kVoxelMm / 2);
  }
  GrazingRay RayAbove(double mm) const {
    return {top_W_ + Vector3(-3000, 0, mm), Vector3::UnitX(), Vector3::UnitZ()};
  }
  Outline CameraThatMisses(int rays, int missing) const {
    Outline outline(rays, RayAbove(0));
    for (int i = 0; i < missing; ++i) outline[i] = RayAbove(150);
    return outline;
  }

  std::vector<BoundingEdge> Find(const std::vector<Outline>& outlines) const {
    std::vector<BoundingEdge> edges;
    FindBoundingEdges(cloud_, outlines, cloud_.box_W(), edges);
    return edges;
  }

  VoxelCloud cloud_;
  Vector3 top_W_;
};

TEST_F(Edges, LieAlongTheVoxelsThatTheirRayGrazes) {
  const std::vector<BoundingEdge> edges = Find({Outline{RayAbove(0)}});
  ASSERT_EQ(edges.size(), 1u);
  EXPECT_NEAR(edges[0].from_W.z(), top_W_.z(), 1e-9);
  EXPECT_LE(edges[0].from_W.x(), top_W_.x());
  EXPECT_GE(edges[0].to_W.x(), top_W_.x() - kVoxelMm);
  EXPECT_LT(edges[0].to_W.x() - edges[0].from_W.x(), 6 * kVoxelMm);
}

TEST_F(Edges, RaysThatMissCountWhicheverCameraTheyAreOf) {
  const auto missing = [](const std::vector<BoundingEdge>& edges, int camera) {
    return std::ranges::count_if(edges, [camera](const BoundingEdge& edge) {
      return edge.misses_hull && edge.camera == camera;
    });
  };
  const Outline good = CameraThatMisses(12, 0), half = CameraThatMisses(12, 6);
  for (const int misses : {0, 3, 11}) {
    const std::vector<BoundingEdge> of_one = Find({good, CameraThatMisses(12, misses), good});
    EXPECT_EQ(of_one.size(), 36u);
    EXPECT_EQ(missing(of_one, 0), 0);
    EXPECT_EQ(missing(of_one, 1), misses);
    const std::vector<BoundingEdge> of_all = Find({half, CameraThatMisses(12, misses), half});
    EXPECT_EQ(of_all.size(), 36u);
    EXPECT_EQ(missing(of_all, 1), misses);
    EXPECT_EQ(missing(of_all, 2), 6);
  }
}

TEST_F(Edges, RaysThatMissReachThroughThePersonsBox) {
  const Eigen::AlignedBox3d box_W(top_W_ - Vector3(500, 500, 900), top_W_ + Vector3(500, 500, 200));
  std::vector<BoundingEdge> edges;
  const std::vector<Outline> outlines(3, CameraThatMisses(12, 1));
  FindBoundingEdges(cloud_, outlines, box_W, edges);
  ASSERT_EQ(edges.size(), 36u);
  const double longest_mm =
      std::ranges::max(edges, {},
                       [](const BoundingEdge& edge) { return (edge.to_W - edge.from_W).norm(); })
          .to_W.x() -
      (top_W_.x() - 500);
  EXPECT_NEAR(longest_mm, 1000, 1e-6);
}

}  // namespace
}  // namespace mocap
