#include "core/reconstruction/silhouette/closeup.h"

#include <algorithm>

#include "core/reconstruction/silhouette/bit_filters.h"

namespace mocap {
namespace {

constexpr int kTile_px = HalfPicture::kTile_px;

}  // namespace

void Closeup::Set(const Silhouette& suspicious, int width, int height) {
  width_ = width;
  height_ = height;
  Dilate(suspicious, 1, tiles_);
  const auto is_judged = [this](int column, int row) {
    return row >= 0 && row < tiles_.height() && tiles_.Test(column, row);
  };
  judged_.Clear(kTile_px);
  for (int row = 0; row < tiles_.height(); ++row)
    judged_.AddRow(tiles_.width(), width, 0, [&](int column) { return is_judged(column, row); });
  // Half of a tile is near to one of those above and below.
  measured_.Clear(kMargin_px);
  for (int half = 0; half < 2 * tiles_.height(); ++half) {
    const int row = half / 2, near = row + (half % 2 == 0 ? -1 : 1);
    measured_.AddRow(tiles_.width(), width, kMargin_px,
                     [&](int column) { return is_judged(column, row) || is_judged(column, near); });
  }
}

void Closeup::SetAll(int width, int height) {
  Silhouette all((width + kTile_px - 1) / kTile_px, (height + kTile_px - 1) / kTile_px);
  for (int y = 0; y < all.height(); ++y)
    for (int x = 0; x < all.width(); ++x) all.Set(x, y);
  Set(all, width, height);
}

void Closeup::Runs::Clear(int row_px) {
  row_px_ = row_px;
  runs_.clear();
  begins_.assign(1, 0);
}

template <typename Test>
void Closeup::Runs::AddRow(int columns, int width, int margin_px, Test test) {
  const int first = begins_.back();
  for (int column = 0; column < columns; ++column) {
    if (!test(column)) continue;
    const int begin = std::max(column * kTile_px - margin_px, 0);
    const int end = std::min((column + 1) * kTile_px + margin_px, width);
    if (static_cast<int>(runs_.size()) > first && runs_.back().end >= begin)
      runs_.back().end = end;
    else
      runs_.push_back({begin, end});
  }
  begins_.push_back(static_cast<int>(runs_.size()));
}

}  // namespace mocap
