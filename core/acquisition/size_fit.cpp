#include "core/acquisition/size_fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/acquisition/size_jacobian.h"

namespace mocap {
namespace {

constexpr std::array<SizeMember, 8> kFitted = {
    &BodySizes::torso,     &BodySizes::thigh,          &BodySizes::calf,      &BodySizes::upper_arm,
    &BodySizes::lower_arm, &BodySizes::shoulder_width, &BodySizes::hip_width, &BodySizes::neck};
constexpr int kLengthCount = 5;
constexpr int kFittedCount = static_cast<int>(kFitted.size());
constexpr int kIterations = 3;
constexpr double kPoseSpreadMm = 60;
constexpr double kPoseSpreadRad = 0.3;
// Fewer contacts tell nothing of a part's thickness; so much it may change at once.
constexpr std::size_t kEnoughContacts = 8;
constexpr double kThinner = 0.75;
constexpr double kThicker = 1.35;

struct Unknowns {
  PoseState pose;
  BodySizes sizes;
};

// One Gauss-Newton step over pose and sizes.
void Improve(const BodyModel& start, SurfaceFit& fit, const Unknowns& prior,
             const SizeSpread& spread, Unknowns& now) {
  BodyModel body = start;
  body.Resize(now.sizes);
  const std::vector<SurfaceResidual>& residuals = fit.ResidualsAt(body, now.pose);
  SizeJacobian by_size(body, kFitted);
  by_size.Update(body, now.pose);
  const int pose_dof = body.dof();
  const int n = pose_dof + kFittedCount;
  Eigen::MatrixXd rows(n, residuals.size());
  Eigen::VectorXd outside(residuals.size());
  for (Eigen::Index k = 0; k < outside.size(); ++k) {
    const SurfaceResidual& residual = residuals[k];
    rows.col(k).head(pose_dof) = residual.J_outside_by_step;
    for (int i = 0; i < kFittedCount; ++i) {
      rows(pose_dof + i, k) = by_size.OutwardBySize(residual, i);
    }
    const double weight = 1 / std::sqrt(residual.variance);
    rows.col(k) *= weight;
    outside[k] = weight * residual.outside_mm;
  }
  Eigen::MatrixXd information = rows * rows.transpose();
  Eigen::VectorXd gradient = rows * outside;
  const PoseStep step_from_prior = now.pose.Minus(prior.pose);
  for (int i = 0; i < n; ++i) {
    const double std = i < 3                         ? kPoseSpreadMm
                       : i < pose_dof                ? kPoseSpreadRad
                       : i < pose_dof + kLengthCount ? spread.length_mm
                                                     : spread.width_mm;
    const double away = i < pose_dof
                            ? step_from_prior[i]
                            : now.sizes.*kFitted[i - pose_dof] - prior.sizes.*kFitted[i - pose_dof];
    information(i, i) += 1 / (std * std);
    gradient[i] -= away / (std * std);
  }
  const Eigen::VectorXd step = information.llt().solve(gradient);
  now.pose.Add(step.head(pose_dof));
  for (int i = 0; i < kFittedCount; ++i) now.sizes.*kFitted[i] += step[pose_dof + i];
}

double Median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

void MeasureThickness(const BodyModel& start, SurfaceFit& fit, Unknowns& now) {
  BodyModel body = start;
  body.Resize(now.sizes);
  std::array<std::vector<double>, kBodyPartCount> outside_mm;
  for (const SurfaceResidual& residual : fit.ResidualsAt(body, now.pose)) {
    outside_mm[static_cast<int>(body.shape()[residual.capsule].part)].push_back(
        residual.outside_mm);
  }
  const auto thicken = [&](SizeMember width, BodyPart left, BodyPart right) {
    std::vector<double> both = outside_mm[static_cast<int>(left)];
    if (right != left) {
      const std::vector<double>& other = outside_mm[static_cast<int>(right)];
      both.insert(both.end(), other.begin(), other.end());
    }
    if (both.size() < kEnoughContacts) return;
    double& size = now.sizes.*width;
    size = std::clamp(size + 2 * Median(both), kThinner * size, kThicker * size);
  };
  const double depth_before = now.sizes.torso_depth;
  thicken(&BodySizes::torso_depth, BodyPart::kTorso, BodyPart::kTorso);
  now.sizes.torso_width += now.sizes.torso_depth - depth_before;
  thicken(&BodySizes::head_width, BodyPart::kHead, BodyPart::kHead);
  thicken(&BodySizes::upper_arm_width, BodyPart::kUpperArmL, BodyPart::kUpperArmR);
  thicken(&BodySizes::lower_arm_width, BodyPart::kLowerArmL, BodyPart::kLowerArmR);
  thicken(&BodySizes::thigh_width, BodyPart::kThighL, BodyPart::kThighR);
  thicken(&BodySizes::calf_width, BodyPart::kCalfL, BodyPart::kCalfR);
}

}  // namespace

BodySizes MeasureSizes(const BodyModel& body, SurfaceFit& fit, const PoseState& pose,
                       const SizeSpread& spread) {
  const Unknowns prior{pose, body.sizes()};
  Unknowns now = prior;
  for (int i = 0; i < kIterations; ++i) Improve(body, fit, prior, spread, now);
  MeasureThickness(body, fit, now);
  return now.sizes;
}

BodySizes MeasureTrunk(const BodyModel& body, SurfaceFit& fit, const PoseState& pose) {
  std::vector<double> outside_mm;
  for (const SurfaceResidual& residual : fit.ResidualsAt(body, pose)) {
    if (body.shape()[residual.capsule].part == BodyPart::kTorso) {
      outside_mm.push_back(residual.outside_mm);
    }
  }
  BodySizes sizes = body.sizes();
  if (outside_mm.size() < kEnoughContacts) return sizes;
  const double thicker = sizes.torso_depth * std::clamp(Median(outside_mm) / sizes.torso_depth,
                                                        kThinner - 1, kThicker - 1);
  sizes.torso_depth += thicker;
  sizes.torso_width += thicker;
  return sizes;
}

}  // namespace mocap
