#include "core/reconstruction/outline_refiner.h"

#include <algorithm>
#include <bit>
#include <cstdint>

#include "core/reconstruction/bit_filters.h"

namespace mocap {
namespace {

using Word = std::uint64_t;

constexpr int kRadius_px = 3;
constexpr int kSide = 2 * kRadius_px + 1;
// Colours that are closer than this [grey levels] tell nothing.
constexpr float kLeastContrast = 4;
// Pictures are gamma-coded: a pixel half covered by a darker person looks brighter than the middle
// of the two colours.
constexpr float kHalfCovered = 0.4f;

// The pixels of a row from `x` − kRadius_px to `x` + kRadius_px, in the lowest bits.
unsigned BitsAround(const Silhouette& s, int x, int y) {
  const Word* const row = s.row(y);
  const int begin = x - kRadius_px;
  constexpr Word kMask = (Word{1} << kSide) - 1;
  if (begin < 0) return static_cast<unsigned>(row[0] << -begin & kMask);
  const int shift = begin & 63;
  Word bits = row[begin >> 6] >> shift;
  if (shift > 64 - kSide && (begin >> 6) + 1 < s.words_per_row())
    bits |= row[(begin >> 6) + 1] << (64 - shift);
  return static_cast<unsigned>(bits & kMask);
}

// Those of these pixels that lie within the picture.
unsigned ValidAround(int x, int width) {
  unsigned valid = (1u << kSide) - 1;
  if (x < kRadius_px) valid &= valid << (kRadius_px - x);
  if (x + kRadius_px >= width) valid &= valid >> (x + kRadius_px + 1 - width);
  return valid & ((1u << kSide) - 1);
}

}  // namespace

void OutlineRefiner::Refine(const ExpectedPicture& expected, ImageView<const Bgr> image,
                            const std::array<float, 3>& gain, const Image<float>& alpha_shift,
                            Silhouette& silhouette) {
  const Picture picture{expected, image, gain, alpha_shift};
  Erode(silhouette, 1, inside_);
  Dilate(silhouette, 1, near_);
  for (int y = 0; y < silhouette.height(); ++y) {
    for (int i = 0; i < silhouette.words_per_row(); ++i) {
      Word& word = silhouette.row(y)[i];
      for (Word band = near_.row(y)[i] & ~inside_.row(y)[i]; band != 0; band &= band - 1) {
        const int bit = std::countr_zero(band);
        const Word mask = Word{1} << bit;
        word = IsCovered(picture, i * 64 + bit, y, (word & mask) != 0) ? word | mask : word & ~mask;
      }
    }
  }
}

// Returns whether the person covers the pixel by half; `otherwise` where that cannot be told.
bool OutlineRefiner::IsCovered(const Picture& picture, int x, int y, bool otherwise) const {
  const int height = inside_.height();
  const unsigned valid = ValidAround(x, inside_.width());
  std::array<int, 3> person{};
  float background_alpha = 0;
  int person_count = 0, background_count = 0;
  // Every other row tells enough.
  for (int v = y - kRadius_px; v <= y + kRadius_px; v += 2) {
    if (v < 0 || v >= height) continue;
    const unsigned inside = BitsAround(inside_, x, v);
    const unsigned outside = ~BitsAround(near_, x, v) & valid;
    for (unsigned bits = inside; bits != 0; bits &= bits - 1, ++person_count) {
      const Bgr& p = picture.image(x - kRadius_px + std::countr_zero(bits), v);
      person[0] += p.b, person[1] += p.g, person[2] += p.r;
    }
    for (unsigned bits = outside; bits != 0; bits &= bits - 1, ++background_count)
      background_alpha += picture.alpha_shift(x - kRadius_px + std::countr_zero(bits), v);
  }
  if (person_count == 0 || background_count == 0) return otherwise;
  const std::size_t i = static_cast<std::size_t>(y) * inside_.width() + x;
  const Bgr& p = picture.image(x, y);
  const std::array<int, 3> color = {p.b, p.g, p.r};
  float along = 0, contrast_sq = 0;
  for (int c = 0; c < 3; ++c) {
    const float background =
        picture.expected.mean[c][i] * (1 + background_alpha / static_cast<float>(background_count));
    const float contrast =
        static_cast<float>(person[c]) * picture.gain[c] / static_cast<float>(person_count) -
        background;
    along += contrast * (static_cast<float>(color[c]) * picture.gain[c] - background);
    contrast_sq += contrast * contrast;
  }
  if (contrast_sq < kLeastContrast * kLeastContrast) return otherwise;
  return along > kHalfCovered * contrast_sq;
}

}  // namespace mocap
