#include "tools/witness/keypoint_decoders.h"

#include <gtest/gtest.h>

#include <vector>

namespace mocap {
namespace {

TEST(KeypointDecoders, FindTheHighestCellOfAHeatmapAndLeanTowardsItsNeighbour) {
  // Two points, 3 rows of 4 cells; the input has 8 x 12 pixels.
  const std::vector<float> maps = {0, 0, 0, 0, 0, 9, 2, 0, 0, 1, 0, 0,  //
                                   0, 0, 0, 5, 0, 0, 0, 0, 0, 0, 0, -1};
  const std::vector<FoundPoint> found = DecodeHeatmaps(maps, 3, 4, 8, 12);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].crop_px, Vector2(1.25 * 2, 1.25 * 4));
  EXPECT_EQ(found[0].score, 9);
  EXPECT_EQ(found[1].crop_px, Vector2(6, 0)) << "at the edge there is no neighbour";
}

TEST(KeypointDecoders, KeepThePeakBetweenEqualNeighbours) {
  const std::vector<float> map = {0, 1, 0, 1, 4, 1, 0, 1, 0};
  EXPECT_EQ(DecodeHeatmaps(map, 3, 3, 3, 3)[0].crop_px, Vector2(1, 1));
}

TEST(KeypointDecoders, FindTheHighestBinsOfSimcc) {
  const std::vector<float> x = {0, 0, 0.5, 0, 0, 0.9f, 0, 0},
                           y = {0, 0, 0, 0, 0, 0.7f, 0, 1, 0, 0, 0, 0};
  const std::vector<FoundPoint> found = DecodeSimcc(x, y, 2, 2, 3);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].crop_px, Vector2(1, 2.5));
  EXPECT_EQ(found[0].score, 0.5);
  EXPECT_EQ(found[1].crop_px, Vector2(0.5, 0.5));
  EXPECT_FLOAT_EQ(static_cast<float>(found[1].score), 0.9f);
}

TEST(KeypointDecoders, ReadCoordinatesByTheirColumns) {
  using enum AnswerColumn;
  const std::vector<AnswerColumn> columns = {kY, kX, kUnused, kScore, kScore};
  const std::vector<float> numbers = {10, 20, 99, 0, 0, 30.5f, 40.5f, 99, 100, -100};
  const std::vector<FoundPoint> found = DecodeCoordinates(numbers, columns, true);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].crop_px, Vector2(19.5, 9.5)) << "pixel centres lie at integers";
  EXPECT_EQ(found[0].score, 0.25);
  EXPECT_EQ(found[1].crop_px, Vector2(40, 30));
  EXPECT_NEAR(found[1].score, 0, 1e-12);
  EXPECT_EQ(DecodeCoordinates(std::vector<float>{1, 2, 0, 0.5, 0.5}, columns, false)[0].score,
            0.25);
}

}  // namespace
}  // namespace mocap
