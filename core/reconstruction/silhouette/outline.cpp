#include "core/reconstruction/silhouette/outline.h"

#include <bit>
#include <cstdint>
#include <optional>

namespace mocap {
namespace {

// Half the width of the window that the border's direction is read from.
constexpr int kWindow_px = 3;

// The silhouette's pixels in a word of a row that have a neighbour outside it.
std::uint64_t BorderWord(const Silhouette& silhouette, int y, int word) {
  const std::uint64_t* row = silhouette.row(y);
  const std::uint64_t before = word > 0 ? row[word - 1] >> 63 : 0;
  const std::uint64_t after = word + 1 < silhouette.words_per_row() ? row[word + 1] << 63 : 0;
  const std::uint64_t inner = (row[word] << 1 | before) & (row[word] >> 1 | after) &
                              silhouette.row(y - 1)[word] & silhouette.row(y + 1)[word];
  return row[word] & ~inner;
}

// Visits the border's pixels row by row, but those near the picture's edge.
template <typename Visit>
void ForEachBorderPixel(const Silhouette& silhouette, const PixelBox& box, const Visit& visit) {
  const int top = std::max(box.top, kWindow_px + 1);
  const int bottom = std::min(box.bottom, silhouette.height() - kWindow_px - 2);
  for (int y = top; y <= bottom; ++y) {
    for (int word = box.left / 64; word <= box.right / 64; ++word) {
      for (std::uint64_t bits = BorderWord(silhouette, y, word); bits != 0; bits &= bits - 1) {
        const int x = word * 64 + std::countr_zero(bits);
        if (x > kWindow_px && x < silhouette.width() - kWindow_px - 1) visit(x, y);
      }
    }
  }
}

// Out of the silhouette, square to its border; empty where the border has no direction.
std::optional<Vector2> OutwardAt(const Silhouette& silhouette, int x, int y) {
  Vector2 inward = Vector2::Zero();
  for (int dy = -kWindow_px; dy <= kWindow_px; ++dy) {
    for (int dx = -kWindow_px; dx <= kWindow_px; ++dx) {
      if (silhouette.Test(x + dx, y + dy)) inward += Vector2(dx, dy);
    }
  }
  const double length = inward.norm();
  if (length < 1) return std::nullopt;
  return Vector2(-inward / length);
}

std::optional<Vector3> DirectionOf(const Lens& lens, const Vector2& pixel) {
  const std::optional<Vector2> normalized = NormalizedFromPixel(lens, pixel);
  if (!normalized) return std::nullopt;
  return Vector3(normalized->x(), normalized->y(), 1).normalized();
}

}  // namespace

void TraceOutline(const CameraCalibration& camera, const RigidTransform& X_CW,
                  const Silhouette& silhouette, int most, Outline& outline) {
  outline.clear();
  const std::optional<PixelBox> box = silhouette.BoundingBox();
  if (!box) return;
  int length_px = 0;
  ForEachBorderPixel(silhouette, *box, [&](int, int) { ++length_px; });
  const RigidTransform X_WC = X_CW.Inverse();
  int index = 0;
  int taken = 0;
  ForEachBorderPixel(silhouette, *box, [&](int x, int y) {
    if (static_cast<std::int64_t>(index++) * most < static_cast<std::int64_t>(taken) * length_px)
      return;
    ++taken;
    const std::optional<Vector2> outward = OutwardAt(silhouette, x, y);
    if (!outward) return;
    // The border runs between the last pixel inside and the first one outside.
    const Vector2 place = Vector2(x, y) + 0.5 * *outward;
    const Vector2 along(-outward->y(), outward->x());
    const auto ray_C = DirectionOf(camera.lens, place);
    const auto beside_C = DirectionOf(camera.lens, place + along);
    if (!ray_C || !beside_C) return;
    const Vector3 outward_C = beside_C->cross(*ray_C).normalized();
    outline.push_back({X_WC.p, X_WC.R * *ray_C, X_WC.R * outward_C});
  });
}

}  // namespace mocap
