#include "core/reconstruction/silhouette/outline_refiner.h"

#include <algorithm>
#include <bit>
#include <cstdint>

#include "core/reconstruction/silhouette/bit_filters.h"

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

constexpr unsigned kAll = (1u << kSide) - 1;

// The channels of so many pixels in a row, and as many bytes as are added at once.
constexpr int kBytes = 3 * kSide;
constexpr int kLanes = 24;
static_assert(kLanes >= kBytes && kLanes % 4 == 0);

// For each set of a row's pixels, the bytes or values that count.
template <typename T, int lanes, int per_pixel>
constexpr auto MasksOf() {
  std::array<std::array<T, lanes>, kAll + 1> masks{};
  for (unsigned bits = 0; bits <= kAll; ++bits)
    for (int i = 0; i < per_pixel * kSide; ++i)
      if (bits >> (i / per_pixel) & 1) masks[bits][i] = static_cast<T>(~T{0});
  return masks;
}
constexpr auto kCounts = [] {
  std::array<std::uint8_t, kAll + 1> counts{};
  for (unsigned bits = 1; bits <= kAll; ++bits)
    counts[bits] = static_cast<std::uint8_t>(counts[bits >> 1] + (bits & 1));
  return counts;
}();
constexpr auto kByteMasks = MasksOf<std::uint8_t, kLanes, 3>();
constexpr auto kValueMasks = MasksOf<std::uint32_t, kSide + 1, 1>();

}  // namespace

// The person's colours and the background's brightness around a pixel.
struct OutlineRefiner::Around {
  // Channels in turn.
  std::array<std::uint16_t, kLanes> person{};
  std::array<float, kSide + 1> alphas{};
  int person_count = 0, background_count = 0;

  // Adds a row of kSide pixels; of those behind them nothing is counted.
  void Add(const Bgr* pixels, unsigned inside, const float* alpha_shift, unsigned outside) {
    const auto* const bytes = reinterpret_cast<const std::uint8_t*>(pixels);
    for (int i = 0; i < kLanes; ++i)
      person[i] = static_cast<std::uint16_t>(person[i] + (bytes[i] & kByteMasks[inside][i]));
    for (int i = 0; i <= kSide; ++i)
      alphas[i] += std::bit_cast<float>(std::bit_cast<std::uint32_t>(alpha_shift[i]) &
                                        kValueMasks[outside][i]);
    person_count += kCounts[inside];
    background_count += kCounts[outside];
  }

  void AddSome(const Picture& picture, int x, int y, unsigned inside, unsigned outside) {
    for (unsigned bits = inside; bits != 0; bits &= bits - 1, ++person_count) {
      const Bgr& p = picture.image(x - kRadius_px + std::countr_zero(bits), y);
      person[0] = static_cast<std::uint16_t>(person[0] + p.b);
      person[1] = static_cast<std::uint16_t>(person[1] + p.g);
      person[2] = static_cast<std::uint16_t>(person[2] + p.r);
    }
    for (unsigned bits = outside; bits != 0; bits &= bits - 1, ++background_count)
      alphas[0] += picture.alpha_shift(x - kRadius_px + std::countr_zero(bits), y);
  }

  std::array<int, 3> PersonSums() const {
    std::array<std::uint16_t, kLanes / 2> half;
    for (int i = 0; i < kLanes / 2; ++i)
      half[i] = static_cast<std::uint16_t>(person[i] + person[i + kLanes / 2]);
    std::array<int, 3> sums;
    for (int c = 0; c < 3; ++c) sums[c] = half[c] + half[c + 3] + half[c + 6] + half[c + 9];
    return sums;
  }
  float AlphaSum() const {
    return ((alphas[0] + alphas[4]) + (alphas[1] + alphas[5])) +
           ((alphas[2] + alphas[6]) + (alphas[3] + alphas[7]));
  }
};

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
  // Near the edge there are not as many pixels as are added at once.
  const bool is_near_edge = x < kRadius_px || x + kRadius_px + 1 >= inside_.width();
  Around around;
  // Every other row tells enough.
  for (int v = y - kRadius_px; v <= y + kRadius_px; v += 2) {
    if (v < 0 || v >= height) continue;
    const unsigned inside = BitsAround(inside_, x, v);
    const unsigned outside = ~BitsAround(near_, x, v) & valid;
    if (is_near_edge)
      around.AddSome(picture, x, v, inside, outside);
    else
      around.Add(&picture.image(x - kRadius_px, v), inside, &picture.alpha_shift(x - kRadius_px, v),
                 outside);
  }
  if (around.person_count == 0 || around.background_count == 0) return otherwise;
  const std::array<int, 3> person = around.PersonSums();
  const float alpha = 1 + around.AlphaSum() / static_cast<float>(around.background_count);
  const Bgr& p = picture.image(x, y);
  const std::array<int, 3> color = {p.b, p.g, p.r};
  float along = 0, contrast_sq = 0;
  for (int c = 0; c < 3; ++c) {
    const float background = picture.expected.MeanAt(x, y, c) * alpha;
    const float contrast =
        static_cast<float>(person[c]) * picture.gain[c] / static_cast<float>(around.person_count) -
        background;
    along += contrast * (static_cast<float>(color[c]) * picture.gain[c] - background);
    contrast_sq += contrast * contrast;
  }
  if (contrast_sq < kLeastContrast * kLeastContrast) return otherwise;
  return along > kHalfCovered * contrast_sq;
}

}  // namespace mocap
