#include "core/hypotheses/steady_pose.h"

#include <Eigen/Cholesky>
#include <algorithm>

#include "core/counted_time.h"

namespace mocap {
namespace {

// How far the points of a still person move: their spread after kStill_s.
constexpr double kStillMm = 5;
constexpr double kStill_s = 1.0 / 30;
constexpr double kShortest_s = 0.003;
// Points that moved farther than this break free: a share of their noise, and at least.
constexpr double kNoiseShare = 0.3;
constexpr double kLeastMm = 1;
constexpr int kSteadyIterations = 3;

using PointJacobian = Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::ColMajor, 3, kMaxDof>;

}  // namespace

const PoseState& SteadyPose::Follow(const BodyModel& body, const PoseFilter& filter,
                                    const PointStds& std_mm, double dt_s) {
  const bool is_known = held_ && held_->dof() == filter.pose().dof();
  held_ = is_known ? Steady(body, filter, std_mm, dt_s) : filter.pose();
  return *held_;
}

PoseState SteadyPose::Steady(const BodyModel& body, const PoseFilter& filter,
                             const PointStds& std_mm, double dt_s) const {
  const int n = filter.pose().dof();
  const PoseCovariance prior =
      Eigen::LLT<PoseCovariance>(filter.covariance()).solve(PoseCovariance::Identity(n, n));
  const BodyPoints before_W = body.PointsAt(body.PostureAt(*held_));
  const double still_mm2 = kStillMm * kStillMm * std::max(CountedS(dt_s), kShortest_s) / kStill_s;
  PoseState pose = filter.pose();
  UpdateEquations equations;
  PointJacobian J(3, n);
  for (int iteration = 0; iteration < kSteadyIterations; ++iteration) {
    const Posture posture = body.PostureAt(pose);
    const BodyPoints now_W = body.PointsAt(posture);
    equations.Reset(n);
    for (int i = 0; i < kPointCount; ++i) {
      const Vector3 back_W = before_W.col(i) - now_W.col(i);
      const double scaled = back_W.norm() / std::max(kLeastMm, kNoiseShare * std_mm[i]);
      const double inflation = (1 + scaled * scaled) * (1 + scaled * scaled);
      body.PointJacobian(posture, body.CarrierOf(static_cast<Point>(i)), now_W.col(i), J);
      equations.AddPoint(J, back_W, inflation * still_mm2);
    }
    const PoseStep gradient = prior * filter.pose().Minus(pose) + equations.gradient();
    const PoseCovariance information = prior + equations.information();
    pose.Add(Eigen::LLT<PoseCovariance>(information).solve(gradient));
  }
  return pose.IsFinite() ? pose : filter.pose();
}

}  // namespace mocap
