// Camera pictures of the report, with silhouette and body drawn over them.
#pragma once

#include <span>
#include <string>

#include "tools/report/evaluation.h"
#include "tools/take_samples.h"

namespace mocap {

/// Somebody at the moment of a picture. Borrowed.
struct ViewedBody {
  const PoseRow& row;  ///< Drawn when it is tracked.
  const BodySizes& sizes;
  int color = kOfSides;  ///< Of the report's; kOfSides: one for each side of the body.

  static constexpr int kOfSides = -1;
};

/// One camera's picture cut to the people, as an inline SVG that holds it as a JPEG.
/// @param view  with its image.
std::string CameraViewSvg(const CameraCalibration& camera, const SampledView& view,
                          std::span<const ViewedBody> bodies);

}  // namespace mocap
