// Beyond the paper: after the 23 points have brought the model near, the surface of the voxels
// draws it the rest of the way, as articulated ICP does (Corazza et al. 2010; Horaud et al. 2009),
// in the same filter and against the same prior.
#pragma once

#include <vector>

#include "core/body/body_model.h"
#include "core/body/body_shape.h"
#include "core/tracking/pose_filter.h"
#include "core/tracking/voxel_cloud.h"

namespace mocap {

struct SurfaceFitOptions {
  int samples = 500;          ///< Surface voxels used, spread evenly.
  double reach_mm = 150;      ///< Voxels farther from the model than this do not count.
  double noise_mm = 25;       ///< Spread of the surface about the model.
  double outlier_mm = 45;     ///< Residuals beyond this lose weight quickly.
  double independent = 0.3;  ///< Share of the samples that are news: neighbours err alike.
};

/// How well a posed body explains the voxels.
struct SurfaceFitQuality {
  double surface_mm = 0;  ///< Mean distance of the surface to the model, each cut at the reach.
  double hollow_mm =
      0;  ///< Mean distance of the model's bones to the voxels, each cut at the reach.
  double unexplained_share = 0;  ///< Of the surface that lies far from every part.
  double overlap_mm = 0;         ///< Mean depth to which limbs stick in other parts.
  double Cost() const { return surface_mm + hollow_mm + overlap_mm; }
};

/// One surface voxel against the model.
struct SurfaceResidual {
  int capsule;       ///< Of ShapeOf(body).
  double share;      ///< Along its core.
  Vector3 normal_W;  ///< From the core to the voxel.
  double outside_mm;
  double variance;             ///< [mm²], larger for outliers.
  PoseStep J_outside_by_step;  ///< How far the core follows along the normal.
};

/// Draws a body's capsules to the surface of the voxels, and its bones out of the void.
class SurfaceFit {
 public:
  explicit SurfaceFit(const SurfaceFitOptions& options) : options_(options) {}

  /// Widens or narrows what counts as the model's neighbourhood.
  void SetReach(double reach_mm, double outlier_mm) {
    options_.reach_mm = reach_mm;
    options_.outlier_mm = outlier_mm;
  }
  /// Chooses the samples of a new frame.
  void SetVoxels(const VoxelCloud& cloud);
  /// Adds the linearised residuals at a pose; for PoseFilter::Update.
  void Linearize(const BodyModel& body, const PoseState& pose, UpdateEquations& equations);
  SurfaceFitQuality QualityAt(const BodyModel& body, const PoseState& pose);
  /// Surface voxels that no part came near when the quality was last measured [mm].
  const std::vector<Vector3>& unexplained_W() const { return unexplained_W_; }
  /// The residuals of the frame's samples, without those that no part comes near.
  std::vector<SurfaceResidual> ResidualsAt(const BodyModel& body, const PoseState& pose);

 private:
  struct Sample {
    Vector3 p_W;
    Vector3 normal_W;
  };
  struct Match {
    int capsule = -1;
    PosedCapsule::Distance distance{};
  };
  void PoseCapsules(const BodyModel& body, const PoseState& pose);
  Match BestMatch(const Sample& sample) const;
  template <typename Visit>
  void ForEachResidual(const BodyModel& body, const Visit& visit) const;
  const Sample* NearestSample(const Vector3& p_W) const;
  template <typename Visit>
  void ForEachHollow(const BodyModel& body, const Visit& visit) const;

  template <typename Visit>
  void ForEachOverlap(const BodyModel& body, const Visit& visit) const;

  SurfaceFitOptions options_;
  const VoxelCloud* cloud_ = nullptr;
  std::vector<Sample> samples_;
  Posture posture_;
  std::vector<PosedCapsule> posed_;
  std::vector<Vector3> unexplained_W_;
};

}  // namespace mocap
