#include "core/reconstruction/silhouette/outline_refiner.h"

#include <algorithm>
#include <bit>
#include <cstdint>

#include "core/lanes.h"
#include "core/reconstruction/silhouette/bit_filters.h"

namespace mocap {
namespace {

using Word = std::uint64_t;

// Pixels of a block lie so close together that they share what is around them.
constexpr int kBlock_px = 2;
// Where the first begins: blocks that reach over the edge of a tile reach as far on either side.
constexpr int kFirst = -1;
constexpr int kReach_px = 3;
constexpr int kSide = kBlock_px + 2 * kReach_px;
// Of the rows around a block half tell enough, the outermost among them: counted from its first.
constexpr std::array<int, 4> kRows = {-3, -1, 2, 4};
// Colours that are closer than this [grey levels] tell nothing.
constexpr float kLeastContrast = 4;
// Pictures are gamma-coded: a pixel half covered by a darker person looks brighter than the middle
// of the two colours.
constexpr float kHalfCovered = 0.4f;

constexpr unsigned kAll = (1u << kSide) - 1;

// The kSide pixels of a row from `begin` on, in the lowest bits.
MOCAP_INLINE unsigned BitsFrom(const Silhouette& s, int begin, int y) {
  const Word* const row = s.row(y);
  if (begin < 0) return static_cast<unsigned>(row[0] << -begin) & kAll;
  const int shift = begin & 63;
  Word bits = row[begin >> 6] >> shift;
  if (shift > 64 - kSide && (begin >> 6) + 1 < s.words_per_row())
    bits |= row[(begin >> 6) + 1] << (64 - shift);
  return static_cast<unsigned>(bits) & kAll;
}

// Those of these pixels that lie within the picture.
MOCAP_INLINE unsigned ValidFrom(int begin, int width) {
  unsigned valid = kAll;
  if (begin < 0) valid &= kAll << -begin;
  if (begin + kSide > width) valid &= kAll >> (begin + kSide - width);
  return valid;
}

// For each set of a row's pixels, the bytes or values that count.
template <typename T, int per_pixel>
constexpr auto MasksOf() {
  std::array<std::array<T, per_pixel * kSide>, kAll + 1> masks{};
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
constexpr auto kByteMasks = MasksOf<std::uint8_t, 3>();
constexpr auto kValueMasks = MasksOf<std::uint32_t, 1>();

// Within the frame of a silhouette.
struct Picture {
  const ExpectedPicture& expected;
  int left, top;  // Of the frame in what is expected.
  ImageView<const Bgr> image;
  std::array<float, 3> gain;
  ImageView<const float> alpha_shift;
};

// The silhouette without its outermost pixels, and with those beside it.
struct Bounds {
  const Silhouette &inside, &near;
  // The pixels of a word that the outline may cross.
  MOCAP_INLINE Word Band(int word, int y) const {
    return y < 0 || y >= near.height() ? 0 : near.row(y)[word] & ~inside.row(y)[word];
  }
};

// The person's colours and the background's brightness around a block.
struct Around {
  // Channels in turn.
  std::array<std::uint16_t, 3 * kSide> person{};
  std::array<float, kSide> alphas{};
  int person_count = 0, background_count = 0;

  // Adds a row of kSide pixels.
  MOCAP_INLINE void Add(const Bgr* pixels, unsigned inside, const float* alpha_shift,
                        unsigned outside) {
    const auto* const bytes = reinterpret_cast<const std::uint8_t*>(pixels);
    for (int i = 0; i < 3 * kSide; ++i)
      person[i] = static_cast<std::uint16_t>(person[i] + (bytes[i] & kByteMasks[inside][i]));
    for (int i = 0; i < kSide; ++i)
      alphas[i] += std::bit_cast<float>(std::bit_cast<std::uint32_t>(alpha_shift[i]) &
                                        kValueMasks[outside][i]);
    person_count += kCounts[inside];
    background_count += kCounts[outside];
  }

  // Adds those of a row's pixels that are within the picture.
  MOCAP_INLINE void AddSome(const Picture& picture, int begin, int y, unsigned inside,
                            unsigned outside) {
    for (unsigned bits = inside; bits != 0; bits &= bits - 1, ++person_count) {
      const Bgr& p = picture.image(begin + std::countr_zero(bits), y);
      person[0] = static_cast<std::uint16_t>(person[0] + p.b);
      person[1] = static_cast<std::uint16_t>(person[1] + p.g);
      person[2] = static_cast<std::uint16_t>(person[2] + p.r);
    }
    for (unsigned bits = outside; bits != 0; bits &= bits - 1, ++background_count)
      alphas[0] += picture.alpha_shift(begin + std::countr_zero(bits), y);
  }

  MOCAP_INLINE std::array<float, 3> PersonColor() const {
    const float per_pixel = 1 / static_cast<float>(person_count);
    std::array<float, 3> color;
    for (int c = 0; c < 3; ++c) {
      int sum = 0;
#pragma GCC unroll 8
      for (int i = 0; i < kSide; ++i) sum += person[3 * i + c];
      color[c] = per_pixel * static_cast<float>(sum);
    }
    return color;
  }
  MOCAP_INLINE float Alpha() const {
    const float sum = ((alphas[0] + alphas[4]) + (alphas[1] + alphas[5])) +
                      ((alphas[2] + alphas[6]) + (alphas[3] + alphas[7]));
    return 1 + sum / static_cast<float>(background_count);
  }
};

// Looks around the block that begins at a pixel.
MOCAP_INLINE void LookAround(const Picture& picture, const Bounds& bounds, int x, int y,
                             Around& around) {
  const int begin = x - kReach_px;
  const unsigned valid = ValidFrom(begin, bounds.inside.width());
  for (const int row : kRows) {
    const int v = y + row;
    if (v < 0 || v >= bounds.inside.height()) continue;
    const unsigned inside = BitsFrom(bounds.inside, begin, v);
    const unsigned outside = ~BitsFrom(bounds.near, begin, v) & valid;
    if (valid == kAll)
      around.Add(&picture.image(begin, v), inside, &picture.alpha_shift(begin, v), outside);
    else
      around.AddSome(picture, begin, v, inside, outside);
  }
}

// Keeps a pixel if the person covers it by half; leaves it where the colours are alike.
MOCAP_INLINE void RefinePixel(const Picture& picture, int x, int y,
                              const std::array<float, 3>& person, float alpha, Word mask,
                              Word& word) {
  const Bgr& p = picture.image(x, y);
  const std::array<int, 3> color = {p.b, p.g, p.r};
  float along = 0, contrast_sq = 0;
  for (int c = 0; c < 3; ++c) {
    const float background = picture.expected.MeanAt(picture.left + x, picture.top + y, c) * alpha;
    const float contrast = person[c] * picture.gain[c] - background;
    along += contrast * (static_cast<float>(color[c]) * picture.gain[c] - background);
    contrast_sq += contrast * contrast;
  }
  if (contrast_sq < kLeastContrast * kLeastContrast) return;
  word = along > kHalfCovered * contrast_sq ? word | mask : word & ~mask;
}

// Keeps those pixels of a block that the person covers by half, if that can be told.
MOCAP_INLINE void RefineBlock(const Picture& picture, const Bounds& bounds, int x, int y,
                              Silhouette& silhouette) {
  Around around;
  LookAround(picture, bounds, x, y, around);
  if (around.person_count == 0 || around.background_count == 0) return;
  const std::array<float, 3> person = around.PersonColor();
  const float alpha = around.Alpha();
  for (int v = std::max(y, 0); v < std::min(y + kBlock_px, silhouette.height()); ++v) {
    for (int u = std::max(x, 0); u < std::min(x + kBlock_px, silhouette.width()); ++u) {
      const Word mask = Word{1} << (u & 63);
      if ((bounds.Band(u >> 6, v) & mask) != 0)
        RefinePixel(picture, u, v, person, alpha, mask, silhouette.row(v)[u >> 6]);
    }
  }
}

MOCAP_VECTORIZED
void RefineAll(const Picture& picture, const Bounds& bounds, Silhouette& silhouette) {
  for (int y = kFirst; y < silhouette.height(); y += kBlock_px) {
    for (int i = 0; i < silhouette.words_per_row(); ++i) {
      for (Word band = bounds.Band(i, y) | bounds.Band(i, y + 1); band != 0;) {
        const int bit = std::countr_zero(band);
        const int x = i * 64 + bit;
        const bool is_first = (x - kFirst) % kBlock_px == 0;
        RefineBlock(picture, bounds, is_first ? x : x - 1, y, silhouette);
        band &= ~((is_first ? Word{3} : Word{1}) << bit);
      }
    }
  }
}

}  // namespace

void OutlineRefiner::Refine(const ExpectedPicture& expected, ImageView<const Bgr> image,
                            const std::array<float, 3>& gain, ImageView<const float> alpha_shift,
                            const PixelBox& frame, Silhouette& silhouette) {
  const auto in_frame = [&](const auto& view) {
    return view.Section(frame.left, frame.top, silhouette.width(), silhouette.height());
  };
  inside_.Reserve(image.width(), image.height()), near_.Reserve(image.width(), image.height());
  Erode(silhouette, 1, inside_);
  Dilate(silhouette, 1, near_);
  RefineAll({expected, frame.left, frame.top, in_frame(image), gain, in_frame(alpha_shift)},
            {inside_, near_}, silhouette);
}

}  // namespace mocap
