// Gait: feet stay in place, roll from heel to toe and swing to the next place. Both legs reach the
// pelvis. Arms swing against the legs.
#pragma once

#include <array>
#include <functional>
#include <span>

#include "drivers/virtual_studio/curve.h"
#include "drivers/virtual_studio/people/skeleton.h"

namespace mocap::simulation {

inline constexpr double kGravity = 9810;  // mm/s²

/// Places a foot on the ground.
///
/// @param p_WSole   point on the ground under the ankle when the foot is flat.
/// @param yaw       direction of the toes [rad].
/// @param pitch     positive: heel up, rolling about the ball; negative: toes up, about the heel
/// [rad].
/// @param toe_grip  1: the toes stay flat when the heel is up; 0: they point with the foot.
/// @param rounding  range of pitch in which the pivot moves between heel and ball [rad].
FootTarget RollFoot(const Anthropometry& body, const Vector3& p_WSole, double yaw, double pitch,
                    double toe_grip = 1, double rounding = 0.04);

/// Sets the pelvis to the wanted height or, with a smooth limit, to what both legs reach. Then
/// places the legs.
void StandOn(const Anthropometry& body, const std::array<FootTarget, 2>& feet,
             double wanted_height_mm, BodyPose& pose);

/// Distributes flexion, bend and twist of the trunk over the joints from pelvis to thorax. Keeps
/// the gaze level by the share `gaze` of flexion and twist.
void BendTrunk(double flexion, double bend, double twist, double gaze, BodyPose& pose);

/// Raises the collar bones with the arms (scapulohumeral rhythm, Inman et al. 1944).
void FollowWithClavicles(BodyPose& pose);

/// Position and heading of the whole body.
struct Track {
  Vector2 p_W = Vector2::Zero();
  double yaw = 0;
};

struct GaitStyle {
  double step_s = 0.55;  ///< From one foot's contact to the other's.
  double duty = 0.62;    ///< Share of its cycle that a foot is on the ground; below 0.5: running.
  double full_step_mm = 0;  ///< Step length at which the foot rolls fully.
  double half_width_mm = 0, toe_out = 0, lift_mm = 0;
  std::span<const Key> roll;  ///< The foot's pitch over its cycle [rad]; 0 is the contact.
  double height_mm = 0, bounce_mm = 0, sway_mm = 0;  ///< Of the pelvis.
  double hip_yaw = 0, hip_list = 0, lean = 0;
  double arm_swing = 0, arm_out = 0, elbow = 0, elbow_swing = 0;
};

GaitStyle WalkingStyle(const Anthropometry& body);
GaitStyle RunningStyle(const Anthropometry& body);
/// Steps from side to side.
GaitStyle DancingStyle(const Anthropometry& body);

/// A body whose feet follow a track.
class Gait {
 public:
  Gait(const Anthropometry& body, const GaitStyle& style, std::function<Track(double t_s)> track);

  /// The pose at a time [s].
  BodyPose PoseAt(double t_s) const;
  /// Share of a foot's cycle that has passed: 0 at its contact.
  double PhaseOf(int side, double t_s) const;

 private:
  struct Plant {
    Vector3 p_WSole;
    double yaw;
  };
  Plant PlantOf(int side, double cycle) const;
  FootTarget FootAt(int side, double t_s) const;
  double EffortBetween(const Plant& a, const Plant& b) const;

  const Anthropometry body_;
  const GaitStyle style_;
  const std::function<Track(double)> track_;
};

}  // namespace mocap::simulation
