#include "core/acquisition/pose_hypotheses.h"

#include <array>
#include <string_view>

namespace mocap {
namespace {

constexpr int kHeadings = 8;

// An everyday stance in degrees of the paper's angles, for the left side; the right side mirrors
// it where its own is not given.
struct Stance {
  double raise = -75;  ///< θ3: arm, from straight out (0) to hanging (-90).
  double forward = 0;  ///< θ5: arm swung forward.
  double elbow = -15;  ///< θ9
  double hip_l = -5;   ///< θ13, negative is forward.
  double hip_r = -5;   ///< θ14
  double knee_l = 10;  ///< θ15
  double knee_r = 10;  ///< θ16
};

constexpr std::array<Stance, 8> kStances = {
    Stance{},                                                        // at ease
    Stance{.raise = -45},                                            // arms half down
    Stance{.raise = 0},                                              // arms out
    Stance{.raise = -75, .forward = -30, .elbow = -90},              // hands before the chest
    Stance{.hip_l = -30, .hip_r = 10, .knee_l = 15, .knee_r = 25},   // stepping
    Stance{.hip_l = 10, .hip_r = -30, .knee_l = 25, .knee_r = 15},   // stepping
    Stance{.hip_l = -85, .hip_r = -85, .knee_l = 85, .knee_r = 85},  // seated
    Stance{.elbow = -60,
           .hip_l = -85,
           .hip_r = -85,
           .knee_l = 85,
           .knee_r = 85}  // seated, hands on lap
};

double AngleOf(const Stance& stance, int paper_angle) {
  switch (paper_angle) {
    case 3:
      return stance.raise;
    case 4:
      return -stance.raise;
    case 5:
      return stance.forward;
    case 6:
      return -stance.forward;
    case 9:
      return stance.elbow;
    case 10:
      return -stance.elbow;
    case 13:
      return stance.hip_l;
    case 14:
      return stance.hip_r;
    case 15:
      return stance.knee_l;
    case 16:
      return stance.knee_r;
    default:
      return 0;
  }
}

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
      pose.theta.resize(body.joint_count());
      for (int i = 0; i < body.joint_count(); ++i) {
        const JointAxis& joint = body.table().joints[i];
        pose.theta[i] = joint.paper_angle > 0 ? AngleOf(stance, joint.paper_angle) * EIGEN_PI / 180
                                              : joint.rest_rad;
      }
      poses.push_back(pose);
    }
  }
  return poses;
}

}  // namespace mocap
