// §4: limits of the background, learned from pictures of the empty studio.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/image.h"
#include "core/reconstruction/background/expected_picture.h"
#include "core/reconstruction/silhouette/distortion_scan.h"

namespace mocap {

/// Thresholds that background exceeds at the requested rate, each in units of its own variation.
struct DistortionThresholds {
  struct Window {
    float cd = 0;         ///< Length of the mean colour distance.
    float alpha = 0;      ///< Mean brightness distortion, in both directions.
    float roughness = 0;  ///< Deviation of the brightness distortions from a plane.
  };
  float cd = 0;         ///< Chromaticity distortion of a pixel.
  float alpha_low = 0;  ///< Brightness distortion of a pixel, negative.
  std::array<Window, kernels::kWindows> windows;
};

/// Returns what noise exceeds at the rate 1 - `detection_rate` if its deviation is σ and it is
/// independent from pixel to pixel and between channels. The windows' are lower bounds: only four
/// of those around a pixel are counted.
/// @pre  0.5 <= detection_rate < 1.
DistortionThresholds IndependentNoise(double detection_rate);

/// Collects the distortions of training frames in histograms and derives thresholds.
///
/// Horprasert, Harwood, Davis 1999, §3.2. A pixel counts with the least of the windows that contain
/// it, as during operation.
class DistortionHistograms {
 public:
  /// Adds one picture of the empty studio.
  /// @param expected  learned without this picture, or its own noise would be part of it.
  void Add(const ExpectedPicture& expected, ImageView<const Bgr> image,
           const std::array<float, 3>& gain);

  /// Returns thresholds that a share `detection_rate` of the pixels stays within, and independent
  /// noise too. Of an empty studio, a codec keeps less noise than σ, or none; beside people who
  /// move, it passes noise and adds its own.
  /// @pre  0.5 <= detection_rate < 1, and at least one picture was added.
  DistortionThresholds At(double detection_rate) const;

 private:
  class Histogram {
   public:
    void Add(const float* values, int count);
    float Quantile(double rate) const;

   private:
    static constexpr float kBinsPerUnit = 100;
    static constexpr int kBins = 5000;
    std::vector<std::int64_t> counts_ = std::vector<std::int64_t>(kBins);
  };

  // Values of all pixels of the picture that is being added, and of its windows of each size.
  struct WindowValues {
    Histogram cd, alpha, roughness;
    Image<float> cd_image, alpha_image, roughness_image;
  };

  Histogram cd_, darker_;
  std::array<WindowValues, kernels::kWindows> windows_;
  RegionOfInterest everything_;
  DistortionScan scan_;
};

}  // namespace mocap
