#include "core/tracking/surface_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mocap {
namespace {

using JacobianBlock = Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::ColMajor, 3, kMaxDof>;

// Places along each core that should lie in flesh.
constexpr double kUnexplainedMm = 80;
constexpr std::array<double, 3> kCoreShares = {0.0, 0.5, 1.0};

bool IsLowerArm(BodyPart part) {
  return part == BodyPart::kLowerArmL || part == BodyPart::kLowerArmR;
}
bool IsCalf(BodyPart part) { return part == BodyPart::kCalfL || part == BodyPart::kCalfR; }

// Whether a limb's end can run into a part at all: forearms into trunk, head and thighs, a calf
// into the other leg.
bool MayOverlap(BodyPart limb, BodyPart other) {
  if (limb == other) return false;
  const bool thigh = other == BodyPart::kThighL || other == BodyPart::kThighR;
  if (IsLowerArm(limb)) {
    return other == BodyPart::kTorso || other == BodyPart::kHead || thigh || IsLowerArm(other);
  }
  const BodyPart own_thigh = limb == BodyPart::kCalfL ? BodyPart::kThighL : BodyPart::kThighR;
  return IsCalf(limb) && (IsCalf(other) || (thigh && other != own_thigh));
}

}  // namespace

void SurfaceFit::SetVoxels(const VoxelCloud& cloud) {
  cloud_ = &cloud;
  samples_.clear();
  const std::size_t available = cloud.surface().size();
  const std::size_t wanted = std::min<std::size_t>(available, options_.samples);
  for (std::size_t i = 0; i < wanted; ++i) {
    const Voxel& voxel = cloud.voxels()[cloud.surface()[i * available / wanted]];
    samples_.push_back({voxel.center_W, voxel.normal_W});
  }
}

void SurfaceFit::PoseCapsules(const BodyModel& body, const PoseState& pose) {
  posture_ = body.PostureAt(pose);
  body.PoseShape(posture_, posed_);
}

SurfaceFit::Match SurfaceFit::BestMatch(const Sample& sample) const {
  Match best;
  double best_distance = options_.reach_mm;
  for (int i = 0; i < static_cast<int>(posed_.size()); ++i) {
    const PosedCapsule::Distance distance = posed_[i].DistanceTo(sample.p_W);
    // A voxel on the inside of the left leg is no evidence for the right one.
    const bool faces_away = sample.normal_W.dot(sample.p_W - distance.core_W) < 0;
    const double cost = std::abs(distance.outside_mm) + (faces_away ? 60.0 : 0.0);
    if (cost >= best_distance) continue;
    best_distance = cost;
    best = {i, distance};
  }
  return best;
}

const SurfaceFit::Sample* SurfaceFit::NearestSample(const Vector3& p_W) const {
  const Sample* nearest = nullptr;
  double nearest_sq = std::numeric_limits<double>::infinity();
  for (const Sample& sample : samples_) {
    const double distance_sq = (sample.p_W - p_W).squaredNorm();
    if (distance_sq >= nearest_sq) continue;
    nearest_sq = distance_sq;
    nearest = &sample;
  }
  return nearest;
}

template <typename Visit>
void SurfaceFit::ForEachHollow(const BodyModel& body, const Visit& visit) const {
  for (std::size_t i = 0; i < posed_.size(); ++i) {
    for (const double share : kCoreShares) {
      const Vector3 p_W = posed_[i].a_W + share * (posed_[i].b_W - posed_[i].a_W);
      const Sample* nearest = cloud_->IndexAt(p_W) >= 0 ? nullptr : NearestSample(p_W);
      visit(body.shape()[i], p_W, nearest);
    }
  }
}

template <typename Visit>
void SurfaceFit::ForEachOverlap(const BodyModel& body, const Visit& visit) const {
  // Flesh gives way a little, and the capsules are rounder than the parts.
  constexpr double kGives = 0.85;
  for (std::size_t i = 0; i < posed_.size(); ++i) {
    const BodyPart limb = body.shape()[i].part;
    if (!IsLowerArm(limb) && !IsCalf(limb)) continue;
    for (const double share : kCoreShares) {
      const Vector3 p_W = posed_[i].a_W + share * (posed_[i].b_W - posed_[i].a_W);
      for (std::size_t j = 0; j < posed_.size(); ++j) {
        if (!MayOverlap(limb, body.shape()[j].part)) continue;
        const PosedCapsule::Distance distance = posed_[j].DistanceTo(p_W);
        const double radius = posed_[i].radius_a_mm;
        const double depth_mm = kGives * radius - distance.outside_mm - (1 - kGives) * radius;
        if (depth_mm > 0) visit(body.shape()[i], p_W, body.shape()[j], distance, depth_mm);
      }
    }
  }
}

template <typename Visit>
void SurfaceFit::ForEachResidual(const BodyModel& body, const Visit& visit) const {
  JacobianBlock J(3, body.dof());
  SurfaceResidual residual;
  const double variance = options_.noise_mm * options_.noise_mm / options_.independent;
  for (const Sample& sample : samples_) {
    const Match match = BestMatch(sample);
    if (match.capsule < 0) continue;
    const Vector3 offset = sample.p_W - match.distance.core_W;
    const double length = offset.norm();
    if (length < 1) continue;
    const double scaled = match.distance.outside_mm / options_.outlier_mm;
    residual.capsule = match.capsule;
    residual.share = match.distance.share;
    residual.normal_W = offset / length;
    residual.outside_mm = match.distance.outside_mm;
    residual.variance = variance * (1 + scaled * scaled) * (1 + scaled * scaled);
    body.PointJacobian(posture_, body.shape()[match.capsule].carrier, match.distance.core_W, J);
    residual.J_outside_by_step = J.transpose() * residual.normal_W;
    visit(residual);
  }
}

std::vector<SurfaceResidual> SurfaceFit::ResidualsAt(const BodyModel& body, const PoseState& pose) {
  PoseCapsules(body, pose);
  std::vector<SurfaceResidual> residuals;
  ForEachResidual(body, [&](const SurfaceResidual& residual) { residuals.push_back(residual); });
  return residuals;
}

void SurfaceFit::Linearize(const BodyModel& body, const PoseState& pose,
                           UpdateEquations& equations) {
  PoseCapsules(body, pose);
  ForEachResidual(body, [&](const SurfaceResidual& residual) {
    equations.Add(residual.J_outside_by_step.transpose(), residual.outside_mm, residual.variance);
  });
  JacobianBlock J(3, body.dof());
  ForEachHollow(body, [&](const Capsule& capsule, const Vector3& p_W, const Sample* nearest) {
    if (nearest == nullptr) return;
    const Vector3 pull = nearest->p_W - p_W;
    if (pull.norm() > 2 * options_.reach_mm) return;
    body.PointJacobian(posture_, capsule.carrier, p_W, J);
    equations.AddPoint(J, pull, 4 * options_.noise_mm * options_.noise_mm);
  });
  JacobianBlock J_other(3, body.dof());
  ForEachOverlap(body, [&](const Capsule& limb, const Vector3& p_W, const Capsule& other,
                           const PosedCapsule::Distance& distance, double depth_mm) {
    const Vector3 offset = p_W - distance.core_W;
    if (offset.norm() < 1) return;
    body.PointJacobian(posture_, limb.carrier, p_W, J);
    body.PointJacobian(posture_, other.carrier, distance.core_W, J_other);
    equations.Add(offset.normalized().transpose() * (J - J_other), depth_mm,
                  options_.noise_mm * options_.noise_mm);
  });
}

SurfaceFitQuality SurfaceFit::QualityAt(const BodyModel& body, const PoseState& pose) {
  PoseCapsules(body, pose);
  unexplained_W_.clear();
  SurfaceFitQuality quality;
  for (const Sample& sample : samples_) {
    const Match match = BestMatch(sample);
    const double distance_mm =
        match.capsule < 0 ? options_.reach_mm : std::abs(match.distance.outside_mm);
    quality.surface_mm += distance_mm;
    if (distance_mm > kUnexplainedMm) unexplained_W_.push_back(sample.p_W);
  }
  const double count = static_cast<double>(std::max<std::size_t>(1, samples_.size()));
  quality.surface_mm /= count;
  quality.unexplained_share = static_cast<double>(unexplained_W_.size()) / count;
  int places = 0;
  ForEachHollow(body, [&](const Capsule&, const Vector3& p_W, const Sample* nearest) {
    ++places;
    if (nearest != nullptr) {
      quality.hollow_mm += std::min(options_.reach_mm, (nearest->p_W - p_W).norm());
    }
  });
  quality.hollow_mm /= std::max(1, places);
  ForEachOverlap(body,
                 [&](const Capsule&, const Vector3&, const Capsule&, const PosedCapsule::Distance&,
                     double depth_mm) { quality.overlap_mm += depth_mm; });
  quality.overlap_mm /= std::max(1, places);
  return quality;
}

}  // namespace mocap
