// Beyond the paper: the body's surface, and not only 23 points, draws the model to the person, as
// articulated ICP does (Corazza et al. 2010; Horaud et al. 2009). The outlines count most: a visual
// hull is fatter than the person and has ghost limbs, but the rays of the outlines graze the person
// and nothing else (Cheung, Baker and Kanade 2003; Gall et al. 2009).
#pragma once

#include <vector>

#include "core/body/body_model.h"
#include "core/body/body_shape.h"
#include "core/tracking/chain_equations.h"
#include "core/tracking/contact_matcher.h"
#include "core/tracking/evidence.h"
#include "core/tracking/pose_filter.h"
#include "core/tracking/protrusion.h"

namespace mocap {

struct SurfaceFitOptions {
  int voxels = 250;             ///< Surface voxels used, spread evenly.
  int edges = 600;              ///< Bounding edges used, spread evenly.
  double reach_mm = 150;        ///< What is farther from the model than this does not count.
  double noise_mm = 23;         ///< Spread of the surface about the model.
  double outlier_mm = 45;       ///< Residuals beyond this lose weight quickly.
  double independent = 0.3;     ///< Share of the contacts that are news: neighbours err alike.
  double border_noise_mm = 40;  ///< Spread of flesh beyond the silhouettes' borders.
  double void_noise_mm = 50;    ///< Spread of bones about the flesh.
  double void_outlier_mm = 60;
};

/// Evidence farther than this from every part belongs to none: hair, a bag, a chair, a shadow.
inline constexpr double kExplainedMm = 60;

/// How well a posed body explains the evidence. Distances are cut at kExplainedMm, so that what
/// belongs to something else weighs the same wherever it is.
struct SurfaceFitQuality {
  double edge_mm = 0;            ///< Mean distance of the bounding edges to the model.
  double surface_mm = 0;         ///< Mean distance of the voxels' surface to the model.
  double hollow_mm = 0;          ///< Mean distance of the model's bones to the voxels.
  double overlap_mm = 0;         ///< Mean depth to which limbs stick in other parts.
  double unexplained_share = 0;  ///< Of the edges: what is no part's.

  /// Weighs the edges most, because hulls lie about surfaces, and fast limbs are carved away.
  double Cost() const { return edge_mm + 0.25 * surface_mm + 0.5 * hollow_mm + overlap_mm; }
};

/// One contact against the model.
struct SurfaceResidual {
  int capsule;   ///< Of the body's shape().
  bool is_edge;  ///< Of an outline and not of a voxel.
  double share;  ///< Along its core.
  Vector3 p_W;   ///< Where the capsule is drawn to.
  Vector3
      normal_W;  ///< Out of the surface; where the capsule tapers it leans and is longer than 1.
  double outside_mm;
  double variance;             ///< [mm²], larger for outliers.
  PoseStep J_outside_by_step;  ///< How far the core follows along the normal.
};

/// Draws a body's capsules to what their surface should touch, and its bones out of the void.
class SurfaceFit {
 public:
  explicit SurfaceFit(const SurfaceFitOptions& options) : options_(options) {}

  /// Takes a new frame; `evidence` is borrowed until the next.
  void SetEvidence(const Evidence& evidence);
  /// Adds the linearised residuals at a pose; for PoseFilter::Update.
  void Linearize(const BodyModel& body, const PoseState& pose, UpdateEquations& equations);
  SurfaceFitQuality QualityAt(const BodyModel& body, const PoseState& pose);
  /// The residuals of the frame's contacts, without those that no part comes near; valid until the
  /// next call.
  const std::vector<SurfaceResidual>& ResidualsAt(const BodyModel& body, const PoseState& pose);

 private:
  void PoseCapsules(const BodyModel& body, const PoseState& pose);
  template <typename Visit>
  void ForEachResidual(const BodyModel& body, const Visit& visit);
  template <typename Visit>
  void ForEachContact(const Visit& visit);
  // A ray is content with the part that explains it best, whatever else reaches over it; and one
  // across a hand that sticks out cuts into it, and does not say which way to draw it back. The
  // border that is nearest to each part does.
  template <typename Visit>
  void ForEachProtrusion(const BodyModel& body, const Visit& visit) const;
  template <typename Visit>
  void ForEachHollow(const Visit& visit) const;
  template <typename Visit>
  void ForEachOverlap(const BodyModel& body, const Visit& visit) const;

  SurfaceFitOptions options_;
  const Evidence* evidence_ = nullptr;
  std::vector<Contact> contacts_;
  ContactMatcher matcher_;
  std::vector<SilhouetteBorder> borders_;  ///< One a camera.
  Posture posture_;
  std::vector<PosedCapsule> posed_;
  ChainEquations chain_;
  std::vector<SurfaceResidual> residuals_;
};

}  // namespace mocap
