// §7.2: part sizes measured on the voxels of one frame.
#pragma once

#include "core/body/body_model.h"
#include "core/tracking/surface_fit.h"

namespace mocap {

/// How far sizes may lie from those believed so far [mm], as standard deviations.
struct SizeSpread {
  double length_mm = 60;  ///< Of torso, thigh, calf, upper arm, lower arm.
  double width_mm = 15;   ///< Between the shoulders, between the hips, neck to head.
};

/// Measures lengths and joint-to-joint widths by fitting them together with the pose to the surface
/// of the voxels, and thicknesses as what lies between the surface and the core. What the pose does
/// not show stays as believed.
///
/// @param fit   holds the frame's samples, for `body`.
/// @param pose  the frame's pose, a start for the joint fit.
BodySizes MeasureSizes(const BodyModel& body, SurfaceFit& fit, const PoseState& pose,
                       const SizeSpread& spread);

/// Measures how thick the trunk is, at a pose that is not final yet: it grows by half of what it
/// lacks, because the pose gives way too.
/// @param fit  as above.
BodySizes MeasureTrunk(const BodyModel& body, SurfaceFit& fit, const PoseState& pose);

}  // namespace mocap
