// Fig. 3: the four limbs, each of two parts.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "core/body/body_sizes.h"
#include "core/geometry.h"

namespace mocap::mikic2003 {

inline constexpr int kLimbCount = 4;

/// Proportions of Table 3: length of a part per millimetre of the torso's length.
inline constexpr double kThighPerTorso = 0.9;
inline constexpr double kCalfPerTorso = 1.0;
inline constexpr double kUpperArmPerTorso = 0.55;
inline constexpr double kLowerArmPerTorso = 0.75;

/// A limb: its parts, the points of Table 2 on it, and the members of its sizes.
struct Limb {
  BodyPart upper, lower;
  Point root, joint, end;
  SizeMember upper_length, lower_length;
  SizeMember upper_width, lower_width;
  double upper_share;  ///< Share of the upper part in a straight limb's length, by Table 3.
};

inline constexpr double kUpperArmShare =
    kUpperArmPerTorso / (kUpperArmPerTorso + kLowerArmPerTorso);
inline constexpr double kThighShare = kThighPerTorso / (kThighPerTorso + kCalfPerTorso);

/// Arms, then legs; the left one of each first.
inline constexpr std::array<Limb, kLimbCount> kLimbs = {
    Limb{BodyPart::kUpperArmL, BodyPart::kLowerArmL, Point::kShoulderL, Point::kElbowL,
         Point::kFingertipsL, &BodySizes::upper_arm, &BodySizes::lower_arm,
         &BodySizes::upper_arm_width, &BodySizes::lower_arm_width, kUpperArmShare},
    Limb{BodyPart::kUpperArmR, BodyPart::kLowerArmR, Point::kShoulderR, Point::kElbowR,
         Point::kFingertipsR, &BodySizes::upper_arm, &BodySizes::lower_arm,
         &BodySizes::upper_arm_width, &BodySizes::lower_arm_width, kUpperArmShare},
    Limb{BodyPart::kThighL, BodyPart::kCalfL, Point::kHipL, Point::kKneeL, Point::kFootL,
         &BodySizes::thigh, &BodySizes::calf, &BodySizes::thigh_width, &BodySizes::calf_width,
         kThighShare},
    Limb{BodyPart::kThighR, BodyPart::kCalfR, Point::kHipR, Point::kKneeR, Point::kFootR,
         &BodySizes::thigh, &BodySizes::calf, &BodySizes::thigh_width, &BodySizes::calf_width,
         kThighShare}};

/// Returns the mean of what was measured on the left and on the right.
inline std::optional<double> MeanOf(std::optional<double> left, std::optional<double> right) {
  if (left && right) return (*left + *right) / 2;
  return left ? left : right;
}

/// The 23 points of Table 2, p_WQ [mm]. Points of parts with too few voxels are absent.
using MeasuredPoints = std::array<std::optional<Vector3>, kPointCount>;

inline std::optional<Vector3>& At(MeasuredPoints& points, Point point) {
  return points[static_cast<std::size_t>(point)];
}
inline const std::optional<Vector3>& At(const MeasuredPoints& points, Point point) {
  return points[static_cast<std::size_t>(point)];
}

}  // namespace mocap::mikic2003
