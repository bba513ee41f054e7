#include "core/reconstruction/silhouette/unseen_places.h"

#include <cmath>

#include "core/reconstruction/silhouette/bit_filters.h"

namespace mocap {

UnseenPlaces::UnseenPlaces(std::span<const BackgroundFrame> background) {
  for (const BackgroundFrame& frame : background) {
    if (frame.unseen.width() == 0) continue;
    if (unseen_.width() == 0) unseen_.Reset(frame.unseen.width(), frame.unseen.height());
    Unite(frame.unseen, unseen_);
  }
  unseen_.KeepBox();
}

const Silhouette& UnseenPlaces::At(const Displacement& displacement) {
  if (displacement == Displacement{}) return unseen_;
  Shift(unseen_, static_cast<int>(std::lround(displacement.x_px)),
        static_cast<int>(std::lround(displacement.y_px)), displaced_);
  return displaced_;
}

void UnseenPlaces::LeaveOut(const Silhouette& unseen, Shading& shading) {
  Subtract(unseen, shading.dark);
  const PixelBox box = unseen.BoundingBox().value_or(PixelBox{0, 0, -1, -1});
  constexpr int kTile_px = Shading::kTile_px;
  for (int y = box.top; y <= box.bottom; ++y) {
    const std::uint64_t* const row = unseen.row(y);
    Shading::Shade* const shades =
        &shading.shades[static_cast<std::size_t>(y / kTile_px) * shading.tile_columns];
    for (int column = box.left / kTile_px; column * kTile_px <= box.right; ++column)
      if (row[column / 8] >> column % 8 * 8 & 0xff) shades[column] = Shading::kUnknown;
  }
}

}  // namespace mocap
