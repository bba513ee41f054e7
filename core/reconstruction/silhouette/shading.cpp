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

void ListDarkTiles(ImageView<const float> shade, Shading& shading) {
  const Silhouette& dark = shading.dark;
  shading.dark_tiles.clear();
  const PixelBox box = dark.BoundingBox().value_or(PixelBox{0, 0, -1, -1});
  for (int row = box.top / kTile_px; row * kTile_px <= box.bottom; ++row) {
    const int end = std::min((row + 1) * kTile_px, dark.height());
    for (int column = box.left / kTile_px; column * kTile_px <= box.right; ++column) {
      Sum sum;
      for (int y = row * kTile_px + kFirstRow; y < end; y += kRowStep)
        sum.Add(dark.row(y)[column / 8] >> column % 8 * 8 & 0xff, shade.row(y) + column * kTile_px);
      if (sum.count == 0) continue;
      shading.dark_tiles.push_back({static_cast<std::int16_t>(column),
                                    static_cast<std::int16_t>(row),
                                    Shading::ShadeOf(sum.shade / static_cast<float>(sum.count))});
    }
  }
}

}  // namespace mocap
