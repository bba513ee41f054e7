#include "core/reconstruction/silhouette/outline_refiner.h"

#include <bit>

#include "core/kernels/outline.h"
#include "core/reconstruction/silhouette/bit_filters.h"

namespace mocap {

void OutlineRefiner::Refine(const ExpectedPicture& expected, ImageView<const Bgr> image,
                            const std::array<float, 3>& gain, ImageView<const float> alpha_shift,
                            Silhouette& silhouette) {
  using kernels::kAround_px, kernels::kAroundRows, kernels::kOutlineBefore_px;
  using kernels::kOutlineReach_px, kernels::kOutlinePixels;
  using Word = kernels::BitWord;
  constexpr int kBlock_px = kernels::kOutlineBlock_px;
  static_assert(kMargin_px % kOutlinePixels == 0 && kMargin_px >= kOutlineBefore_px);
  const int words = silhouette.words_per_row();
  Erode(silhouette, 1, inside_);
  Dilate(silhouette, 1, outside_);
  for (int i = 0; i < words * outside_.height(); ++i) outside_.row(0)[i] ^= ~Word{0};
  for (int y = kernels::kOutlineFirst + 2 * kBlock_px;
       y + kAroundRows - kOutlineReach_px <= silhouette.height(); y += kBlock_px) {
    for (int word = 0; word < words; ++word) {
      // The pixels of two rows that the outline may cross.
      std::array<Word, kBlock_px> bands;
      for (int row = 0; row < kBlock_px; ++row)
        bands[row] = ~(inside_.row(y + row)[word] | outside_.row(y + row)[word]);
      for (Word left = bands[0] | bands[1]; left != 0;) {
        const int pixel = std::countr_zero(left) / kOutlinePixels * kOutlinePixels;
        left &= ~(Word{0xff} << pixel);
        const int x = word * 64 + pixel, first = x - kOutlineBefore_px;
        if (first < 0 || first + kAround_px > silhouette.width()) continue;
        const WeighedPixels* const group = expected.Group(x / WeighedPixels::kPixels, y);
        const auto decisions = kernels::JudgeOutline(
            {image.Section(first, y - kOutlineReach_px, kAround_px, kAroundRows),
             alpha_shift.Section(first, y - kOutlineReach_px, kAround_px, kAroundRows),
             inside_.row(y) + word, outside_.row(y) + word, words, pixel},
            gain, {group, group + 1}, x % WeighedPixels::kPixels);
        for (int row = 0; row < kBlock_px; ++row) {
          Word& refined = silhouette.row(y + row)[word];
          const Word changed = bands[row] & Word{decisions[row].told} << pixel;
          refined = (refined & ~changed) | (Word{decisions[row].covered} << pixel & changed);
        }
      }
    }
  }
}

}  // namespace mocap
