#include "core/body/body_sizes.h"

namespace mocap {
namespace {

// The clavicle joint, as a share of the shoulder width; the wrist, of the forearm with hand; the
// ankle, of the calf above the sole (Winter 2009, Fig. 4.1: 0.146 of 0.254, and 0.039 of 0.285).
constexpr double kClavicleAside = 0.07;
constexpr double kWristShare = 0.575;
constexpr double kAnkleHeight = 0.137;

/// One side of the body: 1 to the left, -1 to the right, and its points.
struct Side {
  double sign;
  Point shoulder, upper_arm, elbow, lower_arm, fingertips;
  Point hip, thigh, knee, calf, foot;
  Point clavicle, wrist, ankle;
};

constexpr Side kLeft{1,
                     Point::kShoulderL,
                     Point::kUpperArmL,
                     Point::kElbowL,
                     Point::kLowerArmL,
                     Point::kFingertipsL,
                     Point::kHipL,
                     Point::kThighL,
                     Point::kKneeL,
                     Point::kCalfL,
                     Point::kFootL,
                     Point::kClavicleL,
                     Point::kWristL,
                     Point::kAnkleL};
constexpr Side kRight{-1,
                      Point::kShoulderR,
                      Point::kUpperArmR,
                      Point::kElbowR,
                      Point::kLowerArmR,
                      Point::kFingertipsR,
                      Point::kHipR,
                      Point::kThighR,
                      Point::kKneeR,
                      Point::kCalfR,
                      Point::kFootR,
                      Point::kClavicleR,
                      Point::kWristR,
                      Point::kAnkleR};

}  // namespace

BodySizes AverageSizes(double stature_mm) {
  const double h = stature_mm;
  // Children have shorter legs (Bogin and Varela-Silva 2010). Their heads are nearly as large as an
  // adult's (195 mm at 1.15 m, 228 mm at 1.755 m: Snyder et al. 1977, ANSUR). Limb widths follow
  // from circumferences (ANSUR, Gordon et al. 1989). C7/T1 lies 0.148 of the stature below the
  // vertex: docs/poses.md, "Where joints lie".
  const double childhood = std::clamp((1600 - h) / 500, 0.0, 1.0);
  const double leg_share = 1 - 0.07 * childhood;
  const double head = 228 + 0.0545 * (h - 1755);
  const double neck = 0.64 * head;
  const double thigh = 0.245 * leg_share * h;
  const double calf = 0.285 * leg_share * h;
  return {.torso = h - head / 2 - neck - thigh - calf,
          .torso_width = 0.180 * h,
          .torso_depth = 0.130 * h,
          .head = head,
          .head_width = 0.75 * head,
          .neck = neck,
          .upper_arm = 0.162 * h,
          .lower_arm = 0.258 * h,
          .thigh = thigh,
          .calf = calf,
          .upper_arm_width = 0.058 * h,
          .lower_arm_width = 0.042 * h,
          .thigh_width = 0.105 * h,
          .calf_width = 0.068 * h,
          .shoulder_width = 0.207 * h,
          .hip_width = 0.110 * h};
}

BodyPlaces ReferencePoints(const BodySizes& s, const JointPlacement& placement) {
  const double top = s.torso / 2;
  BodyPlaces p;
  const auto at = [&p](Point point) { return p.col(static_cast<int>(point)); };
  at(Point::kTorso).setZero();
  at(Point::kNeck) << -placement.neck_behind * s.torso, 0, top;
  at(Point::kHead) = at(Point::kNeck);
  at(Point::kHead) += Eigen::Vector3d(placement.head_forward * s.neck, 0, s.neck);
  for (const Side& on : {kLeft, kRight}) {
    at(on.shoulder) << -placement.shoulder_behind * s.torso, on.sign * s.shoulder_width / 2,
        top - placement.shoulder_below_neck * s.torso;
    at(on.elbow) = at(on.shoulder);
    at(on.elbow).y() += on.sign * s.upper_arm;
    at(on.fingertips) = at(on.elbow);
    at(on.fingertips).y() += on.sign * s.lower_arm;
    at(on.hip) << -placement.hip_behind * s.torso, on.sign * s.hip_width / 2, -top;
    at(on.knee) = at(on.hip);
    at(on.knee).z() -= s.thigh;
    at(on.foot) = at(on.knee);
    at(on.foot).z() -= s.calf;
    at(on.upper_arm) = (at(on.shoulder) + at(on.elbow)) / 2;
    at(on.lower_arm) = (at(on.elbow) + at(on.fingertips)) / 2;
    at(on.thigh) = (at(on.hip) + at(on.knee)) / 2;
    at(on.calf) = (at(on.knee) + at(on.foot)) / 2;
    at(on.clavicle) << at(on.shoulder).x(), on.sign * kClavicleAside * s.shoulder_width,
        top - placement.clavicle_below_neck * s.torso;
    at(on.wrist) = at(on.elbow) + kWristShare * (at(on.fingertips) - at(on.elbow));
    at(on.ankle) = at(on.foot);
    at(on.ankle).z() += kAnkleHeight * s.calf;
  }
  return p;
}

}  // namespace mocap
