// A result as a recorded motion, with all angles that other programs' files may have.
#pragma once

#include <array>
#include <vector>

#include "core/body/body_table.h"
#include "tools/comparison/recorded_motion.h"
#include "tools/results/result.h"

namespace mocap {

/// The midpoint of the hip joints, which a result has beside its points.
inline constexpr std::string_view kHipsPoint = "hips";

/// A result's tracked frames. Points are in the world frame by the names of poses.csv, and
/// kHipsPoint and kPelvisOrigin; those not seen at all are left out. Angles have their names in
/// OpenSim's models (knee_angle_l) and in Plug-in Gait (LKneeAngles.x).
struct ResultMotion {
  RecordedMotion motion;  ///< Time 0: the result's first frame.
  /// Rotation of each segment to the world in each frame: x ahead, y to the left, z up of a person
  /// who stands with hanging arms.
  std::vector<std::array<Matrix3, kSegmentCount>> R_WS;

  /// The segment in whose frame a point's differences are measured: the one before a joint.
  static Segment SegmentOf(std::string_view point);
};

/// @throws SetupError  when no frame is tracked.
ResultMotion MotionOf(const Result& result);

/// Joint angles of a skeleton file and those that our export of a result would have.
struct SkeletonAngles {
  std::vector<AngleCurve> result, other;  ///< By the same names: LeftLeg.z, LeftLeg.x, LeftLeg.y.
};

/// Compares joints by the skeleton of our exports whose bones lie in their joints' axes as the
/// file's do: angles of other axes mean something else. The root turns relative to the world of its
/// file, and is left out.
/// @param other  with joints. @return  empty if no skeleton's bones lie so.
SkeletonAngles JointAnglesOf(const Result& result, const RecordedMotion& other);

}  // namespace mocap
