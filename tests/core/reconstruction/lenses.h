// Lenses for tests, all strongly distorted.
#pragma once

#include <string>
#include <vector>

#include "core/reconstruction/camera/camera_model.h"

namespace mocap {

inline Matrix3 PinholeMatrix(double fx, double fy, double cx, double cy) {
  Matrix3 K = Matrix3::Identity();
  K(0, 0) = fx;
  K(1, 1) = fy;
  K(0, 2) = cx;
  K(1, 2) = cy;
  return K;
}

/// The corners of a 640 x 480 picture move by some 40 pixels.
inline TsaiLens BarrelTsaiLens() {
  return {.focal_mm = 4.6,
          .kappa1 = 0.006,
          .sx = 1.02,
          .center_px = {323.5, 236.25},
          .pitch_mm = {0.01, 0.0099}};
}

inline TsaiLens PincushionTsaiLens() {
  TsaiLens lens = BarrelTsaiLens();
  lens.kappa1 = -0.006;
  return lens;
}

/// Turns back in the picture's very corners, as fitted polynomials do.
inline OpenCvLens WideOpenCvLens() {
  return {.K = PinholeMatrix(490, 493, 334.7, 222.4),
          .distortion = {-0.3687, 0.2032, 0.003, -0.002, -0.0712}};
}

/// With all eight coefficients, as wide lenses are calibrated with OpenCV's rational model.
inline OpenCvLens RationalOpenCvLens() {
  return {.K = PinholeMatrix(330, 333, 316.5, 247.5),
          .distortion = {1.5, -0.8, 0.001, -0.0005, 0.2, 1.9, -0.6, 0.1}};
}

inline FisheyeLens WideFisheyeLens() {
  return {.K = PinholeMatrix(310, 311, 318, 243), .distortion = {-0.05, 0.02, -0.01, 0.003}};
}

struct NamedCamera {
  std::string name;
  CameraCalibration calibration;
};

/// One camera of 640 x 480 pixels for each lens.
inline std::vector<NamedCamera> DistortedCameras() {
  const auto camera = [](const std::string& name, const Lens& lens) {
    CameraCalibration calibration;
    calibration.name = name;
    calibration.width_px = 640;
    calibration.height_px = 480;
    calibration.lens = lens;
    return NamedCamera{name, calibration};
  };
  return {camera("barrel_tsai", BarrelTsaiLens()), camera("pincushion_tsai", PincushionTsaiLens()),
          camera("opencv", WideOpenCvLens()), camera("rational", RationalOpenCvLens()),
          camera("fisheye", WideFisheyeLens())};
}

}  // namespace mocap
