#include "core/mikic2003/orientation.h"

#include <algorithm>
#include <numbers>
#include <utility>

namespace mocap::mikic2003 {
namespace {

constexpr double kSignificant = 0.8;
// "Usually several iterations"; the first frame's rough start needs more.
constexpr int kIterations = 10;
constexpr int kFirstIterations = 30;
constexpr double kSlightBendRad = 0.3;

// Limbs start slightly bent, so that knees and elbows bend in the right direction.
PoseState StartOf(const BodyModel& body, const Matrix3& R_WT, const MeasuredPoints& points) {
  PoseState pose;
  pose.X_WT.R = R_WT;
  const auto& torso_W = At(points, Point::kTorso);
  pose.X_WT.p = torso_W ? *torso_W : Vector3::Zero();
  pose.theta.setZero(body.joint_count());
  for (int i = 0; i < body.joint_count(); ++i) {
    const JointAxis& joint = body.table().joints[i];
    const double bend = joint.max_rad > -joint.min_rad ? kSlightBendRad : -kSlightBendRad;
    if (joint.at == Point::kElbowL || joint.at == Point::kElbowR || joint.at == Point::kKneeL ||
        joint.at == Point::kKneeR) {
      pose.theta[i] = bend;
    }
  }
  return pose;
}

}  // namespace

MeasuredPoints ExchangeSides(const MeasuredPoints& points) {
  MeasuredPoints exchanged = points;
  for (int limb = 0; limb < kLimbCount; limb += 2) {
    const Limb &left = kLimbs[limb], &right = kLimbs[limb + 1];
    std::swap(At(exchanged, left.root), At(exchanged, right.root));
    std::swap(At(exchanged, left.joint), At(exchanged, right.joint));
    std::swap(At(exchanged, left.end), At(exchanged, right.end));
    // The first ten points are the parts' centroids.
    std::swap(exchanged[static_cast<int>(left.upper)], exchanged[static_cast<int>(right.upper)]);
    std::swap(exchanged[static_cast<int>(left.lower)], exchanged[static_cast<int>(right.lower)]);
  }
  return exchanged;
}

OrientedBody::OrientedBody(const BodyModel& body, const Matrix3& R_WT, const MeasuredPoints& points)
    : filters_{PoseEkf(body, StartOf(body, R_WT, points)),
               PoseEkf(body, StartOf(body, R_WT * ExpRotation(std::numbers::pi * Vector3::UnitZ()),
                                     points))} {
  Adjust(body, points, kFirstIterations, false);
}

void OrientedBody::Predict(double dt_s) {
  for (PoseEkf& filter : filters_) filter.Predict(dt_s);
}

void OrientedBody::Update(const BodyModel& body, const MeasuredPoints& points, bool may_decide) {
  Adjust(body, points, kIterations, may_decide);
}

void OrientedBody::Adjust(const BodyModel& body, const MeasuredPoints& points, int iterations,
                          bool may_decide) {
  const int other = 1 - best_;
  const auto adjust = [&](int which, const MeasuredPoints& seen) {
    filters_[which].Update(body, seen, iterations);
    return SumOfDistances(body, filters_[which].Pose(body), seen);
  };
  double sum_mm = adjust(best_, points);
  if (!is_decided_) {
    const double other_mm = adjust(other, ExchangeSides(points));
    is_decided_ =
        may_decide && std::min(sum_mm, other_mm) < kSignificant * std::max(sum_mm, other_mm);
    if (other_mm < sum_mm) best_ = other, sum_mm = other_mm;
  }
  const auto seen =
      std::ranges::count_if(points, [](const auto& point) { return point.has_value(); });
  residual_mm_ = seen > 0 ? sum_mm / static_cast<double>(seen) : 0;
}

}  // namespace mocap::mikic2003
