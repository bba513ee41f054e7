// The report's camera pictures, overlaid with trimap and body.
#pragma once

#include <span>
#include <string>

#include "tools/report/evaluation.h"
#include "tools/take_samples.h"

namespace mocap {

/// A person at the moment of a picture. Not owned.
struct ViewedBody {
  const PoseRow& row;  ///< Drawn if tracked.
  const BodySizes& sizes;
  int color = kOfSides;  ///< From the report's palette; kOfSides: one per side of the body.

  static constexpr int kOfSides = -1;
};

/// A camera's picture cropped to the people, as an inline SVG with an embedded JPEG.
/// @param view  must contain the image.
std::string CameraViewSvg(const CameraCalibration& camera, const SampledView& view,
                          std::span<const ViewedBody> bodies);

/// Explains the pictures' outlines and hatching. A page with pictures needs it once, before them.
std::string TrimapKey();

}  // namespace mocap
