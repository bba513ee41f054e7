#include "core/acquisition/pose_prior.h"

#include <algorithm>

#include "core/body/joint_rest.h"
#include "core/tracking/carried_things.h"

namespace mocap {
namespace {

// Somebody upside down must explain the evidence better by this much than anybody upright does: a
// gown looks like a trunk, and the arms above it like legs.
constexpr double kUpsideDownMm = 12;
// Likewise somebody who faces away from where the feet point: a backpack looks like a chest.
constexpr double kAgainstFeetMm = 10;
// Somebody who walks backwards: it happens.
constexpr double kAgainstWayMm = 4;
// A joint angle or a stature that is a standard deviation from the usual. Somebody who is taken to
// face the opposite way has twisted arms and feet.
constexpr double kUnusualMm = 0.5;
// Men are 1756 mm tall with a standard deviation of 67 (Gordon et al. 1989), and taller in a hull,
// by hair and shoes. Whoever sits would otherwise be taken for a giant in the chair. Women and
// children are shorter: nobody costs more for that.
constexpr double kTallMm = 1800, kTallStdMm = 80;

double ChiSquareOfStature(double stature_mm) {
  const double deviation = std::max(0.0, stature_mm - kTallMm) / kTallStdMm;
  return deviation * deviation;
}

}  // namespace

PosePrior::PosePrior(const std::optional<Vector3>& toes_W, const std::optional<Vector3>& walks_W)
    : ahead_W_(toes_W ? toes_W : walks_W), backwards_mm_(toes_W ? kAgainstFeetMm : kAgainstWayMm) {
  if (ahead_W_) ahead_W_->normalize();
}

double PosePrior::CostMm(const PoseState& pose) const {
  const double upside_down = (1 - pose.X_WT.R(2, 2)) / 2, backwards = ShareBackwards(pose);
  return kUpsideDownMm * upside_down * upside_down + backwards_mm_ * backwards * backwards;
}

double PosePrior::CostMm(const BodyModel& body, const PoseState& pose) const {
  return CostMm(pose) + (body.sizes().IsDraped() ? kWornMm : 0) +
         kUnusualMm * (ChiSquareFromRest(body.table(), pose.theta) +
                       ChiSquareOfStature(body.sizes().Stature()));
}

double PosePrior::ShareBackwards(const PoseState& pose) const {
  const Vector2 ahead = pose.X_WT.R.col(0).head<2>();
  if (!ahead_W_ || ahead.norm() == 0) return 0;
  const double upright = std::max(0.0, pose.X_WT.R(2, 2));
  return upright * (1 - ahead.normalized().dot(ahead_W_->head<2>())) / 2;
}

}  // namespace mocap
