#include "core/reconstruction/silhouette/outline.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <optional>

namespace mocap {
namespace {

// Half the width of the window that gives the border's direction.
constexpr int kWindow_px = 3;

// The four neighbours of the pixels in a word of a row.
struct Neighbours {
  Neighbours(const Silhouette& pixels, int y, int word) {
    const std::uint64_t* const row = pixels.row(y);
    const std::uint64_t before = word > 0 ? row[word - 1] >> 63 : 0;
    const std::uint64_t after = word + 1 < pixels.words_per_row() ? row[word + 1] << 63 : 0;
    left = row[word] << 1 | before;
    right = row[word] >> 1 | after;
    above = pixels.row(y - 1)[word];
    below = pixels.row(y + 1)[word];
  }
  std::uint64_t All() const { return left & right & above & below; }
  std::uint64_t Any() const { return left | right | above | below; }

  std::uint64_t left, right, above, below;
};

// The person's pixels in a word of a row that have an empty neighbour, and no unknown one.
std::uint64_t BorderWord(const Trimap& trimap, int y, int word) {
  const std::uint64_t border =
      trimap.person.row(y)[word] & ~Neighbours(trimap.person, y, word).All();
  if (border == 0 || trimap.unknown.width() == 0) return border;
  return border & ~Neighbours(trimap.unknown, y, word).Any();
}

// Visits the border's pixels row by row, without those near the picture's edge.
template <typename Visit>
void ForEachBorderPixel(const Trimap& trimap, const PixelBox& box, const Visit& visit) {
  constexpr int kMargin_px = kWindow_px + 1;
  const int left = std::max(box.left, kMargin_px);
  const int right = std::min(box.right, trimap.person.width() - 1 - kMargin_px);
  const int top = std::max(box.top, kMargin_px);
  const int bottom = std::min(box.bottom, trimap.person.height() - 1 - kMargin_px);
  if (left > right) return;
  const std::uint64_t all = ~std::uint64_t{0};
  for (int y = top; y <= bottom; ++y) {
    for (int word = left / 64; word <= right / 64; ++word) {
      std::uint64_t bits = BorderWord(trimap, y, word);
      if (word == left / 64) bits &= all << left % 64;
      if (word == right / 64) bits &= all >> (63 - right % 64);
      for (; bits != 0; bits &= bits - 1) visit(word * 64 + std::countr_zero(bits), y);
    }
  }
}

// The pixels of a row within the window around x, one bit each.
unsigned WindowBits(const Silhouette& silhouette, int x, int y) {
  const std::uint64_t* const row = silhouette.row(y);
  const int begin = x - kWindow_px, end = x + kWindow_px;
  std::uint64_t bits = row[begin / 64] >> begin % 64;
  if (end / 64 != begin / 64) bits |= row[end / 64] << (64 - begin % 64);
  return static_cast<unsigned>(bits) & ((2u << 2 * kWindow_px) - 1);
}

// Moments of the set pixels in a row of a window: their number, and the sum of their positions
// relative to the middle.
struct RowMoments {
  int count = 0, sum = 0;
};
constexpr auto kRowMoments = [] {
  std::array<RowMoments, 2 << 2 * kWindow_px> moments{};
  for (std::size_t bits = 0; bits < moments.size(); ++bits) {
    for (int i = 0; i <= 2 * kWindow_px; ++i) {
      if (~bits >> i & 1) continue;
      ++moments[bits].count;
      moments[bits].sum += i - kWindow_px;
    }
  }
  return moments;
}();

// Outward normal of the silhouette's border; empty where the border has no direction.
std::optional<Vector2> OutwardAt(const Silhouette& silhouette, int x, int y) {
  int inward_x = 0, inward_y = 0;
  for (int dy = -kWindow_px; dy <= kWindow_px; ++dy) {
    const RowMoments& row = kRowMoments[WindowBits(silhouette, x, y + dy)];
    inward_x += row.sum;
    inward_y += dy * row.count;
  }
  const Vector2 inward(inward_x, inward_y);
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

void TraceOutline(const CameraCalibration& camera, const RigidTransform& X_CW, const Trimap& trimap,
                  int most, Outline& outline) {
  outline.clear();
  const std::optional<PixelBox> box = trimap.person.BoundingBox();
  if (!box) return;
  SpreadChoice choice;
  ForEachBorderPixel(trimap, *box, [&](int x, int y) { choice.Add(RankOfPixel(x, y)); });
  const std::uint64_t limit = choice.LimitFor(static_cast<std::size_t>(most));
  const RigidTransform X_WC = X_CW.Inverse();
  const GrazingRay empty{X_WC.p, Vector3::UnitZ(), Vector3::Zero(), 0};
  const auto trace = [&](int x, int y) {
    const std::optional<Vector2> outward = OutwardAt(trimap.person, x, y);
    if (!outward) return empty;
    // The border runs between the last pixel inside and the first one outside.
    const Vector2 place = Vector2(x, y) + 0.5 * *outward;
    const Vector2 along(-outward->y(), outward->x());
    const auto ray_C = DirectionOf(camera.lens, place);
    const auto beside_C = DirectionOf(camera.lens, place + along);
    if (!ray_C || !beside_C) return empty;
    const Vector3 outward_C = beside_C->cross(*ray_C).normalized();
    return GrazingRay{X_WC.p, X_WC.R * *ray_C, X_WC.R * outward_C, 0};
  };
  ForEachBorderPixel(trimap, *box, [&](int x, int y) {
    const SpreadRank rank = RankOfPixel(x, y);
    if (rank >= limit) return;
    outline.push_back(trace(x, y));
    outline.back().rank = rank;
  });
}

void ThinOutline(const Outline& dense, int step, Outline& thin) {
  thin.clear();
  SpreadChoice choice;
  for (const GrazingRay& ray : dense) choice.Add(ray.rank);
  const auto parts = static_cast<std::size_t>(step);
  const std::uint64_t limit = choice.LimitFor((dense.size() + parts - 1) / parts);
  for (const GrazingRay& ray : dense)
    if (ray.rank < limit && !ray.empty()) thin.push_back(ray);
}

}  // namespace mocap
