#include "core/reconstruction/silhouette/line_range.h"

#include <gtest/gtest.h>

namespace mocap {
namespace {

TEST(LineRange, IsWhereALineIsWithinABox) {
  const Eigen::AlignedBox3d box_W(Vector3(100, -50, -50), Vector3(300, 50, 50));
  const auto through = RangeWithin(box_W, Vector3::Zero(), Vector3::UnitX());
  ASSERT_TRUE(through);
  EXPECT_EQ(through->from_mm, 100);
  EXPECT_EQ(through->to_mm, 300);
  const auto from_inside = RangeWithin(box_W, Vector3(200, 0, 0), Vector3::UnitX());
  ASSERT_TRUE(from_inside);
  EXPECT_EQ(from_inside->from_mm, 0);
  EXPECT_EQ(from_inside->to_mm, 100);
}

TEST(LineRange, IsEmptyBesideAndBehindABox) {
  const Eigen::AlignedBox3d box_W(Vector3(100, -50, -50), Vector3(300, 50, 50));
  EXPECT_FALSE(RangeWithin(box_W, Vector3(0, 60, 0), Vector3::UnitX()));
  EXPECT_FALSE(RangeWithin(box_W, Vector3::Zero(), -Vector3::UnitX()));
  EXPECT_FALSE(RangeWithin(Eigen::AlignedBox3d(), Vector3::Zero(), Vector3::UnitX()));
}

}  // namespace
}  // namespace mocap
