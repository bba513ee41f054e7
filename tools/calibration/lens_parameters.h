// A lens as a list of numbers, for optimisation.
#pragma once

#include <vector>

#include "core/reconstruction/camera/camera_model.h"

namespace mocap {

/// Refined parameters of a lens. Tsai: f κ1 Cx Cy sx; OpenCV: fx fy cx cy k1 k2 p1 p2 k3 (k4 k5 k6
/// stay as they are); fisheye: fx fy cx cy k1 k2 k3 k4.
std::vector<double> LensParameters(const Lens& lens);

/// Puts numbers back; the lens gives the model and what is not refined.
Lens WithParameters(const Lens& lens, const double* parameters);

/// The focal length in pixels, the mean of both directions.
double FocalPx(const Lens& lens);

/// Where the axis meets the picture [px].
Vector2 CenterPx(const Lens& lens);

}  // namespace mocap
