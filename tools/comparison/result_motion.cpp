#include "tools/comparison/result_motion.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/degrees.h"
#include "core/errors.h"
#include "tools/comparison/text_motion.h"
#include "tools/interchange/c3d_points.h"
#include "tools/interchange/skeleton_motion.h"
#include "tools/kinematics/euler_angles.h"
#include "tools/kinematics/joint_angles.h"
#include "tools/kinematics/posed_segments.h"
#include "tools/results/export_axes.h"

namespace mocap {
namespace {

/// Points by the beginning of their name, and the segment that markers beside them are worn on.
struct CarriedPoint {
  std::string_view name;
  Segment left, right;
};
constexpr std::array<CarriedPoint, 15> kCarriedPoints = {{
    {"upper_arm", Segment::kUpperArmL, Segment::kUpperArmR},
    {"lower_arm", Segment::kLowerArmL, Segment::kLowerArmR},
    {"thigh", Segment::kThighL, Segment::kThighR},
    {"calf", Segment::kCalfL, Segment::kCalfR},
    {"elbow", Segment::kUpperArmL, Segment::kUpperArmR},
    {"wrist", Segment::kLowerArmL, Segment::kLowerArmR},
    {"knuckles", Segment::kHandL, Segment::kHandR},
    {"fingertips", Segment::kHandL, Segment::kHandR},
    {"hip", Segment::kPelvis, Segment::kPelvis},
    {"knee", Segment::kThighL, Segment::kThighR},
    {"ankle", Segment::kCalfL, Segment::kCalfR},
    {"foot", Segment::kCalfL, Segment::kCalfR},
    {"heel", Segment::kFootL, Segment::kFootR},
    {"ball", Segment::kFootL, Segment::kFootR},
    {"toe", Segment::kFootL, Segment::kFootR},
}};

void AddPoints(const PoseRow& row, const BodyAngles& angles, RecordedMotion& motion) {
  auto track = motion.points.begin();
  for (int i = 0; i < kPointCount; ++i) (track++)->p_mm.push_back(row.points_W.col(i));
  for (int i = 0; i < kFurtherPointCount; ++i) (track++)->p_mm.push_back(row.further_W.col(i));
  (track++)->p_mm.push_back(HipsMiddle(row));
  (track++)->p_mm.push_back(YUpFromWorld().transpose() * (kMmPerMetre * angles.p_GPelvis));
}

void AddAngles(const BodyAngles& angles, RecordedMotion& motion) {
  auto track = motion.angles.begin();
  for (const double rad : CoordinatesOf(angles)) (track++)->deg.push_back(kDegreesPerRad * rad);
  for (const Vector3& turns : C3dAnglesOf(angles))
    for (const double rad : turns) (track++)->deg.push_back(kDegreesPerRad * rad);
}

/// Angles that our exports have as 0, because hinges and silhouettes do not show them.
bool IsAlwaysZero(const std::string& name) {
  const bool is_hinge = name.find("KneeAngles.") != std::string::npos ||
                        name.find("ElbowAngles.") != std::string::npos;
  return (is_hinge && !name.ends_with(".x")) || name.ends_with("WristAngles.z");
}

RecordedMotion EmptyResultMotion() {
  RecordedMotion motion;
  for (const std::string_view name : kPointNames) motion.points.push_back({std::string(name), {}});
  for (const std::string_view name : kFurtherPointNames)
    motion.points.push_back({std::string(name), {}});
  for (const std::string_view name : {kHipsPoint, kPelvisOrigin})
    motion.points.push_back({std::string(name), {}});
  for (const std::string_view name : kCoordinateNames)
    motion.angles.push_back({std::string(name), {}});
  for (const std::string_view name : kC3dAngleNames)
    for (const char* axis : {".x", ".y", ".z"})
      motion.angles.push_back({std::string(name) + axis, {}});
  return motion;
}

void RemoveUnknown(RecordedMotion& motion) {
  std::erase_if(motion.points, [](const PointTrack& track) {
    return std::ranges::none_of(track.p_mm, [](const Vector3& p) { return p.allFinite(); });
  });
  std::erase_if(motion.angles, [](const AngleCurve& track) {
    return IsAlwaysZero(track.name) ||
           std::ranges::none_of(track.deg, [](double deg) { return std::isfinite(deg); });
  });
}

bool IsClose(const Vector3& bone, const Vector3& rest) {
  // Between a T-pose and an A-pose lie about 45 degrees.
  constexpr double kLeastCosine = 0.9063;  // 25 degrees.
  return bone.norm() > 0 && rest.norm() > 0 &&
         bone.normalized().dot(rest.normalized()) > kLeastCosine;
}

/// A joint of both skeletons.
struct SharedJoint {
  std::size_t own;
  const JointTrack* other;
};

/// The joints whose bones lie alike.
std::vector<SharedJoint> SharedJointsOf(const SkeletonMotion& own, const Skeleton& skeleton,
                                        const RecordedMotion& other) {
  std::vector<SharedJoint> shared;
  for (std::size_t i = 0; i + 1 < skeleton.joints.size(); ++i) {
    const SkeletonJointInfo& joint = skeleton.joints[i];
    const auto found = std::ranges::find(other.joints, joint.name, &JointTrack::name);
    if (joint.is_end || joint.parent < 0 || found == other.joints.end()) continue;
    if (IsClose(found->bone, own.bones[i + 1])) shared.push_back({i, &*found});
  }
  return shared;
}

/// Adds the angles of a joint, about the axes of its channels in turn.
void AddTurns(std::string_view name, const std::vector<Matrix3>& R, std::string_view order,
              std::vector<AngleCurve>& tracks) {
  const auto angles_of = order == "ZYX" ? AnglesZyx : AnglesZxy;
  const std::size_t first = tracks.size();
  for (const char* axis :
       order == "ZYX" ? std::array{".z", ".y", ".x"} : std::array{".z", ".x", ".y"})
    tracks.push_back({std::string(name) + axis, {}});
  Vector3 last = Vector3::Zero();
  for (const Matrix3& turn : R) {
    last = NearestEquivalent(angles_of(turn), last);
    for (std::size_t k = 0; k < 3; ++k) tracks[first + k].deg.push_back(kDegreesPerRad * last[k]);
  }
}

/// A joint's rotations in the tracked frames: those between, which an export fills in, are left
/// out.
std::vector<Matrix3> TurnsOf(const Result& result, const SkeletonMotion& motion,
                             std::size_t joint) {
  std::vector<Matrix3> R;
  auto frame = motion.frames.begin();
  for (const PoseRow& row : result.poses) {
    if (!IsTracked(row)) continue;
    while (frame->time_ns < row.timestamp_ns) ++frame;
    R.push_back(frame->R[joint]);
  }
  return R;
}

}  // namespace

Segment ResultMotion::SegmentOf(std::string_view point) {
  for (const CarriedPoint& one : kCarriedPoints) {
    if (point == std::string(one.name) + "_l") return one.left;
    if (point == std::string(one.name) + "_r") return one.right;
  }
  if (point == "head") return Segment::kHead;
  if (point == kHipsPoint || point == kPelvisOrigin) return Segment::kPelvis;
  return Segment::kTorso;
}

ResultMotion MotionOf(const Result& result) {
  ResultMotion made{EmptyResultMotion(), {}};
  const std::vector<BodyAngles> angles = AnglesOf(result);
  if (angles.empty()) throw SetupError("no frame of the result is tracked; expected at least one");
  const SegmentPoser poser(result.body);
  std::size_t next = 0;
  for (const PoseRow& row : result.poses) {
    if (!IsTracked(row)) continue;
    made.motion.time_s.push_back(
        1e-9 * static_cast<double>(row.timestamp_ns - result.poses.front().timestamp_ns));
    AddPoints(row, angles[next], made.motion);
    AddAngles(angles[next++], made.motion);
    const PosedSegments posed = poser.Pose(row);
    auto& R_WS = made.R_WS.emplace_back();
    for (int i = 0; i < kSegmentCount; ++i)
      R_WS[static_cast<std::size_t>(i)] = posed.RotationFromHanging(static_cast<Segment>(i));
  }
  RemoveUnknown(made.motion);
  return made;
}

SkeletonAngles JointAnglesOf(const Result& result, const RecordedMotion& other) {
  SkeletonAngles best;
  for (const Skeleton* skeleton : Skeletons()) {
    const SkeletonMotion own = MakeSkeletonMotion(result, *skeleton);
    const std::vector<SharedJoint> shared = SharedJointsOf(own, *skeleton, other);
    if (3 * shared.size() <= best.result.size()) continue;
    best = {};
    for (const SharedJoint& joint : shared) {
      const std::string_view name = skeleton->joints[joint.own].name;
      AddTurns(name, TurnsOf(result, own, joint.own), skeleton->rotations, best.result);
      AddTurns(name, joint.other->R, skeleton->rotations, best.other);
    }
  }
  return best;
}

}  // namespace mocap
