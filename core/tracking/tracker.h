// §6: follows a body of known sizes from frame to frame. Fig. 4.
#pragma once

#include <optional>

#include "core/body/body_model.h"
#include "core/tracking/evidence.h"
#include "core/tracking/limb_recovery.h"
#include "core/tracking/pose_filter.h"
#include "core/tracking/surface_fit.h"

namespace mocap {

/// One body with its filter. Thread-bound.
class Tracker {
 public:
  /// Starts with a body at a pose.
  Tracker(const BodyModel& body, const PoseState& pose);

  /// Takes the next frame, `dt_s` after the one before.
  void Update(const Evidence& evidence, double dt_s);

  /// Takes a frame's evidence without drawing the body to it; `evidence` is borrowed until the
  /// next.
  void Look(const Evidence& evidence) { surface_fit_.SetEvidence(evidence); }
  /// Draws the body once more to the evidence of the last frame, as after its sizes have changed.
  void Draw() { FitSurface(); }

  const BodyModel& body() const { return body_; }
  /// Changes the sizes; the pose stays.
  void Resize(const BodySizes& sizes) { body_.Resize(sizes); }
  const PoseFilter& filter() const { return filter_; }
  SurfaceFit& surface_fit() { return surface_fit_; }
  /// How well the body explained the last frame once it was drawn to its surface.
  const SurfaceFitQuality& quality() const { return quality_; }

 private:
  // Goes with the voxels where they went farther than was foreseen, if that explains them better.
  void FollowLeap(const VoxelCloud& cloud, const Vector3& foreseen_W);
  void FollowSurface(const Evidence& evidence, double dt_s);
  void FitSurface();  // And its quality.

  BodyModel body_;
  PoseFilter filter_;
  SurfaceFit surface_fit_;
  LimbRecovery limb_recovery_;
  std::optional<Vector3> middle_W_;  ///< Of the voxels of the frame before.
  SurfaceFitQuality quality_;
};

}  // namespace mocap
