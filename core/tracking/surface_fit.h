// Beyond the paper: fits the model's surface, and not only 23 points, to the person, as articulated
// ICP does (Corazza et al. 2010; Horaud et al. 2009). Outlines have the largest weight: a visual
// hull is larger than the person and has ghost limbs, but the outlines' rays graze only the person
// (Cheung, Baker and Kanade 2003; Gall et al. 2009).
#pragma once

#include <vector>

#include "core/body/body_model.h"
#include "core/body/body_shape.h"
#include "core/tracking/carried_things.h"
#include "core/tracking/chain_equations.h"
#include "core/tracking/contact_matcher.h"
#include "core/tracking/evidence.h"
#include "core/tracking/flesh_rules.h"
#include "core/tracking/pose_filter.h"
#include "core/tracking/protrusion.h"

namespace mocap {

struct SurfaceFitOptions {
  int voxels = 250;             ///< Surface voxels used, spread evenly.
  int edges = 600;              ///< Bounding edges used, spread evenly.
  double reach_mm = 150;        ///< Evidence farther from the model than this is ignored.
  double noise_mm = 23;         ///< Spread of the surface about the model.
  double outlier_mm = 45;       ///< Residuals beyond this lose weight quickly.
  double independent = 0.3;     ///< Share of independent contacts: errors of neighbours are alike.
  double border_noise_mm = 40;  ///< Spread of flesh beyond the silhouettes' borders.
  double void_noise_mm = 50;    ///< Spread of bones about the flesh.
  double void_outlier_mm = 60;
};

/// Quality of the fit of a posed body. Distances are cut at kExplainedMm, so that evidence of
/// something else has the same weight everywhere.
struct SurfaceFitQuality {
  /// Mean distance of the bounding edges to the model; where there are none, that of the surface.
  double edge_mm = 0;
  double surface_mm = 0;         ///< Mean distance of the voxels' surface to the model.
  double hollow_mm = 0;          ///< Mean distance of the model's bones to the voxels.
  double overlap_mm = 0;         ///< Mean depth of limbs inside other parts.
  double unexplained_share = 0;  ///< Share of the edges that belong to no part.
  double missing_share = 0;      ///< Of the evidence; see Evidence::MissingShare.
  Things things;                 ///< Those that the evidence shows.

  double Cost() const {
    return edge_mm + kSurfaceWeight * surface_mm + HollowWeight(missing_share) * hollow_mm +
           overlap_mm + kWornMm * static_cast<double>(things.count());
  }
  /// Cost for the decision whether somebody is there at all. Edges that miss the hull may be of
  /// stray blobs, which no pose explains: half of them are allowed for. Costs of poses are compared
  /// without this.
  double CostWithoutStray() const { return Cost() - 0.5 * missing_share * kExplainedMm; }
};

/// What a residual comes from: a voxel of the surface, a ray that grazes the person, or flesh
/// beyond a silhouette's border.
enum class ResidualKind { kSurface, kRay, kBorder };

/// One contact compared with the model.
struct SurfaceResidual {
  int capsule;  ///< Index into the body's shape().
  ResidualKind kind;
  double share;  ///< Position along its core.
  Vector3 p_W;   ///< Target point of the capsule.
  Vector3
      normal_W;  ///< Out of the surface; where the capsule tapers it leans and is longer than 1.
  double outside_mm;
  double variance;             ///< [mm²], larger for outliers.
  PoseStep J_outside_by_step;  ///< Derivative of the core's position along the normal.
};

/// Fits a body's capsules to the contacts of their surface, and its bones to the flesh.
class SurfaceFit {
 public:
  explicit SurfaceFit(const SurfaceFitOptions& options) : options_(options) {}

  /// Selects what the body may wear or carry: flesh there costs less, if that is worth the thing's
  /// own cost. At first nothing.
  void Allow(Things things) { allowed_ = things; }
  Things allowed() const { return allowed_; }

  /// Sets a new frame; `evidence` is borrowed until the next.
  void SetEvidence(const Evidence& evidence);
  /// Adds the linearised residuals at a pose; for PoseFilter::Update.
  void Linearize(const BodyModel& body, const PoseState& pose, UpdateEquations& equations);
  SurfaceFitQuality QualityAt(const BodyModel& body, const PoseState& pose);
  /// Returns the residuals of the frame's contacts, without those that no part is near; valid until
  /// the next call.
  const std::vector<SurfaceResidual>& ResidualsAt(const BodyModel& body, const PoseState& pose);

 private:
  void PoseCapsules(const BodyModel& body, const PoseState& pose);
  // The mean distances of the contacts.
  void MeasureContacts(const BodyModel& body, SurfaceFitQuality& quality);
  template <typename Visit>
  void ForEachResidual(const BodyModel& body, const Visit& visit);
  template <typename Visit>
  void ForEachContact(const Visit& visit);
  // A ray is satisfied by the part that explains it best, whatever else extends over it. A ray
  // across a protruding hand cuts into the hand and does not show the direction back. The border
  // nearest to each part does.
  template <typename Visit>
  void ForEachProtrusion(const BodyModel& body, const Visit& visit) const;
  template <typename Visit>
  void ForEachHollow(const Visit& visit) const;
  template <typename Visit>
  void ForEachOverlap(const BodyModel& body, const Visit& visit) const;

  SurfaceFitOptions options_;
  Things allowed_;
  const Evidence* evidence_ = nullptr;
  double missing_share_ = 0;
  std::vector<Contact> contacts_;
  ContactMatcher matcher_;
  std::vector<SilhouetteBorder> borders_;  ///< One per camera.
  Posture posture_;
  std::vector<PosedCapsule> posed_;
  ChainEquations chain_;
  std::vector<SurfaceResidual> residuals_;
};

}  // namespace mocap
