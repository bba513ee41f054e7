#include "tools/interchange/skeleton_motion.h"

#include <algorithm>
#include <span>

#include "core/errors.h"
#include "tools/kinematics/posed_segments.h"
#include "tools/results/export_axes.h"

namespace mocap {
namespace {

/// LAFAN1's Spine and Spine1, as shares of the way from the hips to the waist's axes.
constexpr double kLowSpineShare = 0.2, kMiddleSpineShare = 0.6;

/// Poses a skeleton for one body's rows.
class Poser {
 public:
  Poser(const BodyRecord& body, const Skeleton& skeleton)
      : joints_(skeleton.joints), segments_(body) {
    const SkeletonPlaces rest_T = PlacesOf(segments_.rest().places_T(), Matrix3::Identity());
    for (const SkeletonJointInfo& joint : joints_) rest_T_.push_back(At(rest_T, joint.place));
    for (std::size_t i = 0; i < joints_.size(); ++i) R_TJoint_.push_back(RestAxes(i));
  }

  const JointOffsets& rest_T() const { return rest_T_; }

  SkeletonPose PoseOf(const PoseRow& row) const {
    const PosedSegments posed = segments_.Pose(row);
    const SkeletonPlaces places_W = PlacesOf(posed.places_W, posed.RotationOf(Segment::kHead));
    const auto R_W = [&](std::size_t i) -> Matrix3 {
      return posed.RotationOf(joints_[i].segment) * R_TJoint_[i];
    };
    SkeletonPose pose;
    pose.time_ns = row.timestamp_ns;
    for (std::size_t i = 0; i < joints_.size(); ++i) {
      const SkeletonJointInfo& joint = joints_[i];
      const Vector3 place_W = At(places_W, joint.place);
      if (joint.parent < 0) {
        pose.offset.push_back(YUpFromWorld() * place_W);
        pose.R.emplace_back(YUpFromWorld() * R_W(i));
        continue;
      }
      const auto parent = static_cast<std::size_t>(joint.parent);
      const Matrix3 R_ParentW = R_W(parent).transpose();
      pose.offset.push_back(R_ParentW * (place_W - At(places_W, joints_[parent].place)));
      pose.R.push_back(joint.is_end ? Matrix3::Identity() : Matrix3(R_ParentW * R_W(i)));
    }
    return pose;
  }

 private:
  using SkeletonPlaces = Eigen::Matrix<double, 3, kSkeletonPlaceCount>;

  static Vector3 At(const SkeletonPlaces& places, Point place) {
    return places.col(static_cast<int>(place));
  }

  SkeletonPlaces PlacesOf(const BodyPlaces& points, const Matrix3& R_head) const {
    SkeletonPlaces places;
    places.leftCols<kPlaceCount>() = points;
    const auto at = [&](Point place) { return places.col(static_cast<int>(place)); };
    at(kHipsMiddle) = (at(Point::kHipL) + at(Point::kHipR)) / 2;
    const Vector3 spine = at(Point::kTorso) - at(kHipsMiddle);
    at(kLowSpine) = at(kHipsMiddle) + kLowSpineShare * spine;
    at(kMiddleSpine) = at(kHipsMiddle) + kMiddleSpineShare * spine;
    at(kHeadTop) = at(Point::kHead) + R_head * Vector3(0, 0, segments_.rest().sizes().head / 2);
    return places;
  }

  /// A joint's axes in the reference configuration.
  Matrix3 RestAxes(std::size_t joint) const {
    const BoneAxes axes = joints_[joint].axes;
    if (axes == BoneAxes::kStudio) return YUpFromWorld().transpose();
    const Vector3 x = joints_[joint].parent < 0
                          ? Vector3(Vector3::UnitZ())
                          : Vector3((rest_T_[joint + 1] - rest_T_[joint]).normalized());
    const Vector3 about_y = axes == BoneAxes::kUpward     ? Vector3(Vector3::UnitZ())
                            : axes == BoneAxes::kBackward ? Vector3(-Vector3::UnitX())
                                                          : Vector3(Vector3::UnitX());
    const Vector3 z = x.cross(about_y).normalized();
    Matrix3 R;
    R << x, z.cross(x), z;
    return R;
  }

  std::span<const SkeletonJointInfo> joints_;
  SegmentPoser segments_;
  JointOffsets rest_T_;
  std::vector<Matrix3> R_TJoint_;  ///< From each joint to the torso, at rest.
};

void MeasureWorst(const Skeleton& skeleton, SkeletonMotion& motion) {
  for (const SkeletonPose& pose : motion.frames) {
    const JointOffsets own = PlacesAt(skeleton, pose, pose.offset);
    const JointOffsets constant = PlacesAt(skeleton, pose, motion.bones);
    for (std::size_t i = 0; i < own.size(); ++i) {
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

JointOffsets PlacesAt(const Skeleton& skeleton, const SkeletonPose& pose,
                      const JointOffsets& offset) {
  JointOffsets places(skeleton.joints.size());
  std::vector<Matrix3> R(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    const int parent = skeleton.joints[i].parent;
    places[i] = parent < 0 ? pose.offset[i] : places[parent] + R[parent] * offset[i];
    R[i] = parent < 0 ? pose.R[i] : Matrix3(R[parent] * pose.R[i]);
  }
  return places;
}

JointOffsets RestPlaces(const BodyRecord& body) {
  const Poser poser(body, MocapdSkeleton());
  JointOffsets places;
  for (const Vector3& place_T : poser.rest_T()) places.push_back(YUpFromWorld() * place_T);
  return places;
}

SkeletonMotion MakeSkeletonMotion(const Result& result, const Skeleton& skeleton) {
  SkeletonMotion motion;
  const EvenClock clock = FitClock(result.poses);
  motion.period_s = clock.period_s;
  const Poser poser(result.body, skeleton);
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
  motion.bones.front().setZero();
  MeasureWorst(skeleton, motion);
  return motion;
}

}  // namespace mocap
