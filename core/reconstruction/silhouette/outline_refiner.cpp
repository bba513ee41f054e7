#include "core/reconstruction/silhouette/outline_refiner.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>

#include "core/kernels/bits.h"
#include "core/kernels/outline.h"

namespace mocap {
namespace {

using Word = kernels::BitWord;
using kernels::kAround_px;
using kernels::kAroundRows;
using kernels::OutlineSurroundings;

constexpr int kBlock_px = kernels::kOutlineBlock_px;
constexpr int kReach_px = kernels::kOutlineReach_px;

constexpr int kWord_px = 64;
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
  static constexpr int kMargin = kernels::kOutlineBefore_px;
  int words, height;
  std::ptrdiff_t stride;
};

struct Planes {
  PlaneSize size;
  const Word *person, *background, *inside, *outside;
  // The pixels of a word that the outline may cross.
  Word Band(int word, int y) const {
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

Patch PatchAround(const Picture& picture, int left, int top, PatchAtEdge& at_edge) {
  if (left < 0 || top < 0 || left + kAround_px > picture.image.width() ||
      top + kAroundRows > picture.image.height())
    return at_edge.Copy(picture, left, top);
  return {picture.image.Section(left, top, kAround_px, kAroundRows),
          picture.alpha_shift.Section(left, top, kAround_px, kAroundRows)};
}

// Keeps those of eight pixels per row that the person covers by half, where the outline may cross
// them. Pixels with similar colours stay.
void RefinePixels(const Picture& picture, const OutlineSurroundings& around,
                  const std::array<Word, kBlock_px>& bands, int word, int y,
                  ImageView<Word> silhouette) {
  const int x = picture.left + word * kWord_px + around.pixel;
  const std::array<int, kBlock_px> rows = {std::max(y, 0),
                                           std::min(y + 1, silhouette.height() - 1)};
  const WeighedPixels* const expected =
      picture.expected.Group(x / WeighedPixels::kPixels, picture.top);
  const auto decisions = kernels::JudgeOutline(
      around, picture.gain, {expected + rows[0], expected + rows[1]}, x % WeighedPixels::kPixels);
  for (int row = 0; row < kBlock_px; ++row) {
    const auto [told, covered] = decisions[row];
    Word& refined = silhouette(word, rows[row]);
    const Word changed = bands[row] & Word{told} << around.pixel;
    refined = (refined & ~changed) | (Word{covered} << around.pixel & changed);
  }
}

void RefineAll(const Picture& picture, const Planes& planes, ImageView<Word> silhouette) {
  PatchAtEdge at_edge;
  for (int y = kernels::kOutlineFirst; y < silhouette.height(); y += kBlock_px) {
    for (int word = 0; word < silhouette.width(); ++word) {
      const std::array<Word, kBlock_px> bands = {planes.Band(word, y), planes.Band(word, y + 1)};
      for (Word left = bands[0] | bands[1]; left != 0;) {
        const int pixel =
            std::countr_zero(left) / kernels::kOutlinePixels * kernels::kOutlinePixels;
        left &= ~(Word{0xff} << pixel);
        const Patch patch = PatchAround(
            picture, word * kWord_px + pixel - kernels::kOutlineBefore_px, y - kReach_px, at_edge);
        const std::ptrdiff_t i = planes.size.At(word, y);
        RefinePixels(picture,
                     {patch.image, patch.alpha_shift, planes.inside + i, planes.outside + i,
                      planes.size.stride, pixel},
                     bands, word, y, silhouette);
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
  kernels::KeepApart(&person_[first], &background_[first], size.stride, size.height * size.stride,
                     &inside_[first], &outside_[first]);
  RefineAll({expected, frame.left, frame.top, in_frame(image), gain, in_frame(alpha_shift)},
            {size, person_.data(), background_.data(), inside_.data(), outside_.data()},
            {silhouette.row(0), silhouette.words_per_row(), silhouette.height()});
}

}  // namespace mocap
