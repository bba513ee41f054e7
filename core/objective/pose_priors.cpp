#include "core/objective/pose_priors.h"

#include <algorithm>
#include <cmath>

#include "core/body/joint_rest.h"

namespace mocap {
namespace {

// Costs of what people hardly do.
struct HabitCosts {
  double limit_std_rad = 0.01;  // Of angles beyond a joint's limits.
  // Odds of 30 to 1 where a frame counts a quarter (kFrameWorth). With half of it, a child in
  // helmet and coat was tracked upside down; with a quarter more, a child's handstand is not found.
  double upside_down_nats = 13.8;
  double against_feet_nats = 4.8;  // Of 121 pairs of feet, one pointed backwards (feet.h).
  // Men are 1756 mm tall with a standard deviation of 67 (Gordon et al. 1989), and taller in a
  // hull, by hair and shoes. Without it, a seated person is fitted as a giant who stands in
  // the chair. Short people are no less probable: women and children are many.
  double tall_mm = 1800, tall_std_mm = 80;
};
constexpr HabitCosts kHabits{};

}  // namespace

double JointNats(const BodyTable& table, const JointAngles& theta) {
  double chi_square = ChiSquareFromRest(table, theta);
  for (int i = 0; i < theta.size(); ++i) {
    const JointAxis& joint = table.joints[i];
    const double beyond =
        (theta[i] - std::clamp(theta[i], joint.min_rad, joint.max_rad)) / kHabits.limit_std_rad;
    chi_square += beyond * beyond;
  }
  return chi_square / 2;
}

void LinearizeJoints(const BodyTable& table, const PoseState& pose, UpdateEquations& equations) {
  PoseStep J(pose.dof());
  for (int i = 0; i < pose.theta.size(); ++i) {
    const JointAxis& joint = table.joints[i];
    const double angle = pose.theta[i];
    const double allowed = std::clamp(angle, joint.min_rad, joint.max_rad);
    J.setZero();
    J[kTorsoDof + i] = 1;
    if (angle != allowed)
      equations.Add(J, allowed - angle, kHabits.limit_std_rad * kHabits.limit_std_rad);
    if (joint.rest_std_rad > 0) {
      const JointRest rest = RestOf(table, i, pose.theta);
      J.tail(pose.theta.size()) -= rest.J_by_angle;
      equations.Add(J, rest.rest_rad - angle, joint.rest_std_rad * joint.rest_std_rad);
    }
  }
}

double ShareBackwards(const PoseState& pose, const std::optional<Vector3>& toes_W) {
  const Vector2 faces = pose.X_WT.R.col(0).head<2>();
  if (!toes_W || faces.norm() == 0) return 0;
  const double upright = std::max(0.0, pose.X_WT.R(2, 2));
  return upright * (1 - faces.normalized().dot(toes_W->head<2>().normalized())) / 2;
}

double HabitNats(const BodyModel& body, const PoseState& pose,
                 const std::optional<Vector3>& toes_W) {
  const double upside_down = (1 - pose.X_WT.R(2, 2)) / 2;
  const double taller =
      std::max(0.0, body.sizes().Stature() - kHabits.tall_mm) / kHabits.tall_std_mm;
  return kHabits.upside_down_nats * upside_down * upside_down + taller * taller / 2 +
         kHabits.against_feet_nats * ShareBackwards(pose, toes_W);
}

}  // namespace mocap
