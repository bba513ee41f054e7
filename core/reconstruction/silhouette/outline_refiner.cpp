#include "core/reconstruction/silhouette/outline_refiner.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "core/lanes.h"
#include "core/reconstruction/silhouette/pixel_lanes.h"

namespace mocap {
namespace {

using Word = std::uint64_t;

// Pixels of a block are so close together that they share their surroundings.
constexpr int kBlock_px = 2;
// Offset of the first block: blocks that cross the edge of a tile reach equally far on both sides.
constexpr int kFirst = -1;
constexpr int kReach_px = 3;
// Half of the rows around a block are enough, with the outermost among them. Counted from its first
// row.
constexpr std::array<int, 4> kRows = {-3, -1, 2, 4};
// Colours closer than this [grey levels] decide nothing.
constexpr float kLeastContrast = 4;
// Pictures are gamma-coded: a pixel half covered by a darker person looks brighter than the mean of
// the two colours.
constexpr float kHalfCovered = 0.4f;

constexpr int kWord_px = 64;
// Eight adjacent pixels belong to five blocks; their surroundings begin this far before.
constexpr int kBefore_px = kReach_px - kFirst;
constexpr int kAround_px = 2 * kFloats;
constexpr int kAroundRows = kBlock_px + 2 * kReach_px;
static_assert(kFloats + 2 * kBefore_px == kAround_px);

// Within the frame of a silhouette.
struct Picture {
  const ExpectedPicture& expected;
  int left, top;  // Position of the frame in the expected picture.
  ImageView<const Bgr> image;
  std::array<float, 3> gain;
  ImageView<const float> alpha_shift;
};

// The size of bit planes, with an empty word between rows and empty rows above and below.
struct PlaneSize {
  PlaneSize(int width, int height_in)
      : words((width + kWord_px - 1) / kWord_px), height(height_in), stride(words + 1) {}
  std::ptrdiff_t At(int word, int y) const { return (y + kMargin) * stride + 1 + word; }
  std::size_t Count() const { return At(0, height + kMargin); }
  static constexpr int kMargin = kReach_px - kFirst;
  int words, height;
  std::ptrdiff_t stride;
};

struct Planes {
  PlaneSize size;
  const Word *person, *background, *inside, *outside;
  // The pixels of a word that the outline may cross.
  MOCAP_INLINE Word Band(int word, int y) const {
    const std::ptrdiff_t i = size.At(word, y);
    return (person[i] | background[i]) & ~(inside[i] | outside[i]);
  }
};

// Writes the pixels inside a silhouette and those outside.
void Part(const Silhouette& silhouette, const PlaneSize& size, Word* person, Word* background) {
  const Word last = ~Word{0} >> (size.words * kWord_px - silhouette.width());
  for (int y = 0; y < size.height; ++y) {
    const Word* const row = silhouette.row(y);
    Word* const in = person + size.At(0, y);
    Word* const out = background + size.At(0, y);
    for (int word = 0; word < size.words; ++word) in[word] = row[word], out[word] = ~row[word];
    out[size.words - 1] &= last;
    in[size.words] = out[size.words] = 0;
  }
}

// A word's pixels and their neighbours.
MOCAP_INLINE Word Near(const Word* plane, std::ptrdiff_t stride) {
  const auto column = [=](int word) {
    return plane[word - stride] | plane[word] | plane[word + stride];
  };
  const Word here = column(0);
  return here | here << 1 | here >> 1 | column(-1) >> (kWord_px - 1) | column(1) << (kWord_px - 1);
}

// Removes pixels beside the other plane.
MOCAP_VECTORIZED
void KeepApart(const Word* person, const Word* background, std::ptrdiff_t stride,
               std::ptrdiff_t count, Word* __restrict inside, Word* __restrict outside) {
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    inside[i] = person[i] & ~Near(background + i, stride);
    outside[i] = background[i] & ~Near(person + i, stride);
  }
}

// The pixels around eight of a row, in every lane from bit kFirstAround on. Words are little-endian
// in memory.
constexpr int kFirstAround = 8 - kBefore_px;
MOCAP_INLINE Ints BitsAround(const Word* row, int pixel) {
  static_assert(std::endian::native == std::endian::little);
  std::int32_t bits;
  std::memcpy(&bits, reinterpret_cast<const std::uint8_t*>(row) + pixel / 8 - 1, sizeof bits);
  return AllOf(bits);
}

// Sums of the left or right half of kAround_px columns.
struct Columns {
  // Sums over rows: of pixels as they are loaded, with −1 in the highest byte; and of the same
  // without green, which leaves room for carries.
  Ints colors{}, blue_red{};
  Floats shifts{};
  Ints background_count{};

  MOCAP_INLINE void Add(const Bgr* pixels, Ints person, const float* alpha_shift, Ints background) {
    Ints pixel, shift;
    LoadPixels(pixels, pixel), LoadLanes(alpha_shift, shift);
    pixel = (pixel | -0x1000000) & person;
    colors += pixel, blue_red += pixel & 0xff00ff;
    shifts += reinterpret_cast<Floats>(shift & background);
    background_count -= background;
  }
};

// Sums of columns around the blocks of eight pixels.
template <typename Lanes>
MOCAP_INLINE void SumAround(const Lanes& left, const Lanes& right, Lanes& sums) {
  const Lanes twos = __builtin_shufflevector(left, right, 0, 2, 4, 6, 8, 10, 12, 14) +
                     __builtin_shufflevector(left, right, 1, 3, 5, 7, 9, 11, 13, 15);
  const Lanes fours = twos + __builtin_shufflevector(twos, twos, 1, 2, 3, 4, 5, 6, 7, 7);
  sums = __builtin_shufflevector(fours, fours, 0, 1, 1, 2, 2, 3, 3, 4) +
         __builtin_shufflevector(fours, fours, 2, 3, 3, 4, 4, 5, 5, 6);
}

// The person's colours and the background's brightness around eight pixels. NaN if there are none,
// so that nothing is decided.
struct Around {
  MOCAP_INLINE Around(const Columns& left, const Columns& right, const std::array<float, 3>& gain) {
    Ints colors, blue_red, background_count;
    SumAround(left.colors, right.colors, colors);
    SumAround(left.blue_red, right.blue_red, blue_red);
    SumAround(left.shifts, right.shifts, alpha);
    SumAround(left.background_count, right.background_count, background_count);
    const Ints green = colors - blue_red;
    const Floats per_pixel = 1 / ToFloats(-(green >> 24));
    person[0] = per_pixel * ToFloats(blue_red & 0xffff) * gain[0];
    person[1] = per_pixel * ToFloats(green >> 8 & 0xffff) * gain[1];
    person[2] = per_pixel * ToFloats(blue_red >> 16) * gain[2];
    alpha = 1 + alpha / ToFloats(background_count);
  }
  std::array<Floats, 3> person;
  Floats alpha;
};

// For eight pixels, as bits of their lanes: whether the colours differ enough; and in the bits
// above, whether the person covers half of the pixel.
MOCAP_INLINE Ints CoverOf(const Around& around, const Bgr* pixels, const std::array<float, 3>& gain,
                          const WeighedPixels& expected, int first) {
  Ints packed;
  LoadPixels(pixels, packed);
  Floats along{}, contrast_sq{};
#pragma GCC unroll 3
  for (int c = 0; c < 3; ++c) {
    const Floats background =
        LoadShorts(&expected.mean[c][first], WeighedPixels::kMeanUnit) * around.alpha;
    const Floats contrast = around.person[c] - background;
    along += contrast * (ChannelOf(packed, c) * gain[c] - background);
    contrast_sq += contrast * contrast;
  }
  return ((contrast_sq >= kLeastContrast * kLeastContrast) & PlaceBits()) |
         ((along > kHalfCovered * contrast_sq) & PlaceBits() << kFloats);
}

// The pixels and shifts around eight pixels of a block's rows.
struct Patch {
  ImageView<const Bgr> image;
  ImageView<const float> alpha_shift;
};

// Copies the part of a patch that lies in the picture, for patches at its edge.
class PatchAtEdge {
 public:
  Patch Copy(const Picture& picture, int left, int top) {
    const int first = std::max(-left, 0);
    const int count = std::min(kAround_px, picture.image.width() - left) - first;
    const ImageView<Bgr> image(image_.data(), kAround_px, kAroundRows);
    const ImageView<float> shift(shift_.data(), kAround_px, kAroundRows);
    for (int y = std::max(-top, 0); y < std::min(kAroundRows, picture.image.height() - top); ++y) {
      std::copy_n(picture.image.row(top + y) + left + first, count, image.row(y) + first);
      std::copy_n(picture.alpha_shift.row(top + y) + left + first, count, shift.row(y) + first);
    }
    return {image, shift};
  }

 private:
  std::array<Bgr, kAround_px * kAroundRows> image_{};
  std::array<float, kAround_px * kAroundRows> shift_{};
};

MOCAP_INLINE Patch PatchAround(const Picture& picture, int left, int top, PatchAtEdge& at_edge) {
  if (left < 0 || top < 0 || left + kAround_px > picture.image.width() ||
      top + kAroundRows > picture.image.height())
    return at_edge.Copy(picture, left, top);
  return {picture.image.Section(left, top, kAround_px, kAroundRows),
          picture.alpha_shift.Section(left, top, kAround_px, kAroundRows)};
}

// @param inside, outside  the word in the block's first row.
MOCAP_INLINE Around LookAround(const Patch& patch, const Word* inside, const Word* outside,
                               std::ptrdiff_t stride, int pixel, const std::array<float, 3>& gain) {
  Columns left, right;
#pragma GCC unroll 4
  for (const int row : kRows) {
    const Bgr* const pixels = patch.image.row(kReach_px + row);
    const float* const shifts = patch.alpha_shift.row(kReach_px + row);
    const Ints person = BitsAround(inside + row * stride, pixel);
    const Ints background = BitsAround(outside + row * stride, pixel);
    const Ints first = PlaceBits() << kFirstAround, last = first << kFloats;
    left.Add(pixels, (person & first) == first, shifts, (background & first) == first);
    right.Add(pixels + kFloats, (person & last) == last, shifts + kFloats,
              (background & last) == last);
  }
  return {left, right, gain};
}

// Keeps those of eight pixels per row that the person covers by half, where the outline may cross
// them. Pixels with similar colours stay.
MOCAP_INLINE void RefinePixels(const Picture& picture, const Around& around, const Patch& patch,
                               const std::array<Word, kBlock_px>& bands, int word, int pixel, int y,
                               ImageView<Word> silhouette) {
  const int x = picture.left + word * kWord_px + pixel;
  const int last = silhouette.height() - 1;
  const std::array<int, kBlock_px> rows = {std::max(y, 0), std::min(y + 1, last)};
  const WeighedPixels* const expected =
      picture.expected.Group(x / WeighedPixels::kPixels, picture.top);
  Ints covers{};
#pragma GCC unroll 2
  for (int row = kBlock_px - 1; row >= 0; --row)
    covers = covers << 2 * kFloats | CoverOf(around, patch.image.row(kReach_px + row) + kBefore_px,
                                             picture.gain, expected[rows[row]],
                                             x % WeighedPixels::kPixels);
  const unsigned cover = UnionOf(covers);
#pragma GCC unroll 2
  for (int row = 0; row < kBlock_px; ++row) {
    const unsigned bits = cover >> 2 * kFloats * row;
    Word& refined = silhouette(word, rows[row]);
    const Word told = bands[row] & Word{bits & 0xff} << pixel;
    refined = (refined & ~told) | (Word{bits >> kFloats & 0xff} << pixel & told);
  }
}

MOCAP_VECTORIZED
void RefineAll(const Picture& picture, const Planes& planes, ImageView<Word> silhouette) {
  PatchAtEdge at_edge;
  for (int y = kFirst; y < silhouette.height(); y += kBlock_px) {
    for (int word = 0; word < silhouette.width(); ++word) {
      const std::array<Word, kBlock_px> bands = {planes.Band(word, y), planes.Band(word, y + 1)};
      for (Word left = bands[0] | bands[1]; left != 0;) {
        const int pixel = std::countr_zero(left) / kFloats * kFloats;
        left &= ~(Word{0xff} << pixel);
        const Patch patch =
            PatchAround(picture, word * kWord_px + pixel - kBefore_px, y - kReach_px, at_edge);
        const std::ptrdiff_t i = planes.size.At(word, y);
        const Around around = LookAround(patch, planes.inside + i, planes.outside + i,
                                         planes.size.stride, pixel, picture.gain);
        RefinePixels(picture, around, patch, bands, word, pixel, y, silhouette);
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
  const PlaneSize size(silhouette.width(), silhouette.height());
  for (auto* const plane : {&person_, &background_, &inside_, &outside_}) {
    plane->reserve(PlaneSize(image.width(), image.height()).Count());
    plane->assign(size.Count(), 0);
  }
  const std::ptrdiff_t first = size.At(0, 0);
  Part(silhouette, size, person_.data(), background_.data());
  KeepApart(&person_[first], &background_[first], size.stride, size.height * size.stride,
            &inside_[first], &outside_[first]);
  RefineAll({expected, frame.left, frame.top, in_frame(image), gain, in_frame(alpha_shift)},
            {size, person_.data(), background_.data(), inside_.data(), outside_.data()},
            {silhouette.row(0), silhouette.words_per_row(), silhouette.height()});
}

}  // namespace mocap
