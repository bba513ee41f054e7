// Names of joints: of body tables, messages, results and what is exported.
#pragma once

#include <array>
#include <string_view>

#include "core/body/body_part.h"

namespace mocap {

/// Names of the paper's sixteen angles in the built-in body tables, in the order of Table 1.
inline constexpr std::array<std::string_view, kPaperAngleCount> kPaperJointNames = {
    "neck_x",       "neck_y",       "shoulder_l_x", "shoulder_r_x", "shoulder_l_z", "shoulder_r_z",
    "shoulder_l_y", "shoulder_r_y", "elbow_l_z",    "elbow_r_z",    "hip_l_x",      "hip_r_x",
    "hip_l_y",      "hip_r_y",      "knee_l_y",     "knee_r_y"};

/// Whether a joint may have this name: lower-case letters, digits and _, and no other column of
/// poses.csv is called so.
bool IsJointName(std::string_view name);

}  // namespace mocap
