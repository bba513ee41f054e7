// §5: sizes of a person's body parts, and the joint positions that follow from them.
#pragma once

#include <Eigen/Core>
#include <array>

#include "core/body/body_part.h"

namespace mocap {

/// A person's sizes [mm]. These are full sizes, the paper's 2λ.
struct BodySizes {
  double torso = 0;  ///< Hip line to neck joint, C7/T1.
  double torso_width = 0;
  double torso_depth = 0;
  double head = 0;        ///< Chin to vertex.
  double head_width = 0;  ///< Mean of breadth and depth.
  double neck = 0;        ///< Neck joint to the head's centre.
  double upper_arm = 0;
  double lower_arm = 0;  ///< Elbow to fingertips.
  double thigh = 0;
  double calf = 0;  ///< Knee to sole.
  double upper_arm_width = 0;
  double lower_arm_width = 0;
  double thigh_width = 0;
  double calf_width = 0;
  double shoulder_width = 0;  ///< Joint to joint.
  double hip_width = 0;       ///< Joint to joint.

  /// How far a skirt or a coat hangs off the leg: at the hip, at the knee, at the thickest place of
  /// the calf and at the ankle. Beyond the paper.
  double drape_hip = 0;
  double drape_knee = 0;
  double drape_calf = 0;
  double drape_ankle = 0;

  bool IsDraped() const { return drape_hip + drape_knee + drape_calf + drape_ankle > 0; }

  /// Height from sole to vertex when standing upright.
  double Stature() const { return calf + thigh + torso + neck + head / 2; }

  /// From heel to toe: Winter 2009, Fig. 4.1.
  double FootLength() const { return 0.152 * Stature(); }

  bool operator==(const BodySizes&) const = default;
};

using SizeMember = double BodySizes::*;

/// Widths that are correlated: a stout person is stout all over. As shares of the average, they
/// correlate among people by about 0.75 (circumferences of limbs, depths and breadths of the trunk;
/// ANSUR, Gordon et al. 1989).
inline constexpr std::array<SizeMember, 6> kStoutWidths = {
    &BodySizes::torso_width,     &BodySizes::torso_depth, &BodySizes::upper_arm_width,
    &BodySizes::lower_arm_width, &BodySizes::thigh_width, &BodySizes::calf_width};
inline constexpr double kWidthCorrelation = 0.75;

inline constexpr std::array<SizeMember, 4> kDrapeSizes = {
    &BodySizes::drape_hip, &BodySizes::drape_knee, &BodySizes::drape_calf, &BodySizes::drape_ankle};

/// Returns the sizes of an average adult of a given stature [mm].
///
/// Segment lengths follow Drillis and Contini (1966) as in Winter, Biomechanics and Motor Control
/// of Human Movement, 4th ed. (2009), Fig. 4.1. Joint-to-joint widths and thicknesses follow the
/// same source and de Leva (1996).
BodySizes AverageSizes(double stature_mm);

using BodyPoints = Eigen::Matrix<double, 3, kPointCount>;

/// The points that follow the 23.
using FurtherPoints = Eigen::Matrix<double, 3, kFurtherPointCount>;

/// One of them.
inline FurtherPoints::ColXpr FurtherOf(FurtherPoints& further, Point point) {
  return further.col(static_cast<int>(point) - kPointCount);
}
inline FurtherPoints::ConstColXpr FurtherOf(const FurtherPoints& further, Point point) {
  return further.col(static_cast<int>(point) - kPointCount);
}

/// All points.
using BodyPlaces = Eigen::Matrix<double, 3, kPlaceCount>;

/// Offsets of the joints behind the middle of the trunk and below the neck, as shares of the
/// torso's length. The defaults are anatomical. With zeros the joints lie in the middle, as in the
/// paper's Fig. 3.
///
/// The spine runs behind the middle of the trunk, the hip joints slightly behind it. With the arm
/// hanging, the shoulder joint lies 0.061 of the stature below C7/T1: 50 mm below the acromion of
/// an average man, in the middle between Rab, Petuskey, Bagley (2002) and de Leva (1996). The upper
/// end of the breastbone lies 0.05 below the tip of C7 (de Leva 1996). docs/poses.md has all
/// sources.
struct JointPlacement {
  double neck_behind = 0.06;
  double hip_behind = 0.03;
  double shoulder_behind = 0.03;
  double shoulder_below_neck = 0.189;
  double clavicle_below_neck = 0.130;
  /// Forward offset of the head's centre from C7/T1, as a share of its height above C7/T1.
  double head_forward = 0.316;
};

/// Computes points and joints at the reference configuration, in the torso's frame; 3 × 37, column
/// i is p_TQ of point i [mm]. Mikić et al. 2003, Fig. 3 and Table 2.
BodyPlaces ReferencePoints(const BodySizes& sizes, const JointPlacement& placement);

}  // namespace mocap
