#include "core/tracking/rival_pose.h"

#include <algorithm>

#include "core/counted_time.h"

namespace mocap {
namespace {

// A pose is better if it costs this much less for this long. More in one frame counts no more:
// frames with holes or shadows should not decide alone.
constexpr double kMostLeadMm = 2;
constexpr double kClearLeadMm_s = 0.12;
// What is not decided by then is not worth the time.
constexpr double kLongestRivalry_s = 0.4;
// Poses whose points have a smaller mean distance than this are equal.
constexpr double kSameMm = 30;

}  // namespace

double ClearLeadMm(double dt_s) { return kClearLeadMm_s / CountedS(dt_s); }

RivalPose::RivalPose(const PoseFilter& present, const PoseState& pose, double cost_mm)
    : filter_(present), cost_mm_(cost_mm) {
  filter_.Jump(pose);
}

RivalPose::Rank RivalPose::Follow(const BodyModel& body, SurfaceFit& fit, const PoseState& present,
                                  double present_cost_mm, double dt_s) {
  if (dt_s > 0) filter_.Predict(dt_s);
  filter_.Update(
      body.table(),
      [&](const PoseState& pose, UpdateEquations& equations) {
        fit.Linearize(body, pose, equations);
      },
      Iterations{});
  cost_mm_ = fit.QualityAt(body, filter_.pose()).Cost();
  const double lead_mm = present_cost_mm - cost_mm_;
  lead_mm_s_ += std::clamp(lead_mm, -kMostLeadMm, kMostLeadMm) * CountedS(dt_s);
  age_s_ += CountedS(dt_s);
  const BodyPoints apart_W =
      body.PointsAt(body.PostureAt(filter_.pose())) - body.PointsAt(body.PostureAt(present));
  const bool is_same = apart_W.colwise().norm().mean() < kSameMm;
  if (is_same || lead_mm_s_ < -kClearLeadMm_s || age_s_ > kLongestRivalry_s || !filter_.is_sound())
    return Rank::kWorse;
  return lead_mm > 0 && lead_mm_s_ > kClearLeadMm_s ? Rank::kBetter : Rank::kUndecided;
}

}  // namespace mocap
