#include "core/hypotheses/steady_pose.h"

#include <Eigen/Cholesky>
#include <algorithm>

#include "core/counted_time.h"

namespace mocap {
namespace {

struct Stillness {
  // How far the points of a still person have moved after some time.
  double spread_mm = 5, after_s = 1.0 / 30;
  double shortest_s = 0.003;
  // Points that moved farther break free: a share of their noise.
  double noise_share = 0.3, least_mm = 1;
  int iterations = 3;
};
constexpr Stillness kStill{};
// How heels and toes that touch the floor are held.
struct Standing {
  double std_mm = 1;                                // Standard deviation of a held point.
  double comes_down = kContactLimit, leaves = 0.2;  // Probabilities that begin and end it.
  double slid_mm = 35;  // A point this far from its place has slid there, and is held anew.
  double mean_s = 0.5;  // Averaging time of the place.
};
constexpr Standing kStanding{};

using PointJacobian = Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::ColMajor, 3, kMaxDof>;

}  // namespace

void SteadyPose::Reset() {
  held_.reset();
  stands_ = {};
}

const PoseState& SteadyPose::Follow(const BodyModel& body, const PoseFilter& filter,
                                    const PointStds& std_mm, const Contacts& contacts,
                                    double dt_s) {
  FollowStands(body, filter.pose(), contacts, dt_s);
  const bool is_known = held_ && held_->dof() == filter.pose().dof();
  held_ = is_known ? Steady(body, filter, std_mm, dt_s) : filter.pose();
  return *held_;
}

void SteadyPose::FollowStands(const BodyModel& body, const PoseState& pose,
                              const Contacts& contacts, double dt_s) {
  const Posture posture = body.PostureAt(pose);
  for (int i = 0; i < kContactCount; ++i) {
    std::optional<Stand>& stand = stands_[i];
    if (!(contacts[i] > (stand ? kStanding.leaves : kStanding.comes_down))) {
      stand.reset();
      continue;
    }
    const Vector3 now_W = body.PlaceOf(kContactPoints[i], posture);
    if (!stand || (now_W - stand->place_W).norm() > kStanding.slid_mm) {
      stand = {now_W, dt_s};
      continue;
    }
    stand->lasts_s = std::min(stand->lasts_s + dt_s, kStanding.mean_s);
    stand->place_W += dt_s / stand->lasts_s * (now_W - stand->place_W);
  }
}

PoseState SteadyPose::Steady(const BodyModel& body, const PoseFilter& filter,
                             const PointStds& std_mm, double dt_s) const {
  const int n = filter.pose().dof();
  const PoseCovariance prior =
      Eigen::LLT<PoseCovariance>(filter.covariance()).solve(PoseCovariance::Identity(n, n));
  const BodyPoints before_W = body.PointsAt(body.PostureAt(*held_));
  const double still_mm2 = kStill.spread_mm * kStill.spread_mm *
                           std::max(CountedS(dt_s), kStill.shortest_s) / kStill.after_s;
  PoseState pose = filter.pose();
  UpdateEquations equations;
  PointJacobian J(3, n);
  for (int iteration = 0; iteration < kStill.iterations; ++iteration) {
    const Posture posture = body.PostureAt(pose);
    const BodyPoints now_W = body.PointsAt(posture);
    equations.Reset(n);
    for (int i = 0; i < kPointCount; ++i) {
      const Vector3 back_W = before_W.col(i) - now_W.col(i);
      const double scaled =
          back_W.norm() / std::max(kStill.least_mm, kStill.noise_share * std_mm[i]);
      const double inflation = (1 + scaled * scaled) * (1 + scaled * scaled);
      body.PointJacobian(posture, body.CarrierOf(static_cast<Point>(i)), now_W.col(i), J);
      equations.AddPoint(J, back_W, inflation * still_mm2);
    }
    for (int i = 0; i < kContactCount; ++i) {
      if (!stands_[i]) continue;
      const Point point = kContactPoints[i];
      const Vector3 foot_W = body.PlaceOf(point, posture);
      body.PointJacobian(posture, body.CarrierOf(point), foot_W, J);
      equations.AddPoint(J, stands_[i]->place_W - foot_W, kStanding.std_mm * kStanding.std_mm);
    }
    const PoseStep gradient = prior * filter.pose().Minus(pose) + equations.gradient();
    const PoseCovariance information = prior + equations.information();
    pose.Add(Eigen::LLT<PoseCovariance>(information).solve(gradient));
  }
  return pose.IsFinite() ? pose : filter.pose();
}

}  // namespace mocap
