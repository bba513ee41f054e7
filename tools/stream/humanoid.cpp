#include "tools/stream/humanoid.h"

#include <utility>

namespace mocap {
namespace {

/// Point pairs whose middle is the bone's joint.
constexpr std::array<std::pair<Point, Point>, kHumanoid.size()> kJoints = {{
    {Point::kHipL, Point::kHipR},           {Point::kTorso, Point::kTorso},
    {Point::kTorso, Point::kNeck},          {Point::kNeck, Point::kNeck},
    {Point::kNeck, Point::kHead},           {Point::kClavicleL, Point::kClavicleL},
    {Point::kShoulderL, Point::kShoulderL}, {Point::kElbowL, Point::kElbowL},
    {Point::kWristL, Point::kWristL},       {Point::kClavicleR, Point::kClavicleR},
    {Point::kShoulderR, Point::kShoulderR}, {Point::kElbowR, Point::kElbowR},
    {Point::kWristR, Point::kWristR},       {Point::kHipL, Point::kHipL},
    {Point::kKneeL, Point::kKneeL},         {Point::kAnkleL, Point::kAnkleL},
    {Point::kBallL, Point::kBallL},         {Point::kHipR, Point::kHipR},
    {Point::kKneeR, Point::kKneeR},         {Point::kAnkleR, Point::kAnkleR},
    {Point::kBallR, Point::kBallR},
}};

}  // namespace

HumanoidPose HumanoidPoseOf(const BodyModel& body, const PoseState& pose) {
  const Posture posture = body.PostureAt(pose);
  const auto X_W = [&](Segment segment) {
    const int carrier = body.table().carrier[static_cast<std::size_t>(segment)];
    return carrier < 0 ? posture.X_WT : posture.X_W[static_cast<std::size_t>(carrier)];
  };
  const auto at = [&](Point point) {
    return body.reference_points_T().col(static_cast<int>(point));
  };
  HumanoidPose X_WB, X_PB;
  for (std::size_t i = 0; i < kHumanoid.size(); ++i) {
    const auto& [name, parent, segment] = kHumanoid[i];
    const auto& [one, other] = kJoints[i];
    const RigidTransform X_WS = X_W(segment);
    // Each bone moves with its parent, so bones stay connected for any table.
    const RigidTransform X_WC =
        parent < 0 ? X_WS : X_W(kHumanoid[static_cast<std::size_t>(parent)].segment);
    X_WB[i] = {X_WS.R, X_WC * ((at(one) + at(other)) / 2)};
    X_PB[i] = parent < 0 ? X_WB[i] : X_WB[static_cast<std::size_t>(parent)].Inverse() * X_WB[i];
  }
  return X_PB;
}

}  // namespace mocap
