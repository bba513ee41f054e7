// §4: the exact outline of the person.
#pragma once

#include <array>

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
/// have an inside, the outline stays; so it does within kMargin_px of the picture's edge.
/// Thread-bound; reuses its memory.
class OutlineRefiner {
 public:
  static constexpr int kMargin_px = 8;

  /// @param gain         factor for each of the picture's channels.
  /// @param alpha_shift  α − 1 of the picture's pixels, at least within 4 of the silhouette.
  void Refine(const ExpectedPicture& expected, ImageView<const Bgr> image,
              const std::array<float, 3>& gain, ImageView<const float> alpha_shift,
              Silhouette& silhouette);

 private:
  // Pixels of the silhouette, and others, that do not touch the other kind.
  Silhouette inside_, outside_;
};

}  // namespace mocap
