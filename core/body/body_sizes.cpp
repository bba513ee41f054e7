#include "core/body/body_sizes.h"

namespace mocap {
namespace {

// Where joints lie behind the middle of the trunk's flesh and below the neck, as shares of the
// torso's length. The spine runs behind the trunk's middle, the hip joints a little behind it; the
// shoulder joint lies 0.05 of the stature below C7/T1 (Reed, Manary, Schneider 1999; Winter 2009,
// Fig. 4.1).
constexpr double kNeckBehind = 0.06;
constexpr double kHipBehind = 0.03;
constexpr double kShoulderBehind = 0.03;
constexpr double kShoulderBelowNeck = 0.19;
// The head's centre leans forward of C7/T1 by this share of its height above it.
constexpr double kHeadForward = 0.35;
// Joints between the shoulders, as a share of the width between these; in the forearm with the
// hand, and above the sole (Winter 2009, Fig. 4.1: 0.146 of 0.254, and 0.039 of 0.285).
constexpr double kClavicleAside = 0.07;
constexpr double kWristShare = 0.575;
constexpr double kAnkleHeight = 0.137;

}  // namespace

BodySizes AverageSizes(double stature_mm) {
  const double h = stature_mm;
  return {.torso = 0.330 * h,
          .torso_width = 0.180 * h,
          .torso_depth = 0.130 * h,
          .head = 0.130 * h,
          .head_width = 0.098 * h,
          .neck = 0.075 * h,
          .upper_arm = 0.162 * h,
          .lower_arm = 0.258 * h,
          .thigh = 0.245 * h,
          .calf = 0.285 * h,
          .upper_arm_width = 0.055 * h,
          .lower_arm_width = 0.042 * h,
          .thigh_width = 0.090 * h,
          .calf_width = 0.060 * h,
          .shoulder_width = 0.207 * h,
          .hip_width = 0.110 * h};
}

BodyPlaces ReferencePoints(const BodySizes& s) {
  const double top = s.torso / 2;
  BodyPlaces p;
  const auto at = [&p](Point point) { return p.col(static_cast<int>(point)); };
  at(Point::kTorso).setZero();
  at(Point::kNeck) << -kNeckBehind * s.torso, 0, top;
  at(Point::kHead) = at(Point::kNeck);
  at(Point::kHead) += Eigen::Vector3d(kHeadForward * s.neck, 0, s.neck);
  const auto set_side = [&](double side, Point shoulder, Point upper_arm, Point elbow,
                            Point lower_arm, Point fingertips, Point hip, Point thigh, Point knee,
                            Point calf, Point foot, Point clavicle, Point wrist, Point ankle) {
    at(shoulder) << -kShoulderBehind * s.torso, side * s.shoulder_width / 2,
        top - kShoulderBelowNeck * s.torso;
    at(elbow) = at(shoulder);
    at(elbow).y() += side * s.upper_arm;
    at(fingertips) = at(elbow);
    at(fingertips).y() += side * s.lower_arm;
    at(hip) << -kHipBehind * s.torso, side * s.hip_width / 2, -top;
    at(knee) = at(hip);
    at(knee).z() -= s.thigh;
    at(foot) = at(knee);
    at(foot).z() -= s.calf;
    at(upper_arm) = (at(shoulder) + at(elbow)) / 2;
    at(lower_arm) = (at(elbow) + at(fingertips)) / 2;
    at(thigh) = (at(hip) + at(knee)) / 2;
    at(calf) = (at(knee) + at(foot)) / 2;
    at(clavicle) << at(shoulder).x(), side * kClavicleAside * s.shoulder_width, at(shoulder).z();
    at(wrist) = at(elbow) + kWristShare * (at(fingertips) - at(elbow));
    at(ankle) = at(foot);
    at(ankle).z() += kAnkleHeight * s.calf;
  };
  set_side(1, Point::kShoulderL, Point::kUpperArmL, Point::kElbowL, Point::kLowerArmL,
           Point::kFingertipsL, Point::kHipL, Point::kThighL, Point::kKneeL, Point::kCalfL,
           Point::kFootL, Point::kClavicleL, Point::kWristL, Point::kAnkleL);
  set_side(-1, Point::kShoulderR, Point::kUpperArmR, Point::kElbowR, Point::kLowerArmR,
           Point::kFingertipsR, Point::kHipR, Point::kThighR, Point::kKneeR, Point::kCalfR,
           Point::kFootR, Point::kClavicleR, Point::kWristR, Point::kAnkleR);
  return p;
}

}  // namespace mocap
