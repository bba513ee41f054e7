// Points of a person that pose networks find in pictures, and where the body model has them.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "core/body/body_model.h"

namespace mocap {

/// The points of COCO-17, HALPE-26 and BlazePose-33 that the body model has a place for; docs/
/// clients.md maps them. Left ones are followed by right ones.
enum class Landmark {
  kNose = 0,
  kEyeL,
  kEyeR,
  kEarL,
  kEarR,
  kMouthL,
  kMouthR,
  kTopOfHead,
  kNeck,
  kShoulderL,
  kShoulderR,
  kElbowL,
  kElbowR,
  kWristL,
  kWristR,
  kPinkyL,  ///< Knuckle of the little finger.
  kPinkyR,
  kIndexL,  ///< Knuckle of the index finger.
  kIndexR,
  kHipMiddle,
  kHipL,
  kHipR,
  kKneeL,
  kKneeR,
  kAnkleL,
  kAnkleR,
  kHeelL,
  kHeelR,
  kBigToeL,
  kBigToeR,
  kSmallToeL,
  kSmallToeR
};
inline constexpr int kLandmarkCount = 32;

/// Returns the name of a landmark, as in `shoulder_l`.
std::string NameOf(Landmark landmark);
/// Finds a landmark by our name, or by that of COCO, HALPE or BlazePose: `shoulder_l`,
/// `left_shoulder`, `LShoulder`. Capitals and underscores do not matter. Empty: none of ours, as
/// BlazePose's thumbs.
std::optional<Landmark> LandmarkNamed(std::string_view name);
/// Returns the same landmark of the other side; itself in the middle.
Landmark Mirrored(Landmark landmark);

/// A landmark on a body: a point that an axis carries.
struct LandmarkPlace {
  int carrier = -1;               ///< Row of the axis that moves it; -1: the torso.
  Vector3 p_T = Vector3::Zero();  ///< At the reference configuration [mm].
};

using LandmarkPlaces = std::array<LandmarkPlace, kLandmarkCount>;

/// Places all landmarks on a body.
LandmarkPlaces PlaceLandmarks(const BodyModel& body);

/// Predicts where a landmark is, for one posture [mm].
Vector3 PlaceIn(const Posture& posture, const LandmarkPlace& place);

}  // namespace mocap
