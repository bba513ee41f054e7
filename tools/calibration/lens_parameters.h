// Parameters of a lens as a vector, for optimization.
#pragma once

#include <vector>

#include "core/reconstruction/camera/camera_model.h"

namespace mocap {

/// Parameters that are refined. Tsai: f κ1 Cx Cy sx; OpenCV: fx fy cx cy k1 k2 p1 p2 k3 (k4 k5 k6
/// are fixed); fisheye: fx fy cx cy k1 k2 k3 k4.
std::vector<double> LensParameters(const Lens& lens);

/// Inverse of LensParameters; `lens` gives the model and the fixed parameters.
Lens WithParameters(const Lens& lens, const double* parameters);

/// Focal length in pixels, the mean of both directions.
double FocalPx(const Lens& lens);

/// Principal point [px].
Vector2 CenterPx(const Lens& lens);

}  // namespace mocap
