#include "tools/kinematics/joint_angles.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/degrees.h"
#include "tools/kinematics/euler_angles.h"
#include "tools/kinematics/gait_events.h"
#include "tools/kinematics/posed_segments.h"
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
/// @param known_y  rotation of the upper part about itself; empty: as the bend shows it.
Turns TurnsOf(const Vector3& upper, const Vector3& lower, Bends bends,
              std::optional<double> known_y) {
  const double x = std::asin(std::clamp(-upper.z(), -1.0, 1.0));
  const double z = std::atan2(upper.x(), -upper.y());
  const Vector3 hinged = RotationZxy({z, x, 0}).transpose() * lower;
  const double sign = static_cast<int>(bends);
  const double aside = std::hypot(hinged.x(), hinged.z());
  const double shown =
      (std::atan2(aside, -hinged.y()) - kStraight_rad) / (kBent_rad - kStraight_rad);
  double y = std::atan2(-sign * hinged.z(), sign * hinged.x());
  // A nearly straight limb that bends the wrong way is hyperextended, not rotated.
  if (shown < 1 && std::abs(y) > kQuarter_rad) y -= std::copysign(2 * kQuarter_rad, y);
  y = known_y ? *known_y : y * SmoothStep(shown);
  const double bend =
      std::atan2(sign * (hinged.x() * std::cos(y) - hinged.z() * std::sin(y)), -hinged.y());
  return {{z, x, y}, bend};
}

/// A segment's OpenSim axes, which are the world's for a person who stands facing world x with
/// hanging arms.
Matrix3 SimAxesOf(const PosedSegments& posed, Segment segment) {
  return posed.RotationFromHanging(segment) * SimFromBody().transpose();
}

/// Axes x ahead, y up, z right of a person who walks.
/// @param R_WPelvis  OpenSim axes.
/// @param direction_W  of walking; zero: stands.
Matrix3 WalkerAxes(const Matrix3& R_WPelvis, const Vector3& direction_W) {
  // Whoever goes more sideways than this, by 45 degrees, has no direction of gait.
  constexpr double kAlong = 0.7071;
  Vector3 facing_W(R_WPelvis(0, 0), R_WPelvis(1, 0), 0);
  facing_W = facing_W.isZero(1e-6) ? Vector3(Vector3::UnitX()) : Vector3(facing_W.normalized());
  const double along = direction_W.dot(facing_W);
  const Vector3 ahead =
      std::abs(along) < kAlong ? facing_W : Vector3(std::copysign(1.0, along) * direction_W);
  Matrix3 R;
  R << ahead, Vector3::UnitZ(), ahead.cross(Vector3::UnitZ());
  return R;
}

/// Direction of walking in each tracked frame; zero: stands.
std::vector<Vector3> WalkingDirectionsOf(const Result& result) {
  GaitRun frames;
  for (const PoseRow& row : result.poses) {
    if (!IsTracked(row)) continue;
    GaitFrame& frame = frames.emplace_back();
    frame.time_s = 1e-9 * static_cast<double>(row.timestamp_ns - result.poses[0].timestamp_ns);
    frame.pelvis_W = HipsMiddle(row);
  }
  return DirectionsOf(frames);
}

bool Shows(const PoseRow& row, Point further) {
  return FurtherOf(row.further_W, further).allFinite();
}

struct Limb {
  Point start, hinge, end;
  Point last;  ///< Ankle or wrist.
  Bends bends;
  double side;  ///< 1: right, -1: left.
  Segment upper, lower, tip;
};

constexpr Limb kLegL = {Point::kHipL,     Point::kKneeL,    Point::kFootL,
                        Point::kAnkleL,   Bends::kBackward, -1,
                        Segment::kThighL, Segment::kCalfL,  Segment::kFootL};
constexpr Limb kLegR = {Point::kHipR,     Point::kKneeR,    Point::kFootR,
                        Point::kAnkleR,   Bends::kBackward, 1,
                        Segment::kThighR, Segment::kCalfR,  Segment::kFootR};
constexpr Limb kArmL = {Point::kShoulderL,   Point::kElbowL,      Point::kLowerArmL,
                        Point::kWristL,      Bends::kForward,     -1,
                        Segment::kUpperArmL, Segment::kLowerArmL, Segment::kHandL};
constexpr Limb kArmR = {Point::kShoulderR,   Point::kElbowR,      Point::kLowerArmR,
                        Point::kWristR,      Bends::kForward,     1,
                        Segment::kUpperArmR, Segment::kLowerArmR, Segment::kHandR};

LimbAngles AnglesIn(const Turns& turns, double side) {
  return {turns.zxy[0], side * turns.zxy[1], side * turns.zxy[2], turns.bend};
}

FootAngles FootOf(const PosedSegments& posed, const PoseRow& row, const Limb& leg) {
  if (!Shows(row, leg.last)) return {};
  const Matrix3 mirror = Vector3(1, 1, leg.side).asDiagonal();
  const Matrix3 R_WFoot = SimAxesOf(posed, leg.tip);
  FootAngles angles =
      FootAnglesOf(mirror * SimAxesOf(posed, leg.lower).transpose() * R_WFoot * mirror);
  const Segment toes = leg.tip == Segment::kFootL ? Segment::kToesL : Segment::kToesR;
  angles.toes = AnglesZxy(R_WFoot.transpose() * SimAxesOf(posed, toes))[0];
  return angles;
}

/// @param turns  of the arm: the forearm's axes follow from them, as in the model.
HandAngles HandOf(const PosedSegments& posed, const PoseRow& row, const Limb& arm,
                  const Matrix3& R_WT, const Turns& turns) {
  if (!Shows(row, arm.last)) return {};
  const Matrix3 R_WForearm = R_WT * RotationZxy(turns.zxy) * RotationZxy({turns.bend, 0, 0});
  const Matrix3 R_ForearmHand = R_WForearm.transpose() * SimAxesOf(posed, arm.tip);
  const Vector3 zxy = AnglesZxy(R_ForearmHand), xzy = AnglesXzy(R_ForearmHand);
  return {zxy[0], arm.side * zxy[1], {arm.side * xzy[0], -xzy[1], 0}};
}

class AngleReader {
 public:
  explicit AngleReader(const Result& result)
      : segments_(result.body),
        has_foot_l_(ShowsInAny(result, kLegL.last)),
        has_foot_r_(ShowsInAny(result, kLegR.last)) {}

  /// @param direction_W  of walking; zero: stands.
  BodyAngles Read(const PoseRow& row, const Vector3& direction_W) {
    const PosedSegments posed = segments_.Pose(row);
    const Matrix3 R_GW = YUpFromWorld();
    const Matrix3 R_WP = SimAxesOf(posed, Segment::kPelvis);
    const Matrix3 R_WT = SimAxesOf(posed, Segment::kTorso);
    const Matrix3 R_GP = R_GW * R_WP;
    const Matrix3 R_WalkerW = WalkerAxes(R_WP, direction_W).transpose();
    const double scale =
        1e-3 * (At(row, Point::kHipL) - At(row, Point::kHipR)).norm() / kHipsApart_m;
    BodyAngles angles;
    angles.time_ns = row.timestamp_ns;
    angles.p_GPelvis =
        1e-3 * (R_GW * HipsMiddle(row)) - R_GP * (scale * Vector3(kHipForward_m, kHipUp_m, 0));
    angles.pelvis = Follow(AnglesZxy(R_GP), last_.pelvis);
    angles.lumbar = Follow(AnglesZxy(R_WP.transpose() * R_WT), last_.lumbar);
    const auto in_walker = [&](Segment segment) {
      return AnglesZxy(R_WalkerW * SimAxesOf(posed, segment));
    };
    angles.walker_pelvis = Follow(in_walker(Segment::kPelvis), last_.walker_pelvis);
    angles.walker_torso = Follow(in_walker(Segment::kTorso), last_.walker_torso);
    angles.walker_head = Follow(in_walker(Segment::kHead), last_.walker_head);
    angles.leg_l = LegOf(row, posed, kLegL, has_foot_l_, last_.leg_l);
    angles.leg_r = LegOf(row, posed, kLegR, has_foot_r_, last_.leg_r);
    angles.foot_l = FootOf(posed, row, kLegL);
    angles.foot_r = FootOf(posed, row, kLegR);
    ReadArm(row, posed, kArmL, last_.arm_l, angles.arm_l, angles.hand_l);
    ReadArm(row, posed, kArmR, last_.arm_r, angles.arm_r, angles.hand_r);
    return angles;
  }

 private:
  /// Of the previous frame, about z, x and y.
  struct Last {
    Vector3 pelvis = Vector3::Zero(), lumbar = Vector3::Zero(), walker_pelvis = Vector3::Zero(),
            walker_torso = Vector3::Zero(), walker_head = Vector3::Zero(), leg_l = Vector3::Zero(),
            leg_r = Vector3::Zero(), arm_l = Vector3::Zero(), arm_r = Vector3::Zero();
  };

  static Vector3 Follow(const Vector3& zxy, Vector3& last) {
    last = NearestEquivalent(zxy, last);
    return last;
  }

  static Turns TurnsIn(const PoseRow& row, const Limb& limb, const Matrix3& R_WParent,
                       std::optional<double> rotation, Vector3& last) {
    const auto along = [&](Point a, Point b) -> Vector3 {
      return R_WParent.transpose() * (At(row, b) - At(row, a)).normalized();
    };
    Turns turns =
        TurnsOf(along(limb.start, limb.hinge), along(limb.hinge, limb.end), limb.bends, rotation);
    turns.zxy = Follow(turns.zxy, last);
    return turns;
  }

  static bool ShowsInAny(const Result& result, Point further) {
    return std::ranges::any_of(result.poses,
                               [&](const PoseRow& row) { return Shows(row, further); });
  }

  /// @param has_foot  whether the tracker knows the leg's rotation about itself, by the foot.
  static LimbAngles LegOf(const PoseRow& row, const PosedSegments& posed, const Limb& leg,
                          bool has_foot, Vector3& last) {
    const Matrix3 R_WP = SimAxesOf(posed, Segment::kPelvis);
    std::optional<double> rotation;
    if (has_foot) rotation = AnglesZxy(R_WP.transpose() * SimAxesOf(posed, leg.upper))[2];
    return AnglesIn(TurnsIn(row, leg, R_WP, rotation, last), leg.side);
  }

  static void ReadArm(const PoseRow& row, const PosedSegments& posed, const Limb& limb,
                      Vector3& last, LimbAngles& angles, HandAngles& hand) {
    const Matrix3 R_WT = SimAxesOf(posed, Segment::kTorso);
    const Turns turns = TurnsIn(row, limb, R_WT, {}, last);
    angles = AnglesIn(turns, limb.side);
    hand = HandOf(posed, row, limb, R_WT, turns);
  }

  SegmentPoser segments_;
  bool has_foot_l_, has_foot_r_;  ///< In any row: single ones may have lost their feet.
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
  const auto add_hand = [&](const HandAngles& hand) {
    *next++ = hand.flexion;
    *next++ = hand.deviation;
  };
  add(angles.pelvis);
  add_limb(angles.leg_r);
  add({angles.foot_r.ankle, angles.foot_r.subtalar, angles.foot_r.toes});
  add_limb(angles.leg_l);
  add({angles.foot_l.ankle, angles.foot_l.subtalar, angles.foot_l.toes});
  add(angles.lumbar);
  add_limb(angles.arm_r);
  add_hand(angles.hand_r);
  add_limb(angles.arm_l);
  add_hand(angles.hand_l);
  return values;
}

std::vector<BodyAngles> AnglesOf(const Result& result) {
  std::vector<BodyAngles> angles;
  AngleReader reader(result);
  const std::vector<Vector3> directions_W = WalkingDirectionsOf(result);
  for (const PoseRow& row : result.poses) {
    if (IsTracked(row)) angles.push_back(reader.Read(row, directions_W[angles.size()]));
  }
  return angles;
}

}  // namespace mocap
