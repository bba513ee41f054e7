// Replaces §6 and Fig. 4: tracks a body of known sizes from frame to frame.
#pragma once

#include <optional>

#include "core/body/body_model.h"
#include "core/tracking/evidence.h"
#include "core/tracking/limb_recovery.h"
#include "core/tracking/pose_filter.h"
#include "core/tracking/rival_pose.h"
#include "core/tracking/surface_fit.h"

namespace mocap {

/// One body with its filter. Thread-bound.
class Tracker {
 public:
  /// Starts with a body at a pose.
  Tracker(const BodyModel& body, const PoseState& pose);

  /// Processes the next frame, `dt_s` after the previous one.
  void Update(const Evidence& evidence, double dt_s);

  /// Sets a frame's evidence without fitting the body; `evidence` is borrowed until the next.
  void Look(const Evidence& evidence) { surface_fit_.SetEvidence(evidence); }
  /// Fits the body once more to the evidence of the last frame, for example after a change of
  /// sizes.
  void Draw() { FitSurface(); }

  const BodyModel& body() const { return body_; }
  /// Changes the sizes; the pose stays.
  void Resize(const BodySizes& sizes) { body_.Resize(sizes); }
  const PoseFilter& filter() const { return filter_; }
  /// Selects what the body may wear or carry, as for SurfaceFit. What a frame does not show is put
  /// down for good.
  void Allow(Things things) { surface_fit_.Allow(things); }
  SurfaceFit& surface_fit() { return surface_fit_; }
  /// Quality of the fit in the last frame.
  const SurfaceFitQuality& quality() const { return quality_; }
  /// What the body wears and carries.
  Things things() const { return surface_fit_.allowed(); }

 private:
  // Moves the body with the voxels if they moved farther than predicted and that explains them
  // better.
  void FollowLeap(const VoxelCloud& cloud, const Vector3& foreseen_W);
  void FollowSurface(const Evidence& evidence, double dt_s);
  void FollowRival(double dt_s);
  void FitSurface();  // Also measures the quality.

  BodyModel body_;
  PoseFilter filter_;
  SurfaceFit surface_fit_;
  LimbRecovery limb_recovery_;
  std::optional<RivalPose> rival_;
  std::optional<Vector3> middle_W_;  ///< Of the voxels of the previous frame.
  SurfaceFitQuality quality_;
};

}  // namespace mocap
