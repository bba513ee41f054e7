// Lenses as other models, for formats that hold only those.
#pragma once

#include <string>
#include <vector>

#include "core/reconstruction/camera/camera_model.h"

namespace mocap {

/// Returns the OpenCV lens that maps like `lens` over the picture: itself if it is one, else a fit.
/// @throws SetupError  naming the camera when the fit leaves more than 0.25 px.
OpenCvLens AsOpenCvLens(const CameraCalibration& camera);

/// Returns that lens for formats with five coefficients. @throws SetupError  for a rational one.
OpenCvLens AsFiveCoefficients(const CameraCalibration& camera, const std::string& format);

/// Fits an OpenCV lens to directions and their pixels. @param name  for messages.
OpenCvLens FitOpenCvLens(const std::string& name, const OpenCvLens& start,
                         const std::vector<Vector2>& normalized,
                         const std::vector<Vector2>& pixels);

/// Returns the Tsai lens with the most similar mapping; errors as above.
TsaiLens AsTsaiLens(const CameraCalibration& camera);

/// Returns the root mean square difference of two lenses over a picture's directions [px].
double LensDifferencePx(const CameraCalibration& a, const Lens& b);

/// Returns the share of the picture, from 0 to 1, that has no direction.
double HiddenShare(const CameraCalibration& camera);

/// The same, only where the lens's radius folds: pixels outside a fisheye's field do not count.
double FoldedShare(const CameraCalibration& camera);

}  // namespace mocap
