#include "core/reconstruction/silhouette/silhouette_shift.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <utility>

#include "core/kernels/bits.h"
#include "core/reconstruction/silhouette/bit_filters.h"

namespace mocap {
namespace {

constexpr int kFarthest_px = 14;

std::int64_t CountOf(const Silhouette& bits) {
  return kernels::CountBits(bits.words().data(), bits.words().size());
}

// Counts the pixels that are set in `seen` and in `expected` moved by (dx, dy).
std::int64_t CommonPixels(const Silhouette& seen, const Silhouette& expected, int dx, int dy) {
  const int words = seen.words_per_row();
  const int whole = dx >= 0 ? dx / 64 : -((-dx + 63) / 64), part = dx - 64 * whole;
  std::int64_t count = 0;
  for (int y = std::max(0, dy); y < std::min(seen.height(), seen.height() + dy); ++y) {
    const std::uint64_t* a = seen.row(y);
    const std::uint64_t* b = expected.row(y - dy);
    const auto word = [&](int i) { return i >= 0 && i < words ? b[i] : std::uint64_t{0}; };
    for (int i = 0; i < words; ++i) {
      std::uint64_t moved = word(i - whole) << part;
      if (part > 0) moved |= word(i - whole - 1) >> (64 - part);
      count += std::popcount(a[i] & moved);
    }
  }
  return count;
}

// The pixels that no shift brings to the picture's edge.
Silhouette InnerPart(int width, int height) {
  Silhouette inner(width, height);
  for (int y = kFarthest_px; y < height - kFarthest_px; ++y) {
    for (int x = kFarthest_px; x < width - kFarthest_px; ++x) inner.Set(x, y);
  }
  return inner;
}

}  // namespace

bool TouchesBorder(const Silhouette& silhouette) {
  const auto box = silhouette.BoundingBox();
  return !box || box->left < 2 || box->top < 2 || box->right > silhouette.width() - 3 ||
         box->bottom > silhouette.height() - 3;
}

SilhouetteShift MeasureShift(const Silhouette& silhouette, const Silhouette& expected) {
  const bool is_cut = TouchesBorder(silhouette) || TouchesBorder(expected);
  const Silhouette inner =
      is_cut ? InnerPart(silhouette.width(), silhouette.height()) : Silhouette();
  Silhouette seen = silhouette;
  if (is_cut) Intersect(inner, seen);
  const std::int64_t seen_count = CountOf(seen), expected_count = CountOf(expected);
  const auto overlap = [&](int dx, int dy) {
    const std::int64_t common = CommonPixels(seen, expected, dx, dy);
    const std::int64_t compared = is_cut ? CommonPixels(inner, expected, dx, dy) : expected_count;
    return static_cast<double>(common) /
           static_cast<double>(std::max<std::int64_t>(1, seen_count + compared - common));
  };
  int best_x = 0, best_y = 0;
  double best = overlap(0, 0);
  for (int step = 8; step >= 1; step /= 2) {
    for (bool better = true; better;) {
      better = false;
      for (const auto& [x, y] : {std::pair(step, 0), {-step, 0}, {0, step}, {0, -step}}) {
        if (std::abs(best_x + x) > kFarthest_px || std::abs(best_y + y) > kFarthest_px) continue;
        const double value = overlap(best_x + x, best_y + y);
        if (value <= best) continue;
        best = value;
        best_x += x;
        best_y += y;
        better = true;
      }
    }
  }
  // Three pixels in both directions: one is too sensitive to the outline's steps.
  const auto fraction = [&](int ux, int uy) {
    constexpr int kPeakReach = 3;
    const double low = overlap(best_x - kPeakReach * ux, best_y - kPeakReach * uy);
    const double high = overlap(best_x + kPeakReach * ux, best_y + kPeakReach * uy);
    const double left = best - low, right = best - high;
    // The overlap falls linearly on both sides: the lines meet at the maximum.
    return left + right > 0 ? kPeakReach * (left - right) / (2 * std::max(left, right)) : 0.0;
  };
  const PixelBox box = seen.BoundingBox().value_or(PixelBox{});
  return {{best_x + fraction(1, 0), best_y + fraction(0, 1)},
          best,
          Vector2(box.left + box.right, box.top + box.bottom) / 2};
}

}  // namespace mocap
