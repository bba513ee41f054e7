#include "tools/view/wire.h"

#include <gtest/gtest.h>

#include "tests/tools/view/number_at.h"

namespace mocap {
namespace {

TEST(Wire, APoseLiesWhereThePageReadsIt) {
  DrawnPose pose;
  pose.person = 2;
  pose.id = 300;
  pose.publish_ms = 1234.5;
  pose.row.state = CaptureState::kTracking;
  pose.row.has_pose = true;
  pose.row.frame = 77;
  pose.row.timestamp_ns = 1'500'250'000;
  pose.row.residual_mm = 12.5;
  pose.row.voxels = 3000;
  pose.row.points_W.col(22) = Vector3(1, 2, 3);
  pose.row.probability = 0.75;
  FurtherOf(pose.row.further_W, Point::kToeR) = Vector3(4, 5, 6);
  pose.row.contacts[3] = 0.625;
  pose.rival = RivalPose{0.25, BodyPoints::Constant(7)};
  pose.rival->points_W.col(22) = Vector3(1, 2, 3);
  pose.capsules.emplace_back(Vector3(4, 5, 6), Vector3(7, 8, 9), 50, 40);
  const std::string bytes = PoseBytes(pose);
  ASSERT_EQ(bytes.size(), 360u + 276 + 64);
  EXPECT_EQ(bytes.substr(0, 4), std::string("\1\2\2\1", 4));
  EXPECT_EQ(testing::NumberAt<std::uint16_t>(bytes, 4), 23);
  EXPECT_EQ(testing::NumberAt<std::uint16_t>(bytes, 6), 1);
  EXPECT_EQ(testing::NumberAt<double>(bytes, 8), 1500.25);
  EXPECT_EQ(testing::NumberAt<double>(bytes, 16), 1234.5);
  EXPECT_EQ(testing::NumberAt<double>(bytes, 24), 77);
  EXPECT_EQ(testing::NumberAt<float>(bytes, 32), 12.5f);
  EXPECT_EQ(testing::NumberAt<std::uint32_t>(bytes, 36), 3000u);
  EXPECT_EQ(testing::NumberAt<float>(bytes, 40 + 22 * 12 + 8), 3);
  EXPECT_EQ(testing::NumberAt<float>(bytes, 316 + 12), 50);
  EXPECT_EQ(testing::NumberAt<float>(bytes, 316 + 16), 7);
  EXPECT_EQ(testing::NumberAt<std::uint32_t>(bytes, 348), 300u);
  EXPECT_EQ(testing::NumberAt<float>(bytes, 352), 0.75f);
  EXPECT_EQ(testing::NumberAt<float>(bytes, 356), 0.25f);
  EXPECT_EQ(testing::NumberAt<float>(bytes, 360), 7);
  EXPECT_EQ(testing::NumberAt<float>(bytes, 360 + 22 * 12 + 8), 3);
  EXPECT_EQ(testing::NumberAt<float>(bytes, 360 + 276 + 48), 4);
  EXPECT_EQ(testing::NumberAt<float>(bytes, 360 + 276 + 60), 0.625f);
}

voxels_t Cube(int side) {
  voxels_t voxels{};
  voxels.utime = 2000;
  voxels.voxel_mm = 25;
  voxels.origin_mm[2] = -50;
  for (std::int32_t& size : voxels.size) size = side;
  voxels.run = {0, side * side * side};
  voxels.num_runs = 2;
  voxels.label.assign(static_cast<std::size_t>(side * side * side), 4);
  voxels.num_labels = side * side * side;
  return voxels;
}

TEST(Wire, OnlyVoxelsAtTheSurfaceGoOut) {
  const std::string bytes = VoxelBytes(Cube(5), 1);
  EXPECT_EQ(testing::NumberAt<std::uint32_t>(bytes, 4), 125u - 27u);
  EXPECT_EQ(bytes.size(), 32u + 8 * (125 - 27));
  EXPECT_EQ(testing::NumberAt<double>(bytes, 8), 2);
  EXPECT_EQ(testing::NumberAt<float>(bytes, 16), 25);
  EXPECT_EQ(testing::NumberAt<float>(bytes, 28), -50);
  EXPECT_EQ(testing::NumberAt<std::int16_t>(bytes, 38), 4);
}

TEST(Wire, VoxelsWithoutLabelsHaveNone) {
  voxels_t voxels = Cube(1);
  voxels.label.clear();
  EXPECT_EQ(testing::NumberAt<std::int16_t>(VoxelBytes(voxels, 0), 38), -1);
}

TEST(Wire, AForgedGridIsNotBelieved) {
  voxels_t voxels = Cube(2);
  voxels.size[0] = 2'000'000'000;
  EXPECT_EQ(VoxelBytes(voxels, 0), "");
  voxels.size[0] = -1;
  EXPECT_EQ(VoxelBytes(voxels, 0), "");
  voxels = Cube(2);
  voxels.run = {0, 2'000'000'000, -5, 3};
  EXPECT_EQ(testing::NumberAt<std::uint32_t>(VoxelBytes(voxels, 0), 4), 8u);
}

TEST(Wire, AHallFullOfPeopleIsNotBelieved) {
  voxels_t voxels = Cube(1);
  for (std::int32_t& size : voxels.size) size = 400;
  voxels.run = {0, 400 * 400 * 400};
  EXPECT_EQ(VoxelBytes(voxels, 0), "");
  voxels.run = {400 * 400 * 400 - 1, 1};
  EXPECT_EQ(testing::NumberAt<std::uint32_t>(VoxelBytes(voxels, 0), 4), 1u);
}

TEST(Wire, APictureCarriesItsLinesAndItsJpeg) {
  const std::vector<std::uint8_t> jpeg = {1, 2, 3};
  DrawnPicture picture;
  picture.camera = 3;
  picture.width_px = 640;
  picture.height_px = 480;
  picture.silhouette = {{{1, 2}, {3, 4}, {5, 6}}};
  picture.unknown = {{{11, 12}}};
  picture.bodies = {{.person = 0, .lines = {{BodySide::kRight, {{7, 8}, {9, 10}}}}}};
  picture.jpeg = jpeg;
  const std::string bytes = PictureBytes(picture);
  EXPECT_EQ(bytes.size() % 8, 0u);
  EXPECT_EQ(bytes[1], 3);
  EXPECT_EQ(testing::NumberAt<std::uint16_t>(bytes, 2), 640);
  EXPECT_EQ(testing::NumberAt<std::uint32_t>(bytes, 16), 12u);
  EXPECT_EQ(testing::NumberAt<std::uint32_t>(bytes, 20), 6u);
  EXPECT_EQ(testing::NumberAt<std::uint32_t>(bytes, 24), 3u);
  EXPECT_EQ(testing::NumberAt<float>(bytes, 28), -1) << "nobody was seen";
  EXPECT_EQ(testing::NumberAt<float>(bytes, 32), 3);
  EXPECT_EQ(testing::NumberAt<float>(bytes, 32 + 8 * 4 + 4), 1) << "unknown pixels";
  EXPECT_EQ(testing::NumberAt<float>(bytes, 32 + 12 * 4 + 4), 2 + 4 * 1);
  EXPECT_EQ(bytes.substr(32 + 18 * 4, 3), "\1\2\3");
  picture.unknown_share = 0.25;
  EXPECT_EQ(testing::NumberAt<float>(PictureBytes(picture), 28), 0.25F);
}

TEST(Wire, KeypointsLieWhereThePageReadsThem) {
  const KeypointView view{
      .camera = "cam3",
      .capture_ns = 1'500'250'000,
      .person = 300,
      .points = {{Landmark::kShoulderL, {10.5F, 20}, 0.25F}, {Landmark::kSmallToeR, {30, 40}, 1}}};
  const std::string bytes = KeypointBytes(view, 3);
  ASSERT_EQ(bytes.size(), 16u + 2 * 16);
  EXPECT_EQ(bytes.substr(0, 4), std::string("\4\3\2\0", 4));
  EXPECT_EQ(testing::NumberAt<std::uint32_t>(bytes, 4), 300u);
  EXPECT_EQ(testing::NumberAt<double>(bytes, 8), 1500.25);
  EXPECT_EQ(testing::NumberAt<float>(bytes, 16), 9);
  EXPECT_EQ(testing::NumberAt<float>(bytes, 20), 10.5F);
  EXPECT_EQ(testing::NumberAt<float>(bytes, 24), 20);
  EXPECT_EQ(testing::NumberAt<float>(bytes, 28), 0.25F);
  EXPECT_EQ(testing::NumberAt<float>(bytes, 32), 31);
}

}  // namespace
}  // namespace mocap
