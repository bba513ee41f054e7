// §4: where exactly the person ends.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/image.h"
#include "core/reconstruction/background/expected_picture.h"
#include "core/reconstruction/silhouette/silhouette.h"

namespace mocap {

/// Moves a silhouette's outline to where the person covers half of a pixel.
///
/// Windows blur the outline, and so do codecs, which keep colours at half the resolution. For each
/// pixel beside the outline the person's colour is taken from farther inside, the background's
/// brightness from farther outside, shadow included, and the share of the person in the pixel is
/// how far its colour lies from one towards the other. Where the two colours are alike, or a limb
/// is too thin to have an inside, the outline stays. Thread-bound; reuses its memory.
class OutlineRefiner {
 public:
  /// @param gain         what each of the picture's channels is multiplied by.
  /// @param alpha_shift  α − 1 of the picture's pixels, at least within 4 of the silhouette.
  /// @param frame        where in the picture the silhouette lies.
  void Refine(const ExpectedPicture& expected, ImageView<const Bgr> image,
              const std::array<float, 3>& gain, ImageView<const float> alpha_shift,
              const PixelBox& frame, Silhouette& silhouette);

 private:
  // What is in the silhouette and what is not, and what of both is not beside the other: a bit a
  // pixel, with empty words and rows around them.
  std::vector<std::uint64_t> person_, background_, inside_, outside_;
};

}  // namespace mocap
