// Intrinsics from many views of a board (Zhang 2000, refined with the product's own models).
#pragma once

#include <string>
#include <vector>

#include "core/reconstruction/camera/camera_model.h"
#include "tools/calibration/detections.h"

namespace mocap {

enum class LensModel { kTsai, kOpenCv, kFisheye };

struct LensFitOptions {
  LensModel model = LensModel::kOpenCv;
  Vector2 pitch_mm{0.01, 0.01};  ///< Tsai's dx, dy: only their product with other parameters is
                                 ///< observable.
  int most_views = 60;           ///< Chosen to cover the picture.
};

struct LensFit {
  Lens lens;
  double rms_px = 0;
  int views = 0;
  double focal_sigma_share = 0;  ///< Standard deviation of the focal length over its value.
  std::vector<int> used;         ///< Indices of detections.
};

/// Fits a camera's intrinsics.
/// @throws SetupError  naming camera and remedy: too few views, boards all in the same tilt,
/// corners that fit no lens.
LensFit FitLens(const BoardDetections& detections, int camera, const LensFitOptions& options);

}  // namespace mocap
