#include "core/body/body_sizes.h"

namespace mocap {
namespace {

// The clavicle joint, as a share of the shoulder width; the wrist, of the forearm with hand; the
// ankle, of the calf above the sole (Winter 2009, Fig. 4.1: 0.146 of 0.254, and 0.039 of 0.285).
constexpr double kClavicleAside = 0.07;
constexpr double kWristShare = 0.575;
constexpr double kAnkleHeight = 0.137;
// The knuckles, of the hand (de Leva 1996: 86 of 188 mm).
constexpr double kKnucklesShare = 0.46;
// Heel, ball and toe before the ankle, of the foot's length. The heel's bone ends 49 mm behind the
// ankle (Rajagopal et al. 2016), its flesh a quarter of the foot behind it; the ball lies 0.73 of
// the foot before the heel (ANSUR, Gordon et al. 1989). All lie where a bare foot touches the
// floor, on top of the sole of a shoe.
constexpr double kHeelShare = -0.25, kBallShare = 0.48, kToeShare = 0.75;

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
    const Eigen::Vector3d shoulder = at(Point::kShoulderL);
    const Eigen::Vector3d elbow = shoulder + Eigen::Vector3d(0, side * s.upper_arm, 0);
    const Eigen::Vector3d tips = elbow + Eigen::Vector3d(0, side * s.lower_arm, 0);
    const Eigen::Vector3d wrist = elbow + kWristShare * (tips - elbow);
    at(Point::kElbowL) = elbow;
    at(Point::kFingertipsL) = tips;
    at(Point::kUpperArmL) = (shoulder + elbow) / 2;
    at(Point::kLowerArmL) = (elbow + tips) / 2;
    at(Point::kWristL) = wrist;
    at(Point::kKnucklesL) = wrist + kKnucklesShare * (tips - wrist);
    at(Point::kClavicleL) << shoulder.x(), side * kClavicleAside * s.shoulder_width,
        top - placement.clavicle_below_neck * s.torso;

    const Eigen::Vector3d hip(-placement.hip_behind * s.torso, side * s.hip_width / 2, -top);
    const Eigen::Vector3d knee = hip - Eigen::Vector3d(0, 0, s.thigh);
    const Eigen::Vector3d sole = knee - Eigen::Vector3d(0, 0, s.calf);
    at(Point::kHipL) = hip;
    at(Point::kKneeL) = knee;
    at(Point::kFootL) = sole;
    at(Point::kThighL) = (hip + knee) / 2;
    at(Point::kCalfL) = (knee + sole) / 2;
    at(Point::kAnkleL) = sole + Eigen::Vector3d(0, 0, kAnkleHeight * s.calf);
    const double foot = s.FootLength();
    at(Point::kHeelL) = sole + Eigen::Vector3d(kHeelShare * foot, 0, 0);
    at(Point::kBallL) = sole + Eigen::Vector3d(kBallShare * foot, 0, 0);
    at(Point::kToeL) = sole + Eigen::Vector3d(kToeShare * foot, 0, 0);
  }
  return p;
}

}  // namespace mocap
