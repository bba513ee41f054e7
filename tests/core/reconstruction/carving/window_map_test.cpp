#include "core/reconstruction/carving/window_map.h"

#include <gtest/gtest.h>

#include <random>

#include "core/reconstruction/carving/carving_view.h"
#include "core/reconstruction/silhouette/bit_filters.h"

namespace mocap {
namespace {

// A block with holes and notches of all sizes.
Silhouette Block(int width, int height, const PixelBox& block, unsigned seed) {
  std::mt19937 random(seed);
  Silhouette s(width, height);
  for (int y = block.top; y <= block.bottom; ++y)
    for (int x = block.left; x <= block.right; ++x) s.Set(x, y);
  for (int i = 0; i < 12; ++i) {
    const int side = static_cast<int>(random() % 14);
    const int left = static_cast<int>(random() % static_cast<unsigned>(width));
    const int top = static_cast<int>(random() % static_cast<unsigned>(height));
    for (int y = top; y < std::min(top + side, height); ++y)
      for (int x = left; x < std::min(left + side, width); ++x)
        s.row(y)[x >> 6] &= ~(std::uint64_t{1} << (x & 63));
  }
  return s;
}

// All around a silhouette, by less than the width of a word.
Silhouette UnknownBeside(const Silhouette& silhouette) {
  Silhouette wide;
  Dilate(silhouette, 3, wide);
  Subtract(silhouette, wide);
  wide.KeepBox();
  return wide;
}

PixelBox BoxOf(const Silhouette& silhouette, const Silhouette* unknown) {
  return *CarvingView{nullptr, &silhouette, {}, unknown}.Box();
}

struct Case {
  int width, height;
  PixelBox block;
};
// In the middle, and at each edge and corner of a picture.
const Case kCases[] = {{150, 110, {20, 15, 120, 90}},  {128, 100, {0, 0, 80, 60}},
                       {150, 110, {60, 50, 149, 109}}, {131, 90, {3, 4, 127, 86}},
                       {64, 60, {0, 0, 63, 59}},       {150, 110, {70, 2, 76, 9}},
                       {100, 80, {31, 40, 94, 41}},    {97, 80, {90, 70, 96, 79}}};

TEST(WindowMap, KnowsTheKindOfEveryPixel) {
  WindowMap map;
  for (const Case& c : kCases) {
    const Silhouette s = Block(c.width, c.height, c.block, 5);
    const Silhouette unknown = UnknownBeside(s);
    for (const Silhouette* const beside : {&unknown, static_cast<const Silhouette*>(nullptr)}) {
      map.Measure(s, beside, BoxOf(s, beside));
      for (int y = 0; y < c.height; ++y) {
        for (int x = 0; x < c.width; ++x) {
          const bool is_unknown = beside && beside->Test(x, y);
          const WindowMap::Kind wanted = s.Test(x, y) ? WindowMap::Kind::kInside
                                         : is_unknown ? WindowMap::Kind::kUnknown
                                                      : WindowMap::Kind::kOutside;
          ASSERT_EQ(map.At(x, y), wanted) << x << " " << y << " of " << c.width;
        }
      }
    }
  }
}

TEST(WindowMap, KnowsOfWindowsWhetherAllOfThemIsInsideOrOutside) {
  WindowMap map;
  for (const Case& c : kCases) {
    const Silhouette s = Block(c.width, c.height, c.block, 8);
    const Silhouette unknown = UnknownBeside(s);
    map.Measure(s, &unknown, BoxOf(s, &unknown));
    const WindowMap::Planes planes = map.planes();
    for (int plane = 0; plane < WindowMap::kPlanes; ++plane) {
      const int side = 1 << plane;
      for (int y = planes.top; y <= planes.bottom; ++y) {
        for (int x = planes.left; x <= planes.right; ++x) {
          bool is_inside = true, is_outside = true;
          for (int v = y; v < y + side; ++v) {
            for (int u = x; u < x + side; ++u) {
              const bool is_beside = u >= c.width || v >= c.height;
              is_inside = is_inside && !is_beside && s.Test(u, v);
              is_outside = is_outside && (is_beside || !(s.Test(u, v) || unknown.Test(u, v)));
            }
          }
          const int column = x - planes.left;
          const std::uint32_t word =
              planes.words[plane * planes.words_per_plane + column / 16 * planes.words_per_column +
                           (y - planes.top)] >>
              column % 16;
          ASSERT_EQ((word & 1) != 0, is_inside) << side << " at " << x << " " << y;
          ASSERT_EQ((word >> 16 & 1) != 0, is_outside) << side << " at " << x << " " << y;
        }
      }
    }
  }
}

}  // namespace
}  // namespace mocap
