#include "core/acquisition/pose_hypotheses.h"

#include <array>

#include "core/body/stance.h"

namespace mocap {
namespace {

constexpr int kHeadings = 8;

constexpr std::array<Stance, 8> kStances = {
    Stance{},                                                                // at ease
    Stance{.raise_l = -45, .raise_r = -45},                                  // arms half down
    Stance{.raise_l = 0, .raise_r = 0},                                      // arms out
    Stance{.forward_l = 30, .forward_r = 30, .elbow_l = 90, .elbow_r = 90},  // before the chest
    Stance{.hip_l = 30, .hip_r = -10, .knee_l = 15, .knee_r = 25},           // stepping
    Stance{.hip_l = -10, .hip_r = 30, .knee_l = 25, .knee_r = 15},           // stepping
    Stance{.hip_l = 85, .hip_r = 85, .knee_l = 85, .knee_r = 85},            // seated
    Stance{.elbow_l = 60, .elbow_r = 60, .hip_l = 85, .hip_r = 85, .knee_l = 85, .knee_r = 85}};

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
