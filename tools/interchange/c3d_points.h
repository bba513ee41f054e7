// The points of a C3D file: of a body, and its angles.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "tools/kinematics/joint_angles.h"
#include "tools/results/result.h"

namespace mocap {

/// Markers beside the 23 points, with the names of Vicon's Plug-in Gait. They are points of the
/// tracked body, not of its skin.
struct C3dMarker {
  std::string_view name;
  Point point;
};
inline constexpr std::array<C3dMarker, 8> kC3dMarkers = {{
    {"LHEE", Point::kHeelL},
    {"RHEE", Point::kHeelR},
    {"LTOE", Point::kToeL},
    {"RTOE", Point::kToeR},
    {"LANK", Point::kAnkleL},
    {"RANK", Point::kAnkleR},
    {"LWRA", Point::kWristL},
    {"RWRA", Point::kWristR},
}};

/// Angles with the names, axes and signs of Plug-in Gait.
inline constexpr std::array<std::string_view, 19> kC3dAngleNames = {
    "LHipAngles",      "RHipAngles",    "LKneeAngles",  "RKneeAngles",   "LShoulderAngles",
    "RShoulderAngles", "LElbowAngles",  "RElbowAngles", "SpineAngles",   "LAnkleAngles",
    "RAnkleAngles",    "LWristAngles",  "RWristAngles", "LPelvisAngles", "RPelvisAngles",
    "LThoraxAngles",   "RThoraxAngles", "LHeadAngles",  "RHeadAngles"};

inline constexpr std::size_t kC3dPointCount =
    kPointCount + kC3dMarkers.size() + kC3dAngleNames.size();

/// Returns the angles [rad] in the order of kC3dAngleNames: of limbs x flexion, y adduction (of the
/// shoulder abduction), z internal rotation; NaN: not known. docs/interchange.md has a table.
std::array<Vector3, kC3dAngleNames.size()> C3dAnglesOf(const BodyAngles& angles);

}  // namespace mocap
