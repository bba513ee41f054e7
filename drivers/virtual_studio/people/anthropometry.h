// Sizes of a simulated person.
#pragma once

#include <cstdint>

namespace mocap::simulation {

/// Lengths of a person's segments [mm], from joint centre to joint centre, and the build.
///
/// Standing upright: sole to vertex is `stature_mm`, hips lie at hip_height_mm(), the neck (C7/T1)
/// torso_mm above them.
struct Anthropometry {
  double stature_mm = 0;
  double girth = 0;       ///< -1 slim, 0 average, 1 heavy.
  double femininity = 0;  ///< 0 a man's shape, 1 a woman's.

  double ankle_to_sole_mm = 0, shank_mm = 0, thigh_mm = 0;  ///< Shank: knee to ankle.
  double hip_half_mm = 0;                                   ///< Midline to hip joint.
  double lumbar_mm = 0, thorax_mm = 0, torso_mm = 0;  ///< Hips to L4, to T10 and to C7, along z.
  double shoulder_mm = 0;                             ///< Hips to shoulder joint, along z.
  double shoulder_half_mm = 0;                        ///< Midline to shoulder joint.
  double upper_arm_mm = 0, forearm_mm = 0, hand_mm = 0;
  double skull_base_mm = 0;  ///< C7 to the joint under the skull, along z.
  double head_mm = 0;        ///< Chin to vertex.
  double foot_mm = 0, heel_mm = 0,
         ball_mm = 0;  ///< Foot length; ankle back to heel; ankle forward to ball.

  double hip_height_mm() const { return ankle_to_sole_mm + shank_mm + thigh_mm; }
  double leg_mm() const { return shank_mm + thigh_mm; }
  double calf_mm() const { return shank_mm + ankle_to_sole_mm; }
  double lower_arm_mm() const { return forearm_mm + hand_mm; }
};

/// Computes the sizes of a person of a given stature. The seed determines build and small
/// deviations from the mean.
Anthropometry MakeAnthropometry(double stature_mm, std::uint64_t seed);

}  // namespace mocap::simulation
