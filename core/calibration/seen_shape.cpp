#include "core/calibration/seen_shape.h"

#include <bit>

namespace mocap {
namespace {

/// First and last set pixel of a row; empty if there is none.
std::optional<std::pair<int, int>> EndsOfRow(const Silhouette& silhouette, int y) {
  const std::uint64_t* row = silhouette.row(y);
  const int words = silhouette.words_per_row();
  int first = 0;
  while (first < words && row[first] == 0) ++first;
  if (first == words) return {};
  int last = words - 1;
  while (row[last] == 0) --last;
  return std::pair(64 * first + std::countr_zero(row[first]),
                   64 * last + 63 - std::countl_zero(row[last]));
}

/// Adds a corner of one side of the hull and drops those that no longer are corners.
/// @param turn  1 or -1: on which side the hull lies.
void AddToSide(const Vector2& corner, double turn, std::vector<Vector2>& side) {
  const auto bulges = [&] {
    const Vector2 before = side[side.size() - 1] - side[side.size() - 2];
    const Vector2 now = corner - side[side.size() - 2];
    return turn * (before.x() * now.y() - before.y() * now.x()) > 0;
  };
  while (side.size() >= 2 && !bulges()) side.pop_back();
  side.push_back(corner);
}

}  // namespace

SeenShape ShapeOf(const Silhouette& silhouette, const RigidTransform& X_CW) {
  SeenShape shape;
  shape.X_CW = X_CW;
  const std::optional<PixelBox> box = silhouette.BoundingBox();
  if (!box) return shape;
  // Rows come from top to bottom, so that each side is a chain of its own (Andrew, 1979).
  std::vector<Vector2> left, right;
  for (int y = box->top; y <= box->bottom; ++y) {
    const auto ends = EndsOfRow(silhouette, y);
    if (!ends) continue;
    AddToSide({ends->first, y}, -1, left);
    AddToSide({ends->second, y}, 1, right);
  }
  shape.rim_px = std::move(left);
  shape.rim_px.insert(shape.rim_px.end(), right.rbegin(), right.rend());
  shape.is_cut = box->left == 0 || box->top == 0 || box->right == silhouette.width() - 1 ||
                 box->bottom == silhouette.height() - 1;
  shape.height_share = (box->bottom - box->top + 1.0) / silhouette.height();
  return shape;
}

}  // namespace mocap
