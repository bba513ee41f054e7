// What joints of people allow, to hold simulated ones against.
#pragma once

#include <gtest/gtest.h>

#include "drivers/virtual_studio/people/skeleton.h"

namespace mocap::simulation {

inline constexpr double kDegree = 3.14159265358979 / 180;

inline void ExpectWithin(double angle, double low_deg, double high_deg, const char* joint,
                         double t) {
  EXPECT_GE(angle / kDegree, low_deg) << joint << " at " << t << " s";
  EXPECT_LE(angle / kDegree, high_deg) << joint << " at " << t << " s";
}

// Active ranges of motion: AAOS as in Norkin and White (2016); ankle under load: Bennell et al.
// (1998).
inline void ExpectWithinLimits(const BodyPose& pose, double t) {
  for (const int side : {kLeft, kRight}) {
    const LegAngles& leg = pose.legs[side];
    ExpectWithin(leg.flexion, -30, 120, "hip flexion", t);
    ExpectWithin(leg.abduction, -30, 45, "hip abduction", t);
    ExpectWithin(leg.rotation, -45, 45, "hip rotation", t);
    ExpectWithin(leg.knee, 0, 145, "knee", t);
    ExpectWithin(leg.ankle, -55, 46, "ankle", t);
    ExpectWithin(leg.inversion, -35, 35, "foot inversion", t);
    ExpectWithin(leg.foot_turn, -35, 35, "foot turn", t);
    ExpectWithin(leg.toes, -5, 75, "toes", t);
    const ArmAngles& arm = pose.arms[side];
    ExpectWithin(arm.flexion, -60, 180, "shoulder flexion", t);
    ExpectWithin(arm.abduction, 0, 180, "shoulder abduction", t);
    ExpectWithin(arm.rotation, -60, 70, "shoulder rotation", t);
    ExpectWithin(arm.elbow, 0, 145, "elbow", t);
    ExpectWithin(arm.pronation, -80, 80, "pronation", t);
    ExpectWithin(arm.wrist, -60, 70, "wrist", t);
  }
  ExpectWithin(pose.lumbar.flexion + pose.thorax.flexion, -25, 80, "trunk flexion", t);
  ExpectWithin(pose.lumbar.twist + pose.thorax.twist, -45, 45, "trunk twist", t);
  ExpectWithin(pose.neck.flexion + pose.head.flexion, -60, 50, "neck flexion", t);
  ExpectWithin(pose.neck.twist + pose.head.twist, -70, 70, "neck twist", t);
}

}  // namespace mocap::simulation
