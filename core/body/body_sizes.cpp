#include "core/body/body_sizes.h"

namespace mocap {
namespace {

// The clavicle joint, as a share of the shoulder width; the wrist, of the forearm with hand; the
// ankle, of the calf above the sole (Winter 2009, Fig. 4.1: 0.146 of 0.254, and 0.039 of 0.285).
constexpr double kClavicleAside = 0.07;
constexpr double kWristShare = 0.575;
constexpr double kAnkleHeight = 0.137;

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
  const auto middle = [&p](Point point) { return p.col(static_cast<int>(point)); };
  middle(Point::kTorso).setZero();
  middle(Point::kNeck) << -placement.neck_behind * s.torso, 0, top;
  middle(Point::kHead) = middle(Point::kNeck);
  middle(Point::kHead) += Eigen::Vector3d(placement.head_forward * s.neck, 0, s.neck);
  for (const int right : {0, 1}) {
    // A point of the right side follows that of the left.
    const auto at = [&](Point left) { return p.col(static_cast<int>(left) + right); };
    const double side = right ? -1 : 1;
    at(Point::kShoulderL) << -placement.shoulder_behind * s.torso, side * s.shoulder_width / 2,
        top - placement.shoulder_below_neck * s.torso;
    at(Point::kElbowL) = at(Point::kShoulderL);
    at(Point::kElbowL).y() += side * s.upper_arm;
    at(Point::kFingertipsL) = at(Point::kElbowL);
    at(Point::kFingertipsL).y() += side * s.lower_arm;
    at(Point::kHipL) << -placement.hip_behind * s.torso, side * s.hip_width / 2, -top;
    at(Point::kKneeL) = at(Point::kHipL);
    at(Point::kKneeL).z() -= s.thigh;
    at(Point::kFootL) = at(Point::kKneeL);
    at(Point::kFootL).z() -= s.calf;
    at(Point::kUpperArmL) = (at(Point::kShoulderL) + at(Point::kElbowL)) / 2;
    at(Point::kLowerArmL) = (at(Point::kElbowL) + at(Point::kFingertipsL)) / 2;
    at(Point::kThighL) = (at(Point::kHipL) + at(Point::kKneeL)) / 2;
    at(Point::kCalfL) = (at(Point::kKneeL) + at(Point::kFootL)) / 2;
    at(Point::kClavicleL) << at(Point::kShoulderL).x(), side * kClavicleAside * s.shoulder_width,
        top - placement.clavicle_below_neck * s.torso;
    at(Point::kWristL) =
        at(Point::kElbowL) + kWristShare * (at(Point::kFingertipsL) - at(Point::kElbowL));
    at(Point::kAnkleL) = at(Point::kFootL);
    at(Point::kAnkleL).z() += kAnkleHeight * s.calf;
  }
  return p;
}

}  // namespace mocap
