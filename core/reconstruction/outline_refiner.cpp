#include "core/reconstruction/outline_refiner.h"

#include <algorithm>
#include <bit>
#include <cstdint>

#include "core/reconstruction/bit_filters.h"

namespace mocap {
namespace {

using Color = std::array<float, 3>;

constexpr int kRadius_px = 3;
// Colours that are closer than this [grey levels] tell nothing.
constexpr float kLeastContrast = 4;
// Pictures are gamma-coded: a pixel half covered by a darker person looks brighter than the middle
// of the two colours.
constexpr float kHalfCovered = 0.4f;

Color ColorOf(const Bgr& p, float gain) { return {p.b * gain, p.g * gain, p.r * gain}; }

}  // namespace

void OutlineRefiner::Refine(const ExpectedPicture& expected, ImageView<const Bgr> image, float gain,
                            const Image<float>& alpha_shift, Silhouette& silhouette) {
  const int width = image.width();
  const int height = image.height();
  Erode(silhouette, 1, inside_);
  Dilate(silhouette, 1, near_);

  // Returns whether the person covers the pixel by half; `otherwise` where that cannot be told.
  const auto covered = [&](int x, int y, bool otherwise) {
    Color person{};
    float background_alpha = 0;
    int person_count = 0, background_count = 0;
    for (int v = std::max(y - kRadius_px, 0); v <= std::min(y + kRadius_px, height - 1); ++v) {
      for (int u = std::max(x - kRadius_px, 0); u <= std::min(x + kRadius_px, width - 1); ++u) {
        if (inside_.Test(u, v)) {
          const Color color = ColorOf(image(u, v), gain);
          for (int c = 0; c < 3; ++c) person[c] += color[c];
          ++person_count;
        } else if (!near_.Test(u, v)) {
          background_alpha += 1 + alpha_shift(u, v);
          ++background_count;
        }
      }
    }
    if (person_count == 0 || background_count == 0) return otherwise;
    const std::size_t i = static_cast<std::size_t>(y) * width + x;
    const Color color = ColorOf(image(x, y), gain);
    float along = 0, contrast_sq = 0;
    for (int c = 0; c < 3; ++c) {
      const float background =
          expected.MeanOf(i, c) * background_alpha / static_cast<float>(background_count);
      const float contrast = person[c] / static_cast<float>(person_count) - background;
      along += contrast * (color[c] - background);
      contrast_sq += contrast * contrast;
    }
    if (contrast_sq < kLeastContrast * kLeastContrast) return otherwise;
    return along > kHalfCovered * contrast_sq;
  };

  for (int y = 0; y < height; ++y) {
    for (int i = 0; i < silhouette.words_per_row(); ++i) {
      std::uint64_t& word = silhouette.row(y)[i];
      for (std::uint64_t band = near_.row(y)[i] & ~inside_.row(y)[i]; band != 0; band &= band - 1) {
        const int bit = std::countr_zero(band);
        const std::uint64_t mask = std::uint64_t{1} << bit;
        word = covered(i * 64 + bit, y, (word & mask) != 0) ? word | mask : word & ~mask;
      }
    }
  }
}

}  // namespace mocap
