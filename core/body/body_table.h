// §5: the chain of rotation axes as a table.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/body/body_part.h"
#include "core/body/body_sizes.h"
#include "core/geometry.h"

namespace mocap {

/// One axis of rotation: a row of the body table. Parents precede their children.
struct JointAxis {
  std::string name;
  int paper_angle = 0;  ///< 1..16 as in Table 1; 0: an axis that the paper's body lacks.
  int parent = -1;      ///< Row of the axis that carries this one; -1: the torso.
  Vector3 axis_T = Vector3::UnitX();  ///< Unit vector, at the reference configuration.
  Point at = Point::kTorso;           ///< The joint that the axis passes through.
  double min_rad = 0, max_rad = 0;
  /// Mean and standard deviation of a prior [rad], for angles that voxels hardly show. A standard
  /// deviation of 0 means no prior.
  double rest_rad = 0, rest_std_rad = 0;
  /// For a collarbone: rise of the rest angle when the arm that it carries is level. An overhead
  /// arm adds the same amount again.
  double rise_rad = 0;
};

/// Rigid segments. A table may move several of them by the same axis.
enum class Segment {
  kTorso = 0,
  kPelvis,
  kHead,
  kUpperArmL,
  kUpperArmR,
  kThighL,
  kThighR,
  kLowerArmL,
  kLowerArmR,
  kCalfL,
  kCalfR,
  kShoulderL,  ///< The shoulder girdle.
  kShoulderR,
  kHandL,
  kHandR,
  kFootL,
  kFootR,
  kToesL,
  kToesR
};
inline constexpr int kSegmentCount = 19;

/// The kinematic chain, as selected by `--body`. The code is the same for every table.
struct BodyTable {
  std::string name;
  std::vector<JointAxis> joints;
  JointPlacement placement;
  std::array<int, kSegmentCount>
      carrier{};  ///< Row of the last axis that moves each segment; -1: the torso itself.

  /// Whether the axis in a row moves a segment.
  bool Carries(int row, Segment segment) const {
    int axis = carrier[static_cast<int>(segment)];
    while (axis > row) axis = joints[axis].parent;
    return axis == row;
  }
};

}  // namespace mocap
