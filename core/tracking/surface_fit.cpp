#include "core/tracking/surface_fit.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/tracking/flesh_rules.h"

namespace mocap {
namespace {

// The weight of Geman and McClure, as a factor of the variance.
double Inflation(double residual, double outlier) {
  const double scaled = residual / outlier;
  return (1 + scaled * scaled) * (1 + scaled * scaled);
}

// Only the toes of a foot are held: with heels, the error of feet on steps was 60 mm instead of 25.
// The elbow belongs to the upper arm, the wrist to the forearm.
bool IsHeldByBorders(const Capsule& capsule, double share) {
  switch (capsule.part) {
    case BodyPart::kCalfL:
    case BodyPart::kCalfR:
      return !capsule.ends_at_b || share == 1;
    case BodyPart::kLowerArmL:
    case BodyPart::kLowerArmR:
      return share > 0;
    default:
      return true;
  }
}

// Change of a tapered capsule's surface as the core slides along itself.
Vector3 LeanOf(const PosedCapsule& capsule, double share) {
  if (share <= 0 || share >= 1) return Vector3::Zero();
  const Vector3 core_W = capsule.b_W - capsule.a_W;
  return (capsule.radius_b_mm - capsule.radius_a_mm) / core_W.squaredNorm() * core_W;
}

}  // namespace

void SurfaceFit::SetEvidence(const Evidence& evidence) {
  evidence_ = &evidence;
  missing_share_ = evidence.MissingShare();
  ChooseContacts(evidence, options_.voxels, options_.edges, contacts_);
  matcher_.SetContacts(contacts_);
  borders_.resize(evidence.borders.size());
  for (std::size_t i = 0; i < borders_.size(); ++i) borders_[i].SetOutline(evidence.borders[i]);
}

void SurfaceFit::PoseCapsules(const BodyModel& body, const PoseState& pose) {
  posture_ = body.PostureAt(pose);
  body.PoseShape(posture_, posed_);
}

template <typename Visit>
void SurfaceFit::ForEachContact(const Visit& visit) {
  SurfaceResidual residual;
  const double variance = options_.noise_mm * options_.noise_mm / options_.independent;
  const std::vector<ContactMatch>& matches = matcher_.Match(posed_, options_.reach_mm);
  for (std::size_t i = 0; i < matches.size(); ++i) {
    const ContactMatch& match = matches[i];
    if (match.capsule < 0) continue;
    const Vector3 offset = match.distance.segment_W - match.distance.core_W;
    const double length = offset.norm();
    if (length < 1) continue;
    residual.capsule = match.capsule;
    residual.kind = matcher_.contacts()[i].is_edge ? ResidualKind::kRay : ResidualKind::kSurface;
    residual.share = match.distance.share;
    residual.p_W = match.distance.segment_W;
    residual.normal_W = offset / length - LeanOf(posed_[match.capsule], residual.share);
    residual.outside_mm = match.distance.outside_mm;
    residual.variance = variance * Inflation(residual.outside_mm, options_.outlier_mm);
    visit(residual);
  }
}

template <typename Visit>
void SurfaceFit::ForEachProtrusion(const BodyModel& body, const Visit& visit) const {
  SurfaceResidual residual;
  residual.kind = ResidualKind::kBorder;
  for (std::size_t i = 0; i < posed_.size(); ++i) {
    residual.capsule = static_cast<int>(i);
    for (const double share : kCoreShares) {
      if (!IsHeldByBorders(body.shape()[i], share)) continue;
      residual.share = share;
      residual.p_W = CorePlace(posed_[i], share);
      for (const SilhouetteBorder& border : borders_) {
        const auto protrusion = border.ProtrusionOf(residual.p_W, RadiusAt(posed_[i], share));
        if (!protrusion) continue;
        residual.normal_W = protrusion->outward_W;
        residual.outside_mm = -protrusion->depth_mm;
        residual.variance = options_.border_noise_mm * options_.border_noise_mm *
                            Inflation(protrusion->depth_mm, options_.outlier_mm);
        visit(residual);
      }
    }
  }
}

template <typename Visit>
void SurfaceFit::ForEachResidual(const BodyModel& body, const Visit& visit) {
  ForEachContact(visit);
  ForEachProtrusion(body, visit);
}

template <typename Visit>
void SurfaceFit::ForEachHollow(const Visit& visit) const {
  const std::uint32_t carved_away = matcher_.CarvedAway();
  for (std::size_t i = 0; i < posed_.size(); ++i) {
    if (carved_away >> i & 1) continue;
    for (const double share : kCoreShares) {
      const Vector3 p_W = CorePlace(posed_[i], share);
      if (const auto way_W = WayToFlesh(evidence_->cloud, matcher_.surface_W(), p_W))
        visit(i, p_W, *way_W);
    }
  }
}

template <typename Visit>
void SurfaceFit::ForEachOverlap(const BodyModel& body, const Visit& visit) const {
  for (std::size_t i = 0; i < posed_.size(); ++i) {
    for (std::size_t j = 0; j < posed_.size(); ++j) {
      if (!MayOverlap(body.shape()[i].part, body.shape()[j].part)) continue;
      for (const double share : kCoreShares) {
        const Vector3 p_W = CorePlace(posed_[i], share);
        if (!CanStickIn(posed_[i], p_W, posed_[j])) continue;
        const PosedCapsule::Distance distance = posed_[j].DistanceTo(p_W);
        const double depth_mm = OverlapDepth(posed_[i], posed_[j], distance);
        if (depth_mm > 0) visit(i, p_W, j, distance.core_W, depth_mm);
      }
    }
  }
}

const std::vector<SurfaceResidual>& SurfaceFit::ResidualsAt(const BodyModel& body,
                                                            const PoseState& pose) {
  PoseCapsules(body, pose);
  residuals_.clear();
  ForEachResidual(body, [&](const SurfaceResidual& residual) { residuals_.push_back(residual); });
  for (SurfaceResidual& residual : residuals_) {
    // Equivalent to a moving contact with a fixed body.
    body.DirectionalJacobian(posture_, body.shape()[residual.capsule].carrier, residual.p_W,
                             residual.normal_W, residual.J_outside_by_step);
  }
  return residuals_;
}

void SurfaceFit::Linearize(const BodyModel& body, const PoseState& pose,
                           UpdateEquations& equations) {
  PoseCapsules(body, pose);
  chain_.Reset(body.table(), posture_);
  ForEachResidual(body, [&](const SurfaceResidual& residual) {
    chain_.Add(body.shape()[residual.capsule].carrier, residual.p_W, residual.normal_W,
               residual.outside_mm, residual.variance);
  });
  const double void_variance = options_.void_noise_mm * options_.void_noise_mm;
  ForEachHollow([&](std::size_t i, const Vector3& p_W, const Vector3& way_W) {
    if (way_W.norm() > 2 * options_.reach_mm) return;
    chain_.AddPoint(body.shape()[i].carrier, p_W, way_W,
                    void_variance * Inflation(way_W.norm(), options_.void_outlier_mm));
  });
  chain_.AddTo(equations);
  PoseStep J_limb(body.dof());
  PoseStep J_other(body.dof());
  ForEachOverlap(body, [&](std::size_t i, const Vector3& p_W, std::size_t j, const Vector3& core_W,
                           double depth_mm) {
    const Vector3 offset = p_W - core_W;
    if (offset.norm() < 1) return;
    const Vector3 out_W = offset.normalized();
    body.DirectionalJacobian(posture_, body.shape()[i].carrier, p_W, out_W, J_limb);
    body.DirectionalJacobian(posture_, body.shape()[j].carrier, core_W, out_W, J_other);
    equations.Add(J_limb - J_other, depth_mm, options_.noise_mm * options_.noise_mm);
  });
}

void SurfaceFit::MeasureContacts(const BodyModel& body, SurfaceFitQuality& quality) {
  std::optional<ThingPlaces> places;
  if (allowed_.any()) places.emplace(body, posture_, allowed_);
  std::array<double, kThingCount> edges_saved_mm{}, surface_saved_mm{};
  int edges = 0;
  const std::vector<float>& distances_mm = matcher_.Distances(posed_, options_.reach_mm);
  for (std::size_t i = 0; i < distances_mm.size(); ++i) {
    const bool is_edge = matcher_.contacts()[i].is_edge;
    const double distance_mm = std::min<double>(distances_mm[i], kExplainedMm);
    (is_edge ? quality.edge_mm : quality.surface_mm) += distance_mm;
    edges += is_edge;
    quality.unexplained_share += is_edge && distance_mm >= kExplainedMm;
    if (!places || distance_mm <= kOfThingMm) continue;
    if (const auto thing = places->At(matcher_.contacts()[i])) {
      (is_edge ? edges_saved_mm : surface_saved_mm)[static_cast<int>(*thing)] +=
          distance_mm - kOfThingMm;
    }
  }
  const int voxels = static_cast<int>(distances_mm.size()) - edges;
  quality.edge_mm /= std::max(1, edges);
  quality.unexplained_share /= std::max(1, edges);
  quality.surface_mm /= std::max(1, voxels);
  for (int i = 0; i < kThingCount; ++i) {
    const double edge_mm = edges_saved_mm[i] / std::max(1, edges);
    const double surface_mm = surface_saved_mm[i] / std::max(1, voxels);
    if (edge_mm + kSurfaceWeight * surface_mm <= kWornMm) continue;
    quality.things.set(i);
    quality.edge_mm -= edge_mm;
    quality.surface_mm -= surface_mm;
  }
  // Without outlines, the hull's surface has to say what they would.
  if (edges == 0) quality.edge_mm = quality.surface_mm;
}

SurfaceFitQuality SurfaceFit::QualityAt(const BodyModel& body, const PoseState& pose) {
  PoseCapsules(body, pose);
  SurfaceFitQuality quality;
  quality.missing_share = missing_share_;
  MeasureContacts(body, quality);
  const double places = static_cast<double>(posed_.size() * kCoreShares.size());
  ForEachHollow([&](std::size_t, const Vector3&, const Vector3& way_W) {
    quality.hollow_mm += std::min(kMostHollowMm, way_W.norm()) / places;
  });
  ForEachOverlap(body, [&](std::size_t, const Vector3&, std::size_t, const Vector3&,
                           double depth_mm) { quality.overlap_mm += depth_mm / places; });
  return quality;
}

}  // namespace mocap
