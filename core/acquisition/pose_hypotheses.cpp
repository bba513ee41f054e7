#include "core/acquisition/pose_hypotheses.h"

#include <array>

#include "core/body/stance.h"

namespace mocap {
namespace {

constexpr int kHeadings = 8;

constexpr ArmStance kBentArm{.forward = 30, .elbow = 90};
constexpr ArmStance kForearmOnThigh{.elbow = 60};
constexpr LegStance kFrontLeg{.hip = 30, .knee = 15};
constexpr LegStance kBackLeg{.hip = -10, .knee = 25};
constexpr LegStance kSeatedLeg{.hip = 85, .knee = 85};

constexpr Stance With(const ArmStance& arms) { return {.arm_l = arms, .arm_r = arms}; }

constexpr std::array<Stance, 9> kStances = {
    Stance{},                                          // at ease
    With(ArmStance{.raise = -45}),                     // arms half down
    With(ArmStance{.raise = 0}),                       // arms out
    With(ArmStance{.raise = 75}),                      // arms up
    With(kBentArm),                                    // hands before the chest
    Stance{.leg_l = kFrontLeg, .leg_r = kBackLeg},     // stepping
    Stance{.leg_l = kBackLeg, .leg_r = kFrontLeg},     // stepping
    Stance{.leg_l = kSeatedLeg, .leg_r = kSeatedLeg},  // seated
    Stance{kForearmOnThigh, kForearmOnThigh, kSeatedLeg, kSeatedLeg}};

}  // namespace

std::vector<PoseState> PoseHypotheses(const BodyModel& body, const LocalizedBody& located) {
  const Vector3 up_W = -located.torso.axis_W;
  const Vector3 neck_T = body.reference_points_T().col(static_cast<int>(Point::kNeck));
  // The border of the crust lies half-way between the head's centre and the neck joint.
  const Vector3 neck_W = located.head.center_W - body.sizes().neck * up_W;
  std::vector<PoseState> poses;
  for (int heading = 0; heading < kHeadings; ++heading) {
    const double angle = heading * 2 * EIGEN_PI / kHeadings;
    const Vector3 forward_W(std::cos(angle), std::sin(angle), 0);
    const Vector3 left_W = up_W.cross(forward_W).normalized();
    PoseState pose;
    pose.X_WT.R << left_W.cross(up_W), left_W, up_W;
    pose.X_WT.p = neck_W - pose.X_WT.R * neck_T;
    for (const Stance& stance : kStances) {
      pose.theta = AnglesOf(stance, body.table());
      poses.push_back(pose);
    }
  }
  return poses;
}

}  // namespace mocap
