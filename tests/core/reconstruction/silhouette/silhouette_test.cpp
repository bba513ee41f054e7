#include "core/reconstruction/silhouette/silhouette.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include "core/reconstruction/silhouette/bit_filters.h"

namespace mocap {
namespace {

Silhouette RandomSilhouette(int width, int height, int one_in, unsigned seed) {
  std::mt19937 random(seed);
  Silhouette s(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      if (random() % static_cast<unsigned>(one_in) == 0) s.Set(x, y);
  return s;
}

bool IsSet(const Silhouette& s, int x, int y, bool beyond) {
  return x < 0 || y < 0 || x >= s.width() || y >= s.height() ? beyond : s.Test(x, y);
}

TEST(Silhouette, CountsTheShareThatItCovers) {
  Silhouette s(200, 50);
  EXPECT_EQ(s.CoveredShare(), 0);
  for (int x = 0; x < 200; ++x) s.Set(x, 49);
  EXPECT_DOUBLE_EQ(s.CoveredShare(), 0.02);
}

TEST(Silhouette, ABoundingBoxIsTightAcrossWords) {
  Silhouette s(200, 50);
  EXPECT_FALSE(s.BoundingBox().has_value());
  s.Set(63, 7);
  EXPECT_EQ(*s.BoundingBox(), (PixelBox{63, 7, 63, 7}));
  s.Set(64, 9);
  s.Set(199, 49);
  s.Set(5, 20);
  EXPECT_EQ(*s.BoundingBox(), (PixelBox{5, 7, 199, 49}));
}

TEST(Silhouette, ABoundingBoxIsThatOfItsPixels) {
  for (const auto& [width, height] : {std::pair{1, 1}, {64, 9}, {200, 50}, {700, 40}}) {
    for (const int one_in : {1, 30, 3000, 1 << 30}) {
      const Silhouette s = RandomSilhouette(width, height, one_in, 8);
      std::optional<PixelBox> box;
      for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
          if (!s.Test(x, y)) continue;
          if (!box) box = {x, y, x, y};
          *box = {std::min(box->left, x), box->top, std::max(box->right, x), y};
        }
      }
      EXPECT_EQ(s.BoundingBox(), box) << width << " " << one_in;
    }
  }
}

TEST(Silhouette, AKeptBoundingBoxFollowsWhatIsWritten) {
  Silhouette s(200, 50);
  s.KeepBox();
  EXPECT_FALSE(s.BoundingBox().has_value());
  s.Set(70, 8);
  EXPECT_EQ(s.BoundingBox(), (PixelBox{70, 8, 70, 8}));
  s.KeepBox();
  s.row(20)[2] = 1;
  EXPECT_EQ(s.BoundingBox(), (PixelBox{70, 8, 128, 20}));
  s.KeepBox();
  s.Reset(200, 50);
  EXPECT_FALSE(s.BoundingBox().has_value());
}

TEST(Silhouette, ErodingAndDilatingLookAtTheWholeSquare) {
  for (const int width : {64, 67, 130, 700}) {
    for (const int radius : {1, 2, 3}) {
      const Silhouette sparse = RandomSilhouette(width, 40, 60, 5);
      const Silhouette dense = [&] {
        Silhouette s(width, 40);
        for (int y = 0; y < 40; ++y)
          for (int x = 0; x < width; ++x)
            if (!sparse.Test(x, y)) s.Set(x, y);
        return s;
      }();
      Silhouette eroded, dilated;
      Erode(dense, radius, eroded);
      Dilate(sparse, radius, dilated);
      for (int y = 0; y < 40; ++y) {
        for (int x = 0; x < width; ++x) {
          bool all = true, any = false;
          for (int v = y - radius; v <= y + radius; ++v) {
            for (int u = x - radius; u <= x + radius; ++u) {
              all &= IsSet(dense, u, v, true);
              any |= IsSet(sparse, u, v, false);
            }
          }
          EXPECT_EQ(eroded.Test(x, y), all) << x << " " << y;
          EXPECT_EQ(dilated.Test(x, y), any) << x << " " << y;
        }
      }
      if (width % 64 != 0) {
        EXPECT_EQ(eroded.row(3)[width / 64] >> (width % 64), 0u);
      }
    }
  }
}

}  // namespace
}  // namespace mocap
