// §4: the exact outline of the person.
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
/// Windows blur the outline, and so do codecs, which store colours at half the resolution. For each
/// pixel beside the outline, the person's colour is taken from further inside. The background's
/// brightness, with its shadows, is taken from further outside. The person's share of the pixel is
/// the position of its colour between the two. Where the two are similar, or a limb is too thin to
/// have an inside, the outline stays. Thread-bound; reuses its memory.
class OutlineRefiner {
 public:
  /// @param gain         factor for each of the picture's channels.
  /// @param alpha_shift  α − 1 of the picture's pixels, at least within 4 of the silhouette.
  /// @param frame        position of the silhouette in the picture.
  void Refine(const ExpectedPicture& expected, ImageView<const Bgr> image,
              const std::array<float, 3>& gain, ImageView<const float> alpha_shift,
              const PixelBox& frame, Silhouette& silhouette);

 private:
  // Pixels inside the silhouette and outside it, and those of both that are not beside the other:
  // one bit per pixel, with empty words and rows around them.
  std::vector<std::uint64_t> person_, background_, inside_, outside_;
};

}  // namespace mocap
