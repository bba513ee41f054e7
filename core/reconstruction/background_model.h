// §4: what the empty studio looks like to one camera, pixel by pixel.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/image.h"

namespace mocap {

/// The four classes of Horprasert, Harwood and Davis (1999).
enum class PixelClass : std::uint8_t {
  kBackground = 0,
  kShadow = 1,
  kHighlight = 2,
  kForeground = 3
};

/// Horprasert's model of a camera that does not move.
///
/// For each pixel the brightness distortion α is the scale that brings the background's colour
/// closest to the pixel's, and the chromaticity distortion CD is the distance that is left. Both
/// are divided by their own variation, so that one threshold serves all pixels; the thresholds come
/// from the histograms of the training frames. Horprasert et al. 1999.
class BackgroundModel {
 public:
  /// @param detection_rate  share of background pixels that shall be called background.
  /// @pre  at least two frames, all of one size.
  BackgroundModel(std::span<const Image<Bgr>* const> frames, double detection_rate);

  /// Classifies every pixel.
  void Classify(ImageView<const Bgr> image, Image<std::uint8_t>& classes) const;

  int width() const { return width_; }
  int height() const { return height_; }

 private:
  struct Pixel {
    float mean[3];
    float inverse_sigma[3];
    float inverse_alpha_variation;
    float inverse_cd_variation;
  };
  struct Distortion {
    float alpha;
    float cd;
  };
  static Distortion Distort(const Pixel& model, const Bgr& pixel, float gain);
  float GainOf(ImageView<const Bgr> image) const;

  int width_ = 0, height_ = 0;
  std::vector<Pixel> pixels_;
  float cd_threshold_ = 0;
  float alpha_low_ = 0, alpha_high_ = 0;
};

}  // namespace mocap
