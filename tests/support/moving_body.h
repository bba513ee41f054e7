// Results of a body that moves all its joints, for tests of what is exported.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "config/load_config.h"
#include "core/body/body_model.h"
#include "core/errors.h"
#include "tools/results/result.h"

namespace mocap::testing {

inline BodyModel GrownBody(const std::string& table = "full") {
  return BodyModel(LoadBodyTable(table), AverageSizes(1780));
}

inline void Turn(const BodyModel& body, const std::string& joint, double degrees, PoseState& pose) {
  for (int i = 0; i < body.joint_count(); ++i) {
    if (body.table().joints[i].name != joint) continue;
    pose.theta[i] = degrees * EIGEN_PI / 180;
    return;
  }
  MOCAP_CHECK(false);
}

/// Stands 2 m before and 0.5 m to the left of the origin, and faces world x: arms out to the sides.
inline PoseState Standing(const BodyModel& body) {
  PoseState pose;
  pose.X_WT.p = {2000, 500, 1200};
  pose.theta = JointAngles::Zero(body.joint_count());
  return pose;
}

/// What mirroring or swapped sides would change: the right arm is straight up, the left one hangs,
/// the left knee is bent.
inline PoseState RightArmRaised(const BodyModel& body) {
  PoseState pose = Standing(body);
  Turn(body, "shoulder_r_x", -90, pose);
  Turn(body, "shoulder_l_x", -90, pose);
  Turn(body, "knee_l_y", 60, pose);
  return pose;
}

/// All joints swing within their limits while the body turns about itself and walks away.
inline PoseState Swinging(const BodyModel& body, double time) {
  PoseState pose = Standing(body);
  pose.X_WT.p += Vector3(300 * time, 80 * std::sin(time), 20 * time);
  pose.X_WT.R = ExpRotation({0.3 * std::sin(time), 0.2, 2 * time});
  for (int i = 0; i < body.joint_count(); ++i) {
    const JointAxis& joint = body.table().joints[i];
    const double share = 0.5 + 0.45 * std::sin((1 + 0.1 * i) * time + i);
    pose.theta[i] = joint.min_rad + share * (joint.max_rad - joint.min_rad);
  }
  return pose;
}

inline PoseRow TrackedRow(const BodyModel& body, const PoseState& pose) {
  CaptureResult capture;
  capture.state = CaptureState::kTracking;
  capture.pose = pose;
  const Posture posture = body.PostureAt(pose);
  capture.points_W = body.PointsAt(posture);
  capture.further_W = body.FurtherPointsAt(posture);
  capture.residual_mm = 17.5;
  return PoseRowOf(0, 0, capture, body);
}

/// Adds a tracked row, 40 ms after the last one.
inline void Append(const BodyModel& body, const PoseState& pose, Result& result) {
  PoseRow row = TrackedRow(body, pose);
  row.frame = static_cast<std::int64_t>(result.poses.size());
  row.timestamp_ns = 1'000'000'000 + 40'000'000 * row.frame;
  result.poses.push_back(row);
}

inline Result ResultOf(const BodyModel& body, const PoseState& pose) {
  Result result{RecordOf(body), {}};
  Append(body, pose, result);
  return result;
}

/// Forgets what results of before did not have: the points that follow the 23, and the angles of
/// joints.
inline void MakeOld(Result& result) {
  result.body.joints.clear();
  for (PoseRow& row : result.poses) {
    row.further_W.setConstant(std::nan(""));
    row.joint_rad.resize(0);
  }
}

/// Forgets what a frame does not have if its message MOCAP_DETAILS was lost.
inline void LoseDetails(PoseRow& row) {
  row.further_W.setConstant(std::nan(""));
  row.further_std_mm.setConstant(std::nan(""));
  row.contacts = kUnknownContacts;
  row.probability = std::nan("");
}

/// Makes a result of the body `full` as earlier versions had it: without the points that follow the
/// 23, with a second axis of the ankle in place of the subtalar joint, and without joints of the
/// toes and about the neck's length.
inline void MakeOfEarlierFull(Result& result) {
  const std::vector<JointRecord> joints = result.body.joints;
  std::vector<Eigen::Index> kept;
  result.body.joints.clear();
  for (std::size_t i = 0; i < joints.size(); ++i) {
    JointRecord joint = joints[i];
    if (joint.name.starts_with("toes_") || joint.name == "neck_z") continue;
    if (joint.name == "subtalar_l_x") joint.name = "ankle_l_z";
    if (joint.name == "subtalar_r_x") joint.name = "ankle_r_z";
    result.body.joints.push_back(joint);
    kept.push_back(static_cast<Eigen::Index>(i));
  }
  MOCAP_CHECK(kept.size() == 33);
  for (PoseRow& row : result.poses) {
    LoseDetails(row);
    row.joint_rad = JointAngles(row.joint_rad(kept));
  }
}

/// The time from one strike of a foot to its next in WalkingResult.
inline constexpr double kWalkCycle_s = 1.06;

/// 25 frames a second of somebody who walks straight on with stiff legs, left foot first.
/// @param heading_rad  0: along world x.
inline Result WalkingResult(int frames, double heading_rad = 0,
                            const BodyModel& body = GrownBody()) {
  Result result{RecordOf(body), {}};
  for (int i = 0; i < frames; ++i) {
    const double time = 0.04 * i;
    PoseState pose = Standing(body);
    pose.X_WT.R = ExpRotation({0, 0, heading_rad});
    pose.X_WT.p += pose.X_WT.R * Vector3(1200 * time, 0, 0);
    const double forward_deg = 25 * std::sin(2 * EIGEN_PI * time / kWalkCycle_s);
    Turn(body, "hip_l_y", -forward_deg, pose);
    Turn(body, "hip_r_y", forward_deg, pose);
    Append(body, pose, result);
  }
  return result;
}

/// 25 frames a second of somebody who swings.
inline Result SwingingResult(int frames, const BodyModel& body = GrownBody()) {
  Result result{RecordOf(body), {}};
  for (int i = 0; i < frames; ++i) Append(body, Swinging(body, 0.04 * i), result);
  return result;
}

}  // namespace mocap::testing
