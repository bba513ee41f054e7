// The columns of truth.csv after frame and timestamp_ns. Points and contacts have the same names in
// poses.csv.
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/geometry.h"

namespace mocap {

/// Segments whose true orientation is written.
inline constexpr std::array<std::string_view, 3> kTurnedSegmentNames = {"head", "hand_l", "hand_r"};

/// <point>_x_mm, <point>_y_mm, <point>_z_mm
inline std::array<std::string, 3> PointColumns(std::string_view point) {
  const std::string name(point);
  return {name + "_x_mm", name + "_y_mm", name + "_z_mm"};
}
/// <segment>_rotation_x_rad, <segment>_rotation_y_rad, <segment>_rotation_z_rad
inline std::array<std::string, 3> RotationColumns(std::string_view segment) {
  const std::string name = std::string(segment) + "_rotation";
  return {name + "_x_rad", name + "_y_rad", name + "_z_rad"};
}
/// contact_<point>
inline std::string ContactColumn(std::string_view point) { return "contact_" + std::string(point); }

/// What a table of truth names, in order.
struct TruthColumns {
  std::vector<std::string> points;
  std::vector<std::string> rotations = {};  ///< Segments.
  std::vector<std::string> contacts = {};   ///< Points of the feet.
};

/// A row of truth, in the order of its columns.
struct TruthRow {
  std::span<const Vector3> points_W;        ///< p_WQ [mm].
  std::span<const Vector3> rotations = {};  ///< Rotation vectors, from segment to world [rad].
  std::span<const bool> contacts = {};      ///< With the floor.
};

}  // namespace mocap
