#include "core/body/body_shape.h"

#include <algorithm>

namespace mocap {
namespace {

// Shoes and hair make people taller than their bodies by about 20 and 15 mm. Hair is as thick
// behind the skull as above it.
constexpr double kSole_mm = 20;
constexpr double kHair_mm = 15;

/// An arm's parts, segments and points.
struct Arm {
  BodyPart upper, lower;
  Segment upper_segment, lower_segment, hand;
  Point shoulder, elbow, wrist, tips;
};

/// A leg's.
struct Leg {
  BodyPart upper, lower;
  Segment upper_segment, lower_segment, foot, toes;
  Point hip, knee, ankle, ball, sole;
};

constexpr Arm kArms[] = {
    {BodyPart::kUpperArmL, BodyPart::kLowerArmL, Segment::kUpperArmL, Segment::kLowerArmL,
     Segment::kHandL, Point::kShoulderL, Point::kElbowL, Point::kWristL, Point::kFingertipsL},
    {BodyPart::kUpperArmR, BodyPart::kLowerArmR, Segment::kUpperArmR, Segment::kLowerArmR,
     Segment::kHandR, Point::kShoulderR, Point::kElbowR, Point::kWristR, Point::kFingertipsR}};
constexpr Leg kLegs[] = {
    {BodyPart::kThighL, BodyPart::kCalfL, Segment::kThighL, Segment::kCalfL, Segment::kFootL,
     Segment::kToesL, Point::kHipL, Point::kKneeL, Point::kAnkleL, Point::kBallL, Point::kFootL},
    {BodyPart::kThighR, BodyPart::kCalfR, Segment::kThighR, Segment::kCalfR, Segment::kFootR,
     Segment::kToesR, Point::kHipR, Point::kKneeR, Point::kAnkleR, Point::kBallR, Point::kFootR}};

// The elbow belongs to the upper arm, the wrist to the forearm. Of a foot, borders hold the sides
// of the toes only: when they held heels, too, feet on steps were off by 60 mm instead of 25.
constexpr std::array<bool, 3> kWithoutStart = {false, true, true}, kAtEnds = {true, false, true},
                              kNowhere = {};

class ShapeBuilder {
 public:
  ShapeBuilder(const BodyTable& table, const BodySizes& sizes, const BodyPlaces& points_T,
               std::vector<Capsule>& capsules)
      : table_(table), sizes_(sizes), points_T_(points_T), capsules_(capsules) {}

  Vector3 At(Point point) const { return points_T_.col(static_cast<int>(point)); }
  void Add(BodyPart part, Segment segment, const Vector3& a, const Vector3& b, double radius_a,
           double radius_b, const std::array<bool, 3>& held = {true, true, true}) {
    capsules_.push_back(
        {part, table_.carrier[static_cast<int>(segment)], a, b, radius_a, radius_b, 0, 0, held});
  }
  // Around the capsule that was added last.
  void Drape(double cloth_a, double cloth_b) {
    capsules_.back().cloth_a_mm = cloth_a;
    capsules_.back().cloth_b_mm = cloth_b;
  }

  // The chest is deeper than the waist, and the shoulder blades lie behind. Flesh reaches about 50
  // mm above the shoulder joint, to the acromion. Of the pelvis, more lies behind the hip joints
  // than in front of them (Harrington et al. 2007). Depth above the average for the stature is
  // added in front: the back stays at the spine.
  void AddTrunk() {
    const BodySizes& s = sizes_;
    const double radius = s.torso_depth / 2;
    const double forward = radius - AverageSizes(s.Stature()).torso_depth / 2;
    const double chest_y = std::max(0.0, s.torso_width / 2 - radius);
    const Vector3 shoulder = At(Point::kShoulderL);
    const Vector3 hip = At(Point::kHipL);
    for (const double side : {1.0, -1.0}) {
      const Vector3 waist(forward, side * 0.85 * chest_y, 0);
      Add(BodyPart::kTorso, Segment::kTorso, waist,
          {forward - 0.05 * radius, side * chest_y, shoulder.z() - 0.68 * radius}, 0.85 * radius,
          1.02 * radius);
      Add(BodyPart::kTorso, side > 0 ? Segment::kShoulderL : Segment::kShoulderR,
          {shoulder.x() - 0.1 * radius, side * chest_y, shoulder.z() - 0.28 * radius},
          {shoulder.x(), side * 0.85 * shoulder.y(), shoulder.z() - 0.18 * radius}, 0.8 * radius,
          0.53 * radius);
      Add(BodyPart::kTorso, Segment::kPelvis, waist,
          {hip.x() - 0.08 * radius, side * 0.9 * hip.y(), hip.z() + 0.2 * radius}, 0.85 * radius,
          0.95 * radius);
    }
  }

  // The skull, deeper than broad; the jaw, in front of it and below it; and the neck.
  void AddHead() {
    const BodySizes& s = sizes_;
    const double width = s.head_width;
    const Vector3 head = At(Point::kHead);
    const double skull_radius = 0.45 * width;
    const double skull_z = s.head / 2 + kHair_mm - skull_radius;
    const Vector3 forward(0.12 * width, 0, 0);
    Add(BodyPart::kHead, Segment::kHead, head - forward + Vector3(-kHair_mm, 0, skull_z),
        head + forward + Vector3(0, 0, skull_z), skull_radius, skull_radius);
    const double jaw_radius = 0.36 * width;
    Add(BodyPart::kHead, Segment::kHead, head + Vector3(0.1 * width, 0, skull_z),
        head + Vector3(0.2 * width, 0, -s.head / 2 + jaw_radius), 0.4 * width, jaw_radius);
    const Vector3 neck = At(Point::kNeck);
    const double neck_radius = 0.31 * width;
    Add(BodyPart::kTorso, Segment::kTorso, neck + Vector3(0.05 * width, 0, -0.17 * s.neck),
        neck + 0.5 * (head - neck), neck_radius, neck_radius);
  }

  // The flesh over the shoulder joint is thinner than that beside it.
  void AddArm(const Arm& arm) {
    const BodySizes& s = sizes_;
    const Vector3 shoulder = At(arm.shoulder);
    const Vector3 elbow = At(arm.elbow);
    const Vector3 tips = At(arm.tips);
    const double upper_radius = s.upper_arm_width / 2;
    const double lower_radius = s.lower_arm_width / 2;
    const Vector3 deltoid = shoulder + 0.05 * (elbow - shoulder);
    Add(arm.upper, arm.upper_segment, deltoid, elbow, 1.2 * upper_radius, 0.85 * upper_radius);
    const Vector3 wrist = At(arm.wrist);
    const double hand_radius = 0.9 * lower_radius;
    const Vector3 fingers = tips - hand_radius * (tips - elbow).normalized();
    Add(arm.lower, arm.lower_segment, elbow, wrist, 1.1 * lower_radius, 0.75 * lower_radius,
        kWithoutStart);
    Add(arm.lower, arm.hand, wrist, fingers, lower_radius, hand_radius, kWithoutStart);
  }

  // The thigh's root lies behind the hip, its bulge in front of the line from hip to knee, the calf
  // behind that from knee to ankle. Foot length and breadth are shares of the stature: Winter 2009,
  // Fig. 4.1.
  void AddLeg(const Leg& leg) {
    const BodySizes& s = sizes_;
    const Vector3 hip = At(leg.hip);
    const Vector3 knee = At(leg.knee);
    const Vector3 sole = At(leg.sole) - Vector3(0, 0, kSole_mm);
    const double thigh_radius = s.thigh_width / 2;
    const double calf_radius = s.calf_width / 2;
    constexpr double kFront = 0.55;
    const Vector3 front = hip + kFront * (knee - hip) + Vector3(0.1 * thigh_radius, 0, 0);
    const double front_radius = 0.5 * (1.1 * thigh_radius + 1.1 * calf_radius);
    const double front_drape = s.drape_hip + kFront * (s.drape_knee - s.drape_hip);
    const Vector3 root = hip - Vector3(0.1 * thigh_radius, 0, 0);
    Add(leg.upper, leg.upper_segment, root, front, 1.1 * thigh_radius, front_radius);
    Drape(s.drape_hip, front_drape);
    Add(leg.upper, leg.upper_segment, front, knee, front_radius, 1.05 * calf_radius);
    Drape(front_drape, s.drape_knee);
    const Vector3 ankle = At(leg.ankle);
    const Vector3 belly = knee + 0.3 * (ankle - knee) - Vector3(0.35 * calf_radius, 0, 0);
    Add(leg.lower, leg.lower_segment, knee, belly, 1.05 * calf_radius, 1.1 * calf_radius);
    Drape(s.drape_knee, s.drape_calf);
    Add(leg.lower, leg.lower_segment, belly, ankle, 1.1 * calf_radius, 0.7 * calf_radius);
    Drape(s.drape_calf, s.drape_ankle);
    const double length = s.FootLength();
    const double breadth = 0.055 * s.Stature();
    const double heel_radius = 0.38 * breadth;
    const double ball_radius = 0.3 * breadth;
    const double toe_radius = 0.24 * breadth;
    const auto aside = [&](double x, double side, double radius) -> Vector3 {
      return sole + Vector3(x, side * 0.25 * breadth, radius);
    };
    // Toes end at the tip of the foot, Point::kToeL and Point::kToeR.
    const double ball_x = At(leg.ball).x() - sole.x(), toe_x = 0.75 * length - toe_radius;
    for (const double side : {1.0, -1.0}) {
      Add(leg.lower, leg.foot, sole + Vector3(-0.1 * length, 0, heel_radius),
          aside(ball_x, side, ball_radius), heel_radius, ball_radius, kNowhere);
    }
    Add(leg.lower, leg.toes, aside(toe_x, 1, toe_radius), aside(toe_x, -1, toe_radius), toe_radius,
        toe_radius, kAtEnds);
  }

 private:
  const BodyTable& table_;
  const BodySizes& sizes_;
  const BodyPlaces& points_T_;
  std::vector<Capsule>& capsules_;
};

}  // namespace

void BuildShape(const BodyTable& table, const BodySizes& sizes,
                const BodyPlaces& reference_points_T, std::vector<Capsule>& capsules) {
  capsules.clear();
  ShapeBuilder builder(table, sizes, reference_points_T, capsules);
  builder.AddTrunk();
  builder.AddHead();
  for (const Arm& arm : kArms) builder.AddArm(arm);
  for (const Leg& leg : kLegs) builder.AddLeg(leg);
}

PosedCapsule::Distance PosedCapsule::DistanceTo(const Vector3& p_WQ) const {
  const Vector3 core = b_W - a_W;
  const double length_sq = core.squaredNorm();
  const double share =
      length_sq > 0 ? std::clamp((p_WQ - a_W).dot(core) / length_sq, 0.0, 1.0) : 0.0;
  const Vector3 closest = a_W + share * core;
  const double radius = radius_a_mm + share * (radius_b_mm - radius_a_mm);
  return {closest, (p_WQ - closest).norm() - radius, share};
}

PosedCapsule::SegmentDistance PosedCapsule::DistanceTo(const Vector3& from_W,
                                                       const Vector3& to_W) const {
  // Closest points of two segments (Ericson 2005, §5.1.9).
  const Vector3 core = b_W - a_W;
  const Vector3 along = to_W - from_W;
  const Vector3 between = a_W - from_W;
  const double core_sq = std::max(core.squaredNorm(), 1e-9);
  const double along_sq = std::max(along.squaredNorm(), 1e-9);
  const double dot = core.dot(along);
  const double c = core.dot(between);
  const double f = along.dot(between);
  const double slant = core_sq * along_sq - dot * dot;
  double share = slant > 1e-9 * core_sq * along_sq
                     ? std::clamp((dot * f - c * along_sq) / slant, 0.0, 1.0)
                     : 0.5;
  const double on_segment = std::clamp((dot * share + f) / along_sq, 0.0, 1.0);
  share = std::clamp((dot * on_segment - c) / core_sq, 0.0, 1.0);
  const Vector3 core_W = a_W + share * core;
  Vector3 segment_W = from_W + on_segment * along;
  // The nearest point of a tapered surface lies slightly beside the point nearest to its core.
  const bool inside_both = share > 0 && share < 1 && on_segment > 0 && on_segment < 1;
  if (inside_both && radius_a_mm != radius_b_mm) {
    const double slope = (radius_b_mm - radius_a_mm) * dot / core_sq;
    const double curvature = slant / core_sq / std::max(1.0, (segment_W - core_W).norm());
    const double slide = std::clamp(slope / curvature, -0.5, 0.5);
    segment_W = from_W + std::clamp(on_segment + slide, 0.0, 1.0) * along;
    const Distance distance = DistanceTo(segment_W);
    return {distance.core_W, segment_W, distance.outside_mm, distance.share};
  }
  const double radius = radius_a_mm + share * (radius_b_mm - radius_a_mm);
  return {core_W, segment_W, (segment_W - core_W).norm() - radius, share};
}

}  // namespace mocap
