#include "tools/results/bvh_motion.h"

#include <algorithm>
#include <string>

#include "core/errors.h"
#include "tools/results/export_axes.h"

namespace mocap {
namespace {

/// An hour at 30 frames a second: a longer pause is two recordings, or times that are wrong.
constexpr std::int64_t kLongestHold = 108'000;

/// A limb's bone: its joint, where it ends, and its direction in the rest pose.
struct Bone {
  BvhJoint joint;
  Point start, end;
  Vector3 rest;
};

const std::array<Bone, 9>& Bones() {
  static const Vector3 left = Vector3::UnitY(), up = Vector3::UnitZ();
  static const std::array<Bone, 9> bones = {{
      {BvhJoint::kNeck, Point::kNeck, Point::kHead, up},
      {BvhJoint::kLeftArm, Point::kShoulderL, Point::kElbowL, left},
      {BvhJoint::kLeftForeArm, Point::kElbowL, Point::kFingertipsL, left},
      {BvhJoint::kRightArm, Point::kShoulderR, Point::kElbowR, -left},
      {BvhJoint::kRightForeArm, Point::kElbowR, Point::kFingertipsR, -left},
      {BvhJoint::kLeftUpLeg, Point::kHipL, Point::kKneeL, -up},
      {BvhJoint::kLeftLeg, Point::kKneeL, Point::kFootL, -up},
      {BvhJoint::kRightUpLeg, Point::kHipR, Point::kKneeR, -up},
      {BvhJoint::kRightLeg, Point::kKneeR, Point::kFootR, -up},
  }};
  return bones;
}

Vector3 At(const PoseRow& row, Point point) { return row.points_W.col(static_cast<int>(point)); }

Vector3 HipsMiddle(const PoseRow& row) {
  return (At(row, Point::kHipL) + At(row, Point::kHipR)) / 2;
}

Matrix3 TorsoRotation(const PoseRow& row) {
  return ExpRotation(row.paper.torso_axis * row.paper.torso_angle_rad);
}

/// The pelvis has its left along the hips and its up towards the spine's joint.
Matrix3 PelvisRotation(const PoseRow& row) {
  const Vector3 left = (At(row, Point::kHipL) - At(row, Point::kHipR)).normalized();
  const Vector3 to_spine = At(row, Point::kTorso) - HipsMiddle(row);
  const Vector3 forward = left.cross(to_spine).normalized();
  Matrix3 R;
  R << forward, left, forward.cross(left);
  return R;
}

template <typename Measure>
double Median(const std::vector<const PoseRow*>& rows, Measure measure) {
  std::vector<double> values;
  for (const PoseRow* row : rows) values.push_back(measure(*row));
  std::ranges::nth_element(values, values.begin() + values.size() / 2);
  return values[values.size() / 2];
}

template <typename Measure>
Vector3 MedianVector(const std::vector<const PoseRow*>& rows, Measure measure) {
  Vector3 median;
  for (int axis = 0; axis < 3; ++axis) {
    median[axis] = Median(rows, [&](const PoseRow& row) { return measure(row)[axis]; });
  }
  return median;
}

BvhSkeleton MeasureSkeleton(const std::vector<const PoseRow*>& rows, double head_mm) {
  BvhSkeleton skeleton;
  skeleton.offset.fill(Vector3::Zero());
  skeleton.end.fill(Vector3::Zero());
  const auto place = [&](BvhJoint joint, auto rotation, auto from) {
    const Point point = kBvhJoints[static_cast<int>(joint)].start;
    skeleton.offset[static_cast<int>(joint)] =
        MedianVector(rows, [&](const PoseRow& row) -> Vector3 {
          return rotation(row).transpose() * (At(row, point) - from(row));
        });
  };
  const auto spine = [](const PoseRow& row) { return At(row, Point::kTorso); };
  place(BvhJoint::kSpine, PelvisRotation, HipsMiddle);
  place(BvhJoint::kLeftUpLeg, PelvisRotation, HipsMiddle);
  place(BvhJoint::kRightUpLeg, PelvisRotation, HipsMiddle);
  place(BvhJoint::kNeck, TorsoRotation, spine);
  place(BvhJoint::kLeftArm, TorsoRotation, spine);
  place(BvhJoint::kRightArm, TorsoRotation, spine);
  for (const Bone& bone : Bones()) {
    const Vector3 end = bone.rest * Median(rows, [&](const PoseRow& row) {
                          return (At(row, bone.end) - At(row, bone.start)).norm();
                        });
    const int joint = static_cast<int>(bone.joint);
    const bool has_child = joint + 1 < kBvhJointCount && kBvhJoints[joint + 1].parent == joint;
    (has_child ? skeleton.offset[joint + 1] : skeleton.end[joint]) = end;
  }
  skeleton.end[static_cast<int>(BvhJoint::kHead)] = Vector3::UnitZ() * head_mm / 2;
  return skeleton;
}

BvhPose PoseOf(const PoseRow& row) {
  BvhPose pose;
  pose.p_WHips = HipsMiddle(row);
  std::array<Matrix3, kBvhJointCount> R_W;
  R_W.fill(Matrix3::Identity());
  pose.R.fill(Matrix3::Identity());
  const auto turn = [&](BvhJoint joint, const Matrix3& R_parent_joint) {
    const int i = static_cast<int>(joint);
    const int parent = kBvhJoints[i].parent;
    pose.R[i] = R_parent_joint;
    R_W[i] = parent < 0 ? R_parent_joint : Matrix3(R_W[parent] * R_parent_joint);
  };
  const Matrix3 R_WP = PelvisRotation(row);
  turn(BvhJoint::kHips, R_WP);
  turn(BvhJoint::kSpine, R_WP.transpose() * TorsoRotation(row));
  for (const Bone& bone : Bones()) {
    const int parent = kBvhJoints[static_cast<int>(bone.joint)].parent;
    const Vector3 direction = R_W[parent].transpose() * (At(row, bone.end) - At(row, bone.start));
    // The shortest turn: points say nothing of a turn about the bone itself.
    turn(bone.joint, Eigen::Quaterniond::FromTwoVectors(bone.rest, direction).toRotationMatrix());
  }
  return pose;
}

/// Largest distance between the skeleton's joints and the points they stand for.
double WorstDistance(const BvhSkeleton& skeleton, const BvhPose& pose, const PoseRow& row) {
  std::array<RigidTransform, kBvhJointCount> X_W;
  double worst = 0;
  for (int i = 0; i < kBvhJointCount; ++i) {
    const int parent = kBvhJoints[i].parent;
    if (parent < 0) {
      X_W[i] = {pose.R[i], pose.p_WHips};
      continue;
    }
    X_W[i] = X_W[parent] * RigidTransform{pose.R[i], skeleton.offset[i]};
    worst = std::max(worst, (X_W[i].p - At(row, kBvhJoints[i].start)).norm());
  }
  for (const Bone& bone : Bones()) {
    const int joint = static_cast<int>(bone.joint);
    if (skeleton.end[joint].isZero()) continue;
    worst = std::max(worst, (X_W[joint] * skeleton.end[joint] - At(row, bone.end)).norm());
  }
  return worst;
}

}  // namespace

BvhMotion MakeBvhMotion(const Result& result) {
  std::vector<const PoseRow*> tracked;
  for (const PoseRow& row : result.poses) {
    if (IsTracked(row)) tracked.push_back(&row);
  }
  if (tracked.empty()) throw SetupError("no frame of the result is tracked, wanted at least one");
  BvhMotion motion;
  const EvenClock clock = FitClock(result.poses);
  motion.period_s = clock.period_s;
  motion.skeleton = MeasureSkeleton(tracked, result.body.sizes.head);
  for (std::size_t i = 0; i < result.poses.size(); ++i) {
    const PoseRow& row = result.poses[i];
    if (motion.frames.empty() && !IsTracked(row)) {
      ++motion.skipped_frames;
      continue;
    }
    const std::int64_t held = motion.frames.empty() ? 0 : clock.steps[i] - IsTracked(row);
    if (held > kLongestHold) {
      throw SetupError("frame " + std::to_string(row.frame) + " comes " + std::to_string(held) +
                       " frame times after the one before; BVH has one rate and no room for that");
    }
    if (held > 0) motion.frames.insert(motion.frames.end(), held, BvhPose(motion.frames.back()));
    motion.held_frames += static_cast<int>(held);
    if (!IsTracked(row)) continue;
    motion.frames.push_back(PoseOf(row));
    motion.worst_mm =
        std::max(motion.worst_mm, WorstDistance(motion.skeleton, motion.frames.back(), row));
  }
  return motion;
}

}  // namespace mocap
