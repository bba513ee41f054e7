#include "core/calibration/seen_shape.h"

#include <gtest/gtest.h>

#include <random>

namespace mocap {
namespace {

/// On which side of the way from a to b a point lies; 0: on it.
double SideOf(const Vector2& a, const Vector2& b, const Vector2& point) {
  const Vector2 way = b - a, there = point - a;
  return way.x() * there.y() - way.y() * there.x();
}

TEST(SeenShape, RimSurroundsEveryPixelAndTouchesSome) {
  std::mt19937 random(7);
  for (int trial = 0; trial < 20; ++trial) {
    Silhouette silhouette(150, 90);
    std::uniform_int_distribution<int> x(20, 130), y(10, 80);
    for (int i = 0; i < 30; ++i) silhouette.Set(x(random), y(random));
    const SeenShape shape = ShapeOf(silhouette, {});
    const std::size_t corners = shape.rim_px.size();
    ASSERT_GE(corners, 3u);
    for (std::size_t i = 0; i < corners; ++i) {
      const Vector2 &a = shape.rim_px[i], &b = shape.rim_px[(i + 1) % corners];
      EXPECT_TRUE(silhouette.Test(static_cast<int>(a.x()), static_cast<int>(a.y())));
      for (int v = 0; v < 90; ++v) {
        for (int u = 0; u < 150; ++u) {
          if (!silhouette.Test(u, v)) continue;
          EXPECT_LE(SideOf(a, b, Vector2(u, v)), 0) << u << ' ' << v;
        }
      }
    }
  }
}

TEST(SeenShape, TellsWhatThePictureCutsOff) {
  Silhouette silhouette(64, 40);
  silhouette.Set(30, 20);
  EXPECT_FALSE(ShapeOf(silhouette, {}).is_cut);
  EXPECT_EQ(ShapeOf(silhouette, {}).height_share, 1.0 / 40);
  silhouette.Set(30, 39);
  EXPECT_TRUE(ShapeOf(silhouette, {}).is_cut);
  EXPECT_EQ(ShapeOf(silhouette, {}).height_share, 0.5);
}

TEST(SeenShape, NobodyHasNoRim) {
  const SeenShape shape = ShapeOf(Silhouette(64, 40), {});
  EXPECT_TRUE(shape.rim_px.empty());
  EXPECT_EQ(shape.height_share, 0);
}

}  // namespace
}  // namespace mocap
