#include "core/reconstruction/silhouette/shading.h"

#include <algorithm>
#include <bit>

namespace mocap {
namespace {

constexpr int kTile_px = Shading::kTile_px;
// A few rows are enough for the shade of a tile.
constexpr int kFirstRow = 1, kRowStep = 4;

// Sums the shades of a tile's dark pixels.
struct Sum {
  float shade = 0;
  int count = 0;

  void Add(unsigned dark, const float* shades) {
    count += std::popcount(dark);
    for (; dark != 0; dark &= dark - 1) shade += shades[std::countr_zero(dark)];
  }
};

}  // namespace

void ListDarkTiles(const PixelBox& frame, ImageView<const float> shade, Shading& shading) {
  shading.dark_tiles.clear();
  const Silhouette& dark = shading.dark;
  for (int row = frame.top / kTile_px; row <= frame.bottom / kTile_px; ++row) {
    const int end = std::min({(row + 1) * kTile_px, frame.bottom + 1, dark.height()});
    for (int column = frame.left / kTile_px; column <= frame.right / kTile_px; ++column) {
      Sum sum;
      for (int y = std::max(row * kTile_px, frame.top) + kFirstRow; y < end; y += kRowStep)
        sum.Add(dark.row(y)[column / 8] >> column % 8 * 8 & 0xff, shade.row(y) + column * kTile_px);
      if (sum.count == 0) continue;
      shading.dark_tiles.push_back({static_cast<std::int16_t>(column),
                                    static_cast<std::int16_t>(row),
                                    Shading::ShadeOf(sum.shade / static_cast<float>(sum.count))});
    }
  }
}

}  // namespace mocap
