// Camera pictures of the report, with silhouette and body drawn over them.
#pragma once

#include <string>

#include "tools/report/evaluation.h"
#include "tools/take_samples.h"

namespace mocap {

/// One camera's picture cut to the person, as an inline SVG that holds it as a JPEG.
/// @param row   the pose at that moment; drawn when it is tracked.
/// @param view  with its image.
std::string CameraViewSvg(const CameraCalibration& camera, const SampledView& view,
                          const PoseRow& row, const BodySizes& sizes);

}  // namespace mocap
