#include "tools/view/drawn_body.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "config/body_size_fields.h"
#include "daemon/base/json.h"
#include "tools/report/body_outline.h"
#include "tools/results/message_body.h"

namespace mocap {
namespace {

/// A limb of constant width between joints.
struct Limb {
  BodyPart part;
  Point from, to;
  SizeMember width;
};

constexpr Limb kLimbs[] = {
    {BodyPart::kUpperArmL, Point::kShoulderL, Point::kElbowL, &BodySizes::upper_arm_width},
    {BodyPart::kUpperArmR, Point::kShoulderR, Point::kElbowR, &BodySizes::upper_arm_width},
    {BodyPart::kThighL, Point::kHipL, Point::kKneeL, &BodySizes::thigh_width},
    {BodyPart::kThighR, Point::kHipR, Point::kKneeR, &BodySizes::thigh_width},
    {BodyPart::kLowerArmL, Point::kElbowL, Point::kFingertipsL, &BodySizes::lower_arm_width},
    {BodyPart::kLowerArmR, Point::kElbowR, Point::kFingertipsR, &BodySizes::lower_arm_width},
    {BodyPart::kCalfL, Point::kKneeL, Point::kFootL, &BodySizes::calf_width},
    {BodyPart::kCalfR, Point::kKneeR, Point::kFootR, &BodySizes::calf_width}};

/// Four rods between shoulders and hips, inset by their thickness.
constexpr std::array<std::array<Point, 2>, 4> kTrunk = {{{Point::kShoulderL, Point::kShoulderR},
                                                         {Point::kHipL, Point::kHipR},
                                                         {Point::kShoulderL, Point::kHipL},
                                                         {Point::kShoulderR, Point::kHipR}}};

Vector3 At(const PoseRow& row, Point point) { return row.points_W.col(static_cast<int>(point)); }

}  // namespace

DrawnBody::DrawnBody(const BodyRecord& record) : record_(record), model_(ModelOf(record)) {
  if (!model_) {
    parts_ = PartsFromPoints();
    return;
  }
  for (const Capsule& capsule : model_->shape()) parts_.push_back(static_cast<int>(capsule.part));
}

std::vector<PosedCapsule> DrawnBody::Pose(const pose_t& pose, const PoseRow& row) const {
  std::vector<PosedCapsule> capsules;
  if (!row.has_pose) return capsules;
  if (!model_ || pose.num_joints != model_->joint_count()) {
    return CapsulesFromPoints(row, record_.sizes);
  }
  const PoseState state = StateOf(pose);
  if (!state.IsFinite()) return capsules;
  model_->PoseShape(model_->PostureAt(state), capsules);
  return capsules;
}

std::vector<PosedCapsule> CapsulesFromPoints(const PoseRow& row, const BodySizes& sizes) {
  std::vector<PosedCapsule> capsules;
  if (!row.has_pose || !AreSizes(sizes)) return capsules;
  const double trunk_mm = sizes.torso_depth / 2;
  const Vector3 middle = At(row, Point::kTorso);
  const auto drawn_in = [&](Point point) {
    const Vector3 out = At(row, point) - middle;
    const double far_mm = std::max(out.norm(), 1.0);
    return Vector3(middle + out * std::max(0.0, 1 - trunk_mm / 2 / far_mm));
  };
  for (const auto& [from, to] : kTrunk) {
    capsules.emplace_back(drawn_in(from), drawn_in(to), trunk_mm, trunk_mm);
  }
  const Vector3 head = At(row, Point::kHead);
  const Vector3 up = (head - At(row, Point::kNeck)).stableNormalized();
  const double rest_mm = std::max(0.0, (sizes.head - sizes.head_width) / 2);
  capsules.emplace_back(head - up * rest_mm, head + up * rest_mm, sizes.head_width / 2,
                        sizes.head_width / 2);
  for (const Limb& limb : kLimbs) {
    const double radius_mm = sizes.*limb.width / 2;
    capsules.emplace_back(At(row, limb.from), At(row, limb.to), radius_mm, radius_mm * 0.8);
  }
  return capsules;
}

const std::vector<int>& PartsFromPoints() {
  static const std::vector<int> parts = [] {
    std::vector<int> made(kTrunk.size(), static_cast<int>(BodyPart::kTorso));
    made.push_back(static_cast<int>(BodyPart::kHead));
    for (const Limb& limb : kLimbs) made.push_back(static_cast<int>(limb.part));
    return made;
  }();
  return parts;
}

std::string BodyJson(const BodyRecord& record, const std::vector<int>& parts) {
  nlohmann::ordered_json json{{"type", "body"},
                              {"model", record.model},
                              {"stature_mm", record.stature_mm},
                              {"sizes", nlohmann::ordered_json::object()},
                              {"point_names", kPointNames},
                              {"bones", nlohmann::ordered_json::array()},
                              {"capsule_parts", parts},
                              {"part_names", nlohmann::ordered_json::array()}};
  for (const BodySizeField& field : kBodySizeFields) {
    json["sizes"][std::string(field.name)] = record.sizes.*field.value;
  }
  for (const Stick& stick : Sticks()) {
    json["bones"].push_back({static_cast<int>(stick.from), static_cast<int>(stick.to)});
  }
  for (int part = 0; part < kBodyPartCount; ++part) {
    json["part_names"].push_back(kPointNames[static_cast<std::size_t>(part)]);
  }
  return JsonText(json);
}

}  // namespace mocap
