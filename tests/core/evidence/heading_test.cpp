#include "core/evidence/heading.h"

#include <gtest/gtest.h>

#include "tests/support/voxelized_shapes.h"

namespace mocap {
namespace {

// A box in the air: nobody's feet are seen here.
class HeadingWatchTest : public ::testing::Test {
 protected:
  /// The box moves along the floor for a second, at a speed and in a direction.
  Heading Walk(const Vector3& mm_per_s, double dt_s = 0.04) {
    Heading heading;
    for (int i = 0; i < static_cast<int>(1 / dt_s); ++i) {
      const Vector3 at_W = i * dt_s * mm_per_s + Vector3(0, 0, 1000);
      VoxelCloud cloud;
      cloud.Build(
          FillGrid(at_W - Vector3::Constant(200), at_W + Vector3::Constant(200), 20,
                   [&](const Vector3& p_W) { return (p_W - at_W).cwiseAbs().maxCoeff() < 150; }));
      heading = watch_.Look(cloud, i == 0 ? 0 : dt_s);
    }
    return heading;
  }

  HeadingWatch watch_;
};

TEST_F(HeadingWatchTest, FeetAreNotNeededToSeeWhichWaySomebodyWalks) {
  const Heading heading = Walk({1000, 200, 0});
  EXPECT_FALSE(heading.toes_W);
  ASSERT_TRUE(heading.walks_W);
  EXPECT_GT(heading.walks_W->normalized().dot(Vector3(1000, 200, 0).normalized()), 0.99);
  EXPECT_EQ(heading.walks_W->z(), 0);
}

TEST_F(HeadingWatchTest, TheWayIsTheSameWhateverTheRate) {
  const std::optional<Vector3> often_W = Walk({0, 1000, 0}, 0.02).walks_W;
  watch_.StartOver();
  const std::optional<Vector3> rarely_W = Walk({0, 1000, 0}, 0.1).walks_W;
  ASSERT_TRUE(often_W && rarely_W);
  EXPECT_GT(often_W->normalized().dot(rarely_W->normalized()), 0.99);
}

TEST_F(HeadingWatchTest, StepsOfADanceAreNoWay) { EXPECT_FALSE(Walk({300, 0, 0}).walks_W); }

TEST_F(HeadingWatchTest, WhoRisesGoesNowhere) { EXPECT_FALSE(Walk({0, 0, 1000}).walks_W); }

TEST_F(HeadingWatchTest, TheNextPersonHasNoWayYet) {
  ASSERT_TRUE(Walk({-1000, 0, 0}).walks_W);
  watch_.StartOver();
  EXPECT_FALSE(Walk({0, 0, 0}, 0.5).walks_W);
}

}  // namespace
}  // namespace mocap
