#include "tools/interchange/skeleton_motion.h"

#include <algorithm>
#include <string>

#include "core/errors.h"
#include "tools/kinematics/rest_body.h"
#include "tools/results/export_axes.h"

namespace mocap {
namespace {

constexpr int kHips = static_cast<int>(SkeletonJoint::kHips);
constexpr int kSpine = static_cast<int>(SkeletonJoint::kSpine);
constexpr int kHead = static_cast<int>(SkeletonJoint::kHead);

/// Whether a joint points its bone at the next joint.
constexpr bool IsAiming(int joint) {
  return joint != kHips && joint != kSpine && joint != kHead && !kSkeletonJoints[joint].is_end;
}

/// Poses a skeleton for one body's rows.
class Poser {
 public:
  explicit Poser(const BodyRecord& body) : rest_(body) {
    const JointOffsets rest_T = RestPlaces();
    for (int i = 0; i + 1 < kSkeletonJointCount; ++i) {
      direction_T_[i] = (rest_T[i + 1] - rest_T[i]).normalized();
    }
  }

  JointOffsets RestPlaces() const {
    PoseRow row;
    row.points_W = rest_.places_T().leftCols<kPointCount>();
    JointOffsets places_T = PlacesOf(row);
    places_T[kHead + 1].z() += rest_.sizes().head / 2;
    return places_T;
  }

  SkeletonPose PoseOf(const PoseRow& row) const {
    const JointOffsets places_W = PlacesOf(row);
    SkeletonPose pose;
    pose.time_ns = row.timestamp_ns;
    std::array<Matrix3, kSkeletonJointCount> R_W;
    for (int i = 0; i < kSkeletonJointCount; ++i) {
      const int parent = kSkeletonJoints[i].parent;
      if (parent < 0) {
        pose.offset[i] = places_W[i];
        pose.R[i] = R_W[i] = rest_.PelvisRotation(row);
        continue;
      }
      pose.offset[i] = R_W[parent].transpose() * (places_W[i] - places_W[parent]);
      pose.R[i] = Turn(i, row, R_W[parent], places_W);
      R_W[i] = R_W[parent] * pose.R[i];
    }
    // The 23 points have no top of the head.
    pose.offset[kHead + 1] = Vector3(0, 0, rest_.sizes().head / 2);
    return pose;
  }

 private:
  Matrix3 Turn(int joint, const PoseRow& row, const Matrix3& R_WParent,
               const JointOffsets& places_W) const {
    if (joint == kSpine) return R_WParent.transpose() * TorsoRotation(row);
    if (!IsAiming(joint)) return Matrix3::Identity();
    const Vector3 direction = R_WParent.transpose() * (places_W[joint + 1] - places_W[joint]);
    // The shortest rotation: points do not show a rotation about the bone itself.
    return RotationBetween(direction_T_[joint], direction).toRotationMatrix();
  }

  JointOffsets PlacesOf(const PoseRow& row) const {
    const Matrix3 R_WT = TorsoRotation(row);
    const auto at = [&](Point point) { return At(row, point); };
    const auto in_torso = [&](Point point) -> Vector3 {
      return at(Point::kTorso) + R_WT * rest_.places_T().col(static_cast<int>(point));
    };
    return {HipsMiddle(row),
            at(Point::kTorso),
            at(Point::kNeck),
            at(Point::kHead),
            at(Point::kHead),
            in_torso(Point::kClavicleL),
            at(Point::kShoulderL),
            at(Point::kElbowL),
            rest_.Wrist(row, Point::kElbowL, Point::kLowerArmL),
            at(Point::kFingertipsL),
            in_torso(Point::kClavicleR),
            at(Point::kShoulderR),
            at(Point::kElbowR),
            rest_.Wrist(row, Point::kElbowR, Point::kLowerArmR),
            at(Point::kFingertipsR),
            at(Point::kHipL),
            at(Point::kKneeL),
            at(Point::kFootL),
            at(Point::kHipR),
            at(Point::kKneeR),
            at(Point::kFootR)};
  }

  RestBody rest_;
  JointOffsets direction_T_;  ///< From each joint to the next one in the reference configuration.
};

void MeasureWorst(SkeletonMotion& motion) {
  for (const SkeletonPose& pose : motion.frames) {
    const JointOffsets own = PlacesAt(pose, pose.offset);
    const JointOffsets constant = PlacesAt(pose, motion.bones);
    for (int i = 0; i < kSkeletonJointCount; ++i) {
      motion.worst_mm = std::max(motion.worst_mm, (own[i] - constant[i]).norm());
    }
  }
}

/// Repeats the last pose until a row that is this many periods later.
void Hold(std::int64_t periods, const PoseRow& row, SkeletonMotion& motion) {
  const SkeletonPose last = motion.frames.back();
  const std::int64_t repeats = IsTracked(row) ? periods - 1 : periods;
  RequireShortGap(repeats, row);
  for (std::int64_t i = 1; i <= repeats; ++i) {
    motion.frames.push_back(last);
    motion.frames.back().time_ns = last.time_ns + (row.timestamp_ns - last.time_ns) / periods * i;
  }
  motion.held_frames += static_cast<int>(repeats);
}

}  // namespace

JointOffsets PlacesAt(const SkeletonPose& pose, const JointOffsets& offset) {
  JointOffsets places_W;
  std::array<Matrix3, kSkeletonJointCount> R_W;
  for (int i = 0; i < kSkeletonJointCount; ++i) {
    const int parent = kSkeletonJoints[i].parent;
    places_W[i] = parent < 0 ? pose.offset[i] : places_W[parent] + R_W[parent] * offset[i];
    R_W[i] = parent < 0 ? pose.R[i] : Matrix3(R_W[parent] * pose.R[i]);
  }
  return places_W;
}

JointOffsets RestPlaces(const BodyRecord& body) { return Poser(body).RestPlaces(); }

SkeletonMotion MakeSkeletonMotion(const Result& result) {
  SkeletonMotion motion;
  const EvenClock clock = FitClock(result.poses);
  motion.period_s = clock.period_s;
  const Poser poser(result.body);
  motion.frames.reserve(result.poses.size());
  for (std::size_t i = 0; i < result.poses.size(); ++i) {
    const PoseRow& row = result.poses[i];
    if (motion.frames.empty() && !IsTracked(row)) {
      ++motion.skipped_frames;
      continue;
    }
    if (!motion.frames.empty()) Hold(clock.steps[i], row, motion);
    if (IsTracked(row)) {
      motion.frames.push_back(poser.PoseOf(row));
      motion.bones = motion.frames.back().offset;
    }
  }
  if (motion.frames.empty()) {
    throw SetupError("no frame of the result is tracked; expected at least one");
  }
  motion.bones[kHips] = Vector3::Zero();
  MeasureWorst(motion);
  return motion;
}

}  // namespace mocap
