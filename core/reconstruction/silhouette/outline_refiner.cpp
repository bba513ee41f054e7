#include "core/reconstruction/silhouette/outline_refiner.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "core/lanes.h"
#include "core/reconstruction/silhouette/bit_filters.h"
#include "core/reconstruction/silhouette/pixel_lanes.h"

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
static_assert(kSide == kFloats);
constexpr int kWord_px = 64;
constexpr auto kCounts = [] {
  std::array<std::uint8_t, kAll + 1> counts{};
  for (unsigned bits = 1; bits <= kAll; ++bits)
    counts[bits] = static_cast<std::uint8_t>(counts[bits >> 1] + (bits & 1));
  return counts;
}();

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

// A word of a row and the pixels around its blocks: none of those beyond the row are set.
class Stretch {
 public:
  Stretch() = default;
  // @param flip  what turns pixels over.
  MOCAP_INLINE Stretch(const Word* row, int words, int word, Word flip) {
    const Word here = row[word] ^ flip;
    const Word before = word > 0 ? row[word - 1] ^ flip : 0;
    const Word after = word + 1 < words ? row[word + 1] ^ flip : 0;
    first_ = here << kBefore | before >> (kWord_px - kBefore);
    last_ = here >> (kHalf - kBefore) | after << (kWord_px - kHalf + kBefore);
  }
  // The kSide pixels around the block that begins at a pixel of the word.
  MOCAP_INLINE unsigned Around(int block) const {
    const int begin = block - kFirst;
    return static_cast<unsigned>(begin < kHalf ? first_ >> begin : last_ >> (begin - kHalf)) & kAll;
  }

 private:
  // The first block begins before the word.
  static constexpr int kBefore = kReach_px - kFirst, kHalf = kWord_px / 2;
  // 64 pixels from kBefore before the word on, and as many from kHalf later on.
  Word first_ = 0, last_ = 0;
};

// Some of the rows around the blocks of a word.
struct Surroundings {
  MOCAP_INLINE Surroundings(const Bounds& bounds, int word, int block_y) {
    const int words = bounds.inside.words_per_row();
    for (std::size_t k = 0; k < kRows.size(); ++k) {
      const int wanted = block_y + kRows[k];
      y[k] = std::clamp(wanted, 0, bounds.inside.height() - 1);
      if (y[k] != wanted) continue;  // Nothing counts beyond the picture.
      person[k] = Stretch(bounds.inside.row(wanted), words, word, 0);
      background[k] = Stretch(bounds.near.row(wanted), words, word, ~Word{0});
    }
  }
  std::array<int, kRows.size()> y;
  std::array<Stretch, kRows.size()> person, background;
};

// The person's colours and the background's brightness around a block.
struct Around {
  // Sums: what lies in one column, or more of it. Blue and red share numbers.
  Ints blue_red{}, green{};
  Floats alphas{};
  int person_count = 0, background_count = 0;

  // Adds a row of kSide pixels.
  MOCAP_INLINE void Add(const Bgr* pixels, unsigned person, const float* alpha_shift,
                        unsigned background) {
    Ints colors, shifts;
    LoadPixels(pixels, colors), LoadLanes(alpha_shift, shifts);
    colors &= ChoiceOf(person);
    blue_red += colors & 0xff00ff, green += colors >> 8 & 0xff;
    alphas += reinterpret_cast<Floats>(shifts & ChoiceOf(background));
    person_count += kCounts[person], background_count += kCounts[background];
  }

  // Adds those of a row's pixels that count: others may not be there.
  MOCAP_INLINE void AddSome(const Bgr* pixels, unsigned person, const float* alpha_shift,
                            unsigned background) {
    for (; person != 0; person &= person - 1, ++person_count) {
      const Bgr& p = pixels[std::countr_zero(person)];
      blue_red[0] += p.b | p.r << 16, green[0] += p.g;
    }
    for (; background != 0; background &= background - 1, ++background_count)
      alphas[0] += alpha_shift[std::countr_zero(background)];
  }

  MOCAP_INLINE std::array<float, 3> PersonColor() const {
    Half both = __builtin_shufflevector(blue_red, green, 0, 1, 8, 9) +
                __builtin_shufflevector(blue_red, green, 2, 3, 10, 11) +
                __builtin_shufflevector(blue_red, green, 4, 5, 12, 13) +
                __builtin_shufflevector(blue_red, green, 6, 7, 14, 15);
    both += __builtin_shufflevector(both, both, 1, 0, 3, 2);
    const float per_pixel = 1 / static_cast<float>(person_count);
    return {per_pixel * static_cast<float>(both[0] & 0xffff),
            per_pixel * static_cast<float>(both[2]), per_pixel * static_cast<float>(both[0] >> 16)};
  }
  MOCAP_INLINE float Alpha() const {
    const float sum = ((alphas[0] + alphas[4]) + (alphas[1] + alphas[5])) +
                      ((alphas[2] + alphas[6]) + (alphas[3] + alphas[7]));
    return 1 + sum / static_cast<float>(background_count);
  }

 private:
  using Half = std::int32_t __attribute__((vector_size(sizeof(Ints) / 2)));
};

// What was found around the blocks of a word, pixel by pixel from the first block's first on.
struct BlockColors {
  static constexpr std::size_t kPixels = kWord_px + kBlock_px;
  std::array<std::array<float, kPixels>, 3> person;
  std::array<float, kPixels> alpha;
};

// Looks around the block that begins at a pixel of the word.
// @returns whether both person and background are there.
MOCAP_INLINE bool LookAround(const Picture& picture, const Surroundings& surroundings, int word,
                             int block, BlockColors& colors) {
  Around around;
  const int begin = word * kWord_px + block - kReach_px;
  const int width = picture.image.width();
  const bool is_whole = begin >= 0 && begin + kSide <= width;
  const unsigned valid = begin + kSide <= width ? kAll : kAll >> (begin + kSide - width);
#pragma GCC unroll 4
  for (std::size_t k = 0; k < kRows.size(); ++k) {
    const unsigned person = surroundings.person[k].Around(block);
    const unsigned background = surroundings.background[k].Around(block) & valid;
    const Bgr* const pixels = picture.image.row(surroundings.y[k]) + begin;
    const float* const alpha_shift = picture.alpha_shift.row(surroundings.y[k]) + begin;
    if (is_whole)
      around.Add(pixels, person, alpha_shift, background);
    else
      around.AddSome(pixels, person, alpha_shift, background);
  }
  if (around.person_count == 0 || around.background_count == 0) return false;
  const std::array<float, 3> person = around.PersonColor();
  const float alpha = around.Alpha();
  for (int i = block - kFirst; i < block - kFirst + kBlock_px; ++i) {
    for (int c = 0; c < 3; ++c) colors.person[c][i] = person[c];
    colors.alpha[i] = alpha;
  }
  return true;
}

// Of eight pixels, as bits: where the colours differ enough to tell, and what the person covers by
// half.
struct Cover {
  unsigned is_told, is_person;
};

MOCAP_INLINE Cover CoverOf(const Picture& picture, const BlockColors& colors, int x, int y) {
  const int first = x % kWord_px - kFirst, width = picture.image.width();
  const WeighedPixels& expected =
      *picture.expected.Group((picture.left + x) / WeighedPixels::kPixels, picture.top + y);
  std::array<Bgr, kFloats> last{};
  const Bgr* pixels = picture.image.row(y) + x;
  if (x + kFloats > width) {
    std::copy(pixels, picture.image.row(y) + width, last.begin());
    pixels = last.data();
  }
  Ints packed;
  LoadPixels(pixels, packed);
  Floats alpha, along{}, contrast_sq{};
  LoadLanes(&colors.alpha[first], alpha);
#pragma GCC unroll 3
  for (int c = 0; c < 3; ++c) {
    Floats person;
    LoadLanes(&colors.person[c][first], person);
    const Floats background =
        LoadShorts(&expected.mean[c][(picture.left + x) % WeighedPixels::kPixels],
                   WeighedPixels::kMeanUnit) *
        alpha;
    const Floats contrast = person * picture.gain[c] - background;
    along += contrast * (ChannelOf(packed, c) * picture.gain[c] - background);
    contrast_sq += contrast * contrast;
  }
  return {BitsOf(contrast_sq >= kLeastContrast * kLeastContrast),
          BitsOf(along > kHalfCovered * contrast_sq)};
}

// Keeps pixels of a word that the person covers by half; leaves those where the colours are alike.
MOCAP_INLINE void RefinePixels(const Picture& picture, const BlockColors& colors, Word pixels,
                               int word, int y, Silhouette& silhouette) {
  Word& refined = silhouette.row(y)[word];
  while (pixels != 0) {
    const int first = std::countr_zero(pixels) / kFloats * kFloats;
    const Cover cover = CoverOf(picture, colors, word * kWord_px + first, y);
    const Word told = pixels & Word{cover.is_told} << first;
    refined = (refined & ~told) | (Word{cover.is_person} << first & told);
    pixels &= ~(Word{kAll} << first);
  }
}

MOCAP_VECTORIZED
void RefineAll(const Picture& picture, const Bounds& bounds, Silhouette& silhouette) {
  BlockColors colors{};  // Others than those of the word in hand are not asked for.
  for (int y = kFirst; y < silhouette.height(); y += kBlock_px) {
    for (int word = 0; word < silhouette.words_per_row(); ++word) {
      const std::array<Word, kBlock_px> bands = {bounds.Band(word, y), bounds.Band(word, y + 1)};
      if ((bands[0] | bands[1]) == 0) continue;
      const Surroundings surroundings(bounds, word, y);
      Word known = 0;
      for (Word band = bands[0] | bands[1]; band != 0;) {
        const int pixel = std::countr_zero(band);
        const int block = pixel - (pixel - kFirst) % kBlock_px;
        const Word both = block < 0 ? Word{1} : Word{3} << block;
        if (LookAround(picture, surroundings, word, block, colors)) known |= both;
        band &= ~both;
      }
      for (int row = 0; row < kBlock_px; ++row)
        if ((bands[row] & known) != 0)
          RefinePixels(picture, colors, bands[row] & known, word, y + row, silhouette);
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
