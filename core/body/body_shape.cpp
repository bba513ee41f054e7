#include "core/body/body_shape.h"

#include <algorithm>

namespace mocap {
namespace {

class ShapeBuilder {
 public:
  ShapeBuilder(const BodyTable& table, const BodySizes& sizes, const BodyPoints& points_T)
      : table_(table), sizes_(sizes), points_T_(points_T) {}

  Vector3 At(Point point) const { return points_T_.col(static_cast<int>(point)); }
  void Add(BodyPart part, Segment segment, const Vector3& a, const Vector3& b, double radius_a,
           double radius_b) {
    capsules_.push_back(
        {part, table_.carrier[static_cast<int>(segment)], a, b, radius_a, radius_b});
  }
  std::vector<Capsule> Take() { return std::move(capsules_); }

  void AddTrunk() {
    const BodySizes& s = sizes_;
    const double radius = s.torso_depth / 2;
    const double chest_y = std::max(0.0, s.torso_width / 2 - radius);
    const double hip_radius = 0.95 * radius;
    const Vector3 shoulder = At(Point::kShoulderL);
    const Vector3 hip = At(Point::kHipL);
    for (const double side : {1.0, -1.0}) {
      Add(BodyPart::kTorso, Segment::kTorso, {0, side * chest_y, 0},
          {0, side * chest_y, shoulder.z() - 0.5 * radius}, 0.9 * radius, 0.95 * radius);
      Add(BodyPart::kTorso, Segment::kTorso,
          {shoulder.x(), side * chest_y, shoulder.z() - 0.1 * radius},
          {shoulder.x(), side * 0.85 * shoulder.y(), shoulder.z()}, 0.65 * radius, 0.45 * radius);
      Add(BodyPart::kTorso, Segment::kPelvis, {0, side * chest_y, 0},
          {hip.x(), side * 0.9 * hip.y(), hip.z() + 0.2 * radius}, 0.9 * radius, hip_radius);
    }
  }

  void AddHead() {
    const BodySizes& s = sizes_;
    const double radius = s.head_width / 2;
    const Vector3 head = At(Point::kHead);
    const Vector3 up(0, 0, std::max(0.0, s.head / 2 - radius));
    Add(BodyPart::kHead, Segment::kHead, head - up, head + up, radius, radius);
    const Vector3 neck = At(Point::kNeck);
    Add(BodyPart::kTorso, Segment::kTorso, neck - Vector3(0, 0, 0.3 * s.neck),
        neck + 0.5 * (head - neck), 0.62 * radius, 0.6 * radius);
  }

  void AddArm(BodyPart upper, BodyPart lower, Segment upper_segment, Segment lower_segment,
              Point shoulder_point, Point elbow_point, Point tips_point) {
    const BodySizes& s = sizes_;
    const Vector3 shoulder = At(shoulder_point);
    const Vector3 elbow = At(elbow_point);
    const Vector3 tips = At(tips_point);
    const double upper_radius = s.upper_arm_width / 2;
    const double lower_radius = s.lower_arm_width / 2;
    Add(upper, upper_segment, shoulder, elbow, 1.1 * upper_radius, 0.85 * upper_radius);
    const Vector3 wrist = elbow + 0.58 * (tips - elbow);
    const Vector3 hand = elbow + 0.93 * (tips - elbow);
    Add(lower, lower_segment, elbow, wrist, 1.1 * lower_radius, 0.75 * lower_radius);
    Add(lower, lower_segment, wrist, hand, 0.85 * lower_radius, 0.55 * lower_radius);
  }

  void AddLeg(BodyPart upper, BodyPart lower, Segment upper_segment, Segment lower_segment,
              Point hip_point, Point knee_point, Point foot_point) {
    const BodySizes& s = sizes_;
    const Vector3 hip = At(hip_point);
    const Vector3 knee = At(knee_point);
    const Vector3 sole = At(foot_point);
    const double thigh_radius = s.thigh_width / 2;
    const double calf_radius = s.calf_width / 2;
    // The calf's flesh lies behind the line from knee to ankle.
    const Vector3 behind(-0.35 * calf_radius, 0, 0);
    const Vector3 ankle = sole + Vector3(0, 0, 1.1 * calf_radius);
    Add(upper, upper_segment, hip, knee, 1.1 * thigh_radius, 1.1 * calf_radius);
    const Vector3 belly = knee + 0.3 * (ankle - knee) + behind;
    Add(lower, lower_segment, knee, belly, 1.05 * calf_radius, 1.1 * calf_radius);
    Add(lower, lower_segment, belly, ankle, 1.1 * calf_radius, 0.7 * calf_radius);
    const double foot_length = 0.152 * s.Stature();
    const double foot_radius = 0.65 * calf_radius;
    Add(lower, lower_segment, sole + Vector3(-0.10 * foot_length, 0, foot_radius),
        sole + Vector3(0.6 * foot_length, 0, 0.8 * foot_radius), foot_radius, 0.8 * foot_radius);
  }

 private:
  const BodyTable& table_;
  const BodySizes& sizes_;
  const BodyPoints& points_T_;
  std::vector<Capsule> capsules_;
};

}  // namespace

std::vector<Capsule> ShapeOf(const BodyTable& table, const BodySizes& sizes,
                             const BodyPoints& reference_points_T) {
  ShapeBuilder builder(table, sizes, reference_points_T);
  builder.AddTrunk();
  builder.AddHead();
  builder.AddArm(BodyPart::kUpperArmL, BodyPart::kLowerArmL, Segment::kUpperArmL,
                 Segment::kLowerArmL, Point::kShoulderL, Point::kElbowL, Point::kFingertipsL);
  builder.AddArm(BodyPart::kUpperArmR, BodyPart::kLowerArmR, Segment::kUpperArmR,
                 Segment::kLowerArmR, Point::kShoulderR, Point::kElbowR, Point::kFingertipsR);
  builder.AddLeg(BodyPart::kThighL, BodyPart::kCalfL, Segment::kThighL, Segment::kCalfL,
                 Point::kHipL, Point::kKneeL, Point::kFootL);
  builder.AddLeg(BodyPart::kThighR, BodyPart::kCalfR, Segment::kThighR, Segment::kCalfR,
                 Point::kHipR, Point::kKneeR, Point::kFootR);
  return builder.Take();
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
  const Vector3 segment_W = from_W + on_segment * along;
  const double radius = radius_a_mm + share * (radius_b_mm - radius_a_mm);
  return {core_W, segment_W, (segment_W - core_W).norm() - radius, share};
}

}  // namespace mocap
