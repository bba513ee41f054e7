#include "core/proposals/stance_library.h"

#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>

#include "core/body/stance.h"
#include "core/degrees.h"

namespace mocap {
namespace {

constexpr int kHeadings = 8;
// Axes closer to each other than this, as a cosine, count as one.
constexpr double kSameAxis = 0.94;

struct LeaningStance {
  Stance stance;
  double lean_deg = 0;  ///< Forward lean of the trunk.
};

constexpr Stance With(const ArmStance& arms) { return {.arm_l = arms, .arm_r = arms}; }
constexpr Stance On(const LegStance& left, const LegStance& right) {
  return {.leg_l = left, .leg_r = right};
}
constexpr Stance Seated(const ArmStance& arms) {
  constexpr LegStance level{.hip = 85, .knee = 85};
  return {arms, arms, level, level};
}
constexpr Stance Stepping(bool left_is_in_front) {
  constexpr LegStance front{.hip = 30, .knee = 15}, back{.hip = -10, .knee = 25};
  return left_is_in_front ? On(front, back) : On(back, front);
}
constexpr Stance Symmetric(const LegStance& leg) { return On(leg, leg); }

constexpr std::array<LeaningStance, 15> kStances = {{
    {Stance{}},                                           // at ease
    {With({.raise = -45})},                               // arms half down
    {With({.raise = 0})},                                 // arms out
    {With({.raise = 75})},                                // arms up
    {With({.raise = -30, .forward = 70})},                // arms before the body
    {With({.forward = 30, .elbow = 90})},                 // hands before the chest
    {With({.raise = -50, .forward = 60, .elbow = 130})},  // hands before the face
    {Stepping(true)},
    {Stepping(false)},
    {On({.hip = 80, .knee = 80}, LegStance{})},  // on one leg
    {On(LegStance{}, {.hip = 80, .knee = 80})},  // on one leg
    {Seated({})},
    {Seated({.elbow = 60})},                                   // forearms on thighs
    {Symmetric({.hip = 110, .spread = 15, .knee = 120}), 35},  // crouching
    {Symmetric({.hip = 65, .knee = 15}), 60},                  // bent forward
}};

// Centroid of a posed body's capsules. Overlaps count twice.
Vector3 MiddleOfFlesh(const BodyModel& body, const PoseState& pose) {
  std::vector<PosedCapsule> posed;
  body.PoseShape(body.PostureAt(pose), posed);
  Vector3 sum = Vector3::Zero();
  double volume = 0;
  for (const PosedCapsule& capsule : posed) {
    const double radius = (capsule.radius_a_mm + capsule.radius_b_mm) / 2;
    const double part = radius * radius * ((capsule.b_W - capsule.a_W).norm() + 4.0 / 3 * radius);
    sum += part * capsule.middle_W;
    volume += part;
  }
  return sum / volume;
}

}  // namespace

StanceLibrary::StanceLibrary(const BodyModel& body) {
  for (const LeaningStance& leaning : kStances) {
    PoseState pose;
    pose.theta = AnglesOf(leaning.stance, body.table());
    const double lean_rad = leaning.lean_deg / kDegreesPerRad;
    entries_.push_back(
        {pose.theta, ExpRotation(Vector3(0, lean_rad, 0)), MiddleOfFlesh(body, pose)});
  }
}

void StanceLibrary::Propose(const Vector3& middle_W, const Vector3& up_W,
                            std::vector<PoseState>& poses) const {
  for (int heading = 0; heading < kHeadings; ++heading) {
    const double angle = heading * 2 * EIGEN_PI / kHeadings;
    // A person who lies faces up, down or sideways: the rotation is about the axis.
    const Vector3 any_W = std::abs(up_W.z()) < 0.8 ? Vector3::UnitZ() : Vector3::UnitX();
    const Vector3 aside_W = up_W.cross(any_W).normalized();
    const Vector3 left_W = std::cos(angle) * aside_W + std::sin(angle) * up_W.cross(aside_W);
    Matrix3 R_W;
    R_W << left_W.cross(up_W), left_W, up_W;
    for (const Entry& entry : entries_) {
      PoseState& pose = poses.emplace_back();
      pose.theta = entry.theta;
      pose.X_WT.R = R_W * entry.R_upright;
      pose.X_WT.p = middle_W - pose.X_WT.R * entry.middle_T;
    }
  }
}

std::vector<Vector3> TrunkAxes(const VoxelCloud& cloud) {
  const Vector3 middle_W = cloud.Centroid();
  Matrix3 spread = Matrix3::Zero();
  for (const Voxel& voxel : cloud.voxels()) {
    const Vector3 offset = voxel.center_W - middle_W;
    spread += offset * offset.transpose();
  }
  Eigen::SelfAdjointEigenSolver<Matrix3> solver;
  solver.computeDirect(spread);
  const Vector3 longest_W = solver.eigenvectors().col(2);
  std::vector<Vector3> axes = {Vector3::UnitZ(), -Vector3::UnitZ()};
  if (std::abs(longest_W.z()) < kSameAxis) {
    axes.push_back(longest_W);
    axes.push_back(-longest_W);
  }
  return axes;
}

}  // namespace mocap
