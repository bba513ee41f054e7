// §4: draws a background that was seen in one direction as seen from another.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/image.h"
#include "core/kernels/mixing.h"
#include "core/reconstruction/camera/camera_model.h"

namespace mocap {

using kernels::PackedPixel;

/// The empty studio as seen in one direction, at full and at half the resolution.
struct BackgroundView {
  /// @param image  a whole camera picture.
  BackgroundView(const PanTiltAngles& view_angles, const RigidTransform& X_CW_of_view,
                 const Image<Bgr>& image);

  PanTiltAngles angles;
  RigidTransform X_CW;
  int width = 0, height = 0;
  int half_width = 0, half_height = 0;  ///< Without the padding.
  std::vector<PackedPixel> pixels, half;
};

/// Positions in a view [pixels of the full picture], for consecutive pixels of a row.
struct ViewPlaces {
  const float* x = nullptr;
  const float* y = nullptr;
};

/// Draws pixels by interpolating between those of a view.
/// @pre  the positions lie in the view, not on its last column or row.
void DrawBetween(const BackgroundView& view, const ViewPlaces& places, int count,
                 const std::array<float*, 3>& color, std::uint8_t* slope);

/// Draws pixels of a half picture from the view's nearest ones; slopes allow for the shift.
/// @pre  the positions lie in the view.
void DrawNearest(const BackgroundView& view, const ViewPlaces& places, int count,
                 const std::array<std::uint8_t*, 3>& color, std::uint8_t* slope);

}  // namespace mocap
