#include "tools/kinematics/joint_angles.h"

#include <algorithm>
#include <cmath>

#include "core/degrees.h"
#include "tools/kinematics/euler_angles.h"
#include "tools/kinematics/rest_body.h"
#include "tools/results/export_axes.h"

namespace mocap {
namespace {

/// A straighter limb does not show its rotation about itself; one bent by more than kBent shows it
/// fully.
constexpr double kStraight_rad = 10 / kDegreesPerRad, kBent_rad = 20 / kDegreesPerRad;
constexpr double kQuarter_rad = EIGEN_PI / 2;

/// Position of the hip joints in the pelvis of Rajagopal's model, and their distance [m].
constexpr double kHipForward_m = -0.056276, kHipUp_m = -0.07849, kHipsApart_m = 2 * 0.07726;

/// Converts axes x forward, y left, z up to OpenSim's: x forward, y up, z right.
Matrix3 SimFromBody() {
  Matrix3 R;
  R << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  return R;
}

double SmoothStep(double share) {
  const double s = std::clamp(share, 0.0, 1.0);
  return s * s * (3 - 2 * s);
}

/// Direction in which a hinge bends the lower part: forward like an elbow, backward like a knee.
enum class Bends { kForward = 1, kBackward = -1 };

/// Angles z, x, y of the upper part and bend of the hinge, mirrored to a right limb.
struct Turns {
  Vector3 zxy;
  double bend;
};

/// @param upper, lower  unit vectors along the parts, in the parent's OpenSim axes.
Turns TurnsOf(const Vector3& upper, const Vector3& lower, Bends bends) {
  const double x = std::asin(std::clamp(-upper.z(), -1.0, 1.0));
  const double z = std::atan2(upper.x(), -upper.y());
  const Matrix3 R_zx =
      (Eigen::AngleAxisd(z, Vector3::UnitZ()) * Eigen::AngleAxisd(x, Vector3::UnitX()))
          .toRotationMatrix();
  const Vector3 hinged = R_zx.transpose() * lower;
  const double sign = static_cast<int>(bends);
  const double aside = std::hypot(hinged.x(), hinged.z());
  const double shown =
      (std::atan2(aside, -hinged.y()) - kStraight_rad) / (kBent_rad - kStraight_rad);
  double y = std::atan2(-sign * hinged.z(), sign * hinged.x());
  // A nearly straight limb that bends the wrong way is hyperextended, not rotated.
  if (shown < 1 && std::abs(y) > kQuarter_rad) y -= std::copysign(2 * kQuarter_rad, y);
  y *= SmoothStep(shown);
  const double bend =
      std::atan2(sign * (hinged.x() * std::cos(y) - hinged.z() * std::sin(y)), -hinged.y());
  return {{z, x, y}, bend};
}

class AngleReader {
 public:
  explicit AngleReader(const BodyRecord& body) : rest_(body) {}

  BodyAngles Read(const PoseRow& row) {
    const Matrix3 R_GW = YUpFromWorld();
    const Matrix3 R_WP = rest_.PelvisRotation(row) * SimFromBody().transpose();
    const Matrix3 R_WT = TorsoRotation(row) * SimFromBody().transpose();
    const Matrix3 R_GP = R_GW * R_WP;
    const double scale =
        1e-3 * (At(row, Point::kHipL) - At(row, Point::kHipR)).norm() / kHipsApart_m;
    BodyAngles angles;
    angles.time_ns = row.timestamp_ns;
    angles.p_GPelvis =
        1e-3 * (R_GW * HipsMiddle(row)) - R_GP * (scale * Vector3(kHipForward_m, kHipUp_m, 0));
    angles.pelvis = Follow(AnglesZxy(R_GP), last_.pelvis);
    angles.lumbar = Follow(AnglesZxy(R_WP.transpose() * R_WT), last_.lumbar);
    const auto limb = [&](const Matrix3& R_WParent, Point start, Point hinge, Point end,
                          Bends bends, double side, Vector3& last) {
      const auto along = [&](Point a, Point b) -> Vector3 {
        return R_WParent.transpose() * (At(row, b) - At(row, a)).normalized();
      };
      const Turns turns = TurnsOf(along(start, hinge), along(hinge, end), bends);
      const Vector3 zxy = Follow(turns.zxy, last);
      return LimbAngles{zxy[0], side * zxy[1], side * zxy[2], turns.bend};
    };
    angles.leg_l =
        limb(R_WP, Point::kHipL, Point::kKneeL, Point::kFootL, Bends::kBackward, -1, last_.leg_l);
    angles.leg_r =
        limb(R_WP, Point::kHipR, Point::kKneeR, Point::kFootR, Bends::kBackward, 1, last_.leg_r);
    angles.arm_l = limb(R_WT, Point::kShoulderL, Point::kElbowL, Point::kLowerArmL, Bends::kForward,
                        -1, last_.arm_l);
    angles.arm_r = limb(R_WT, Point::kShoulderR, Point::kElbowR, Point::kLowerArmR, Bends::kForward,
                        1, last_.arm_r);
    return angles;
  }

 private:
  /// Of the previous frame, about z, x and y.
  struct Last {
    Vector3 pelvis = Vector3::Zero(), lumbar = Vector3::Zero(), leg_l = Vector3::Zero(),
            leg_r = Vector3::Zero(), arm_l = Vector3::Zero(), arm_r = Vector3::Zero();
  };

  static Vector3 Follow(const Vector3& zxy, Vector3& last) {
    last = NearestEquivalent(zxy, last);
    return last;
  }

  RestBody rest_;
  Last last_;
};

}  // namespace

std::array<double, kCoordinateNames.size()> CoordinatesOf(const BodyAngles& angles) {
  std::array<double, kCoordinateNames.size()> values{};
  auto next = values.begin();
  const auto add = [&](const Vector3& turns) { next = std::ranges::copy(turns, next).out; };
  const auto add_limb = [&](const LimbAngles& limb) {
    add({limb.flexion, limb.adduction, limb.rotation});
    *next++ = limb.bend;
  };
  add(angles.pelvis);
  add_limb(angles.leg_r);
  add_limb(angles.leg_l);
  add(angles.lumbar);
  add_limb(angles.arm_r);
  add_limb(angles.arm_l);
  return values;
}

std::vector<BodyAngles> AnglesOf(const Result& result) {
  std::vector<BodyAngles> angles;
  AngleReader reader(result.body);
  for (const PoseRow& row : result.poses) {
    if (IsTracked(row)) angles.push_back(reader.Read(row));
  }
  return angles;
}

}  // namespace mocap
