// Messages of people in poses that mirroring would change.
#pragma once

#include <algorithm>
#include <cstring>
#include <mocap/people_t.hpp>
#include <mocap/person_body_t.hpp>
#include <mocap/pose_t.hpp>
#include <random>
#include <string>

#include "config/load_config.h"
#include "core/body/body_sizes.h"
#include "daemon/messages/messages.h"

namespace mocap::testing {

/// A pose with every joint somewhere within its limits and the torso turned at random.
inline PoseState RandomPose(const BodyModel& body, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> within(0, 1);
  PoseState pose;
  pose.X_WT.R = ExpRotation(Vector3(within(random), within(random), 3 * within(random)));
  pose.X_WT.p = Vector3(400, -700, 1000) + 300 * Vector3(within(random), within(random), 0);
  pose.theta.resize(body.joint_count());
  for (int i = 0; i < body.joint_count(); ++i) {
    const JointAxis& joint = body.table().joints[static_cast<std::size_t>(i)];
    pose.theta[i] = joint.min_rad + within(random) * (joint.max_rad - joint.min_rad);
  }
  return pose;
}

/// What the daemon tells of it, tracked.
inline pose_t PoseMessage(const BodyModel& body, const PoseState& pose, std::int64_t frame) {
  CaptureResult result;
  result.state = CaptureState::kTracking;
  result.pose = pose;
  result.points_W = body.PointsAt(body.PostureAt(pose));
  result.point_std_mm.setConstant(1);
  const VoxelGrid grid;
  pose_t message{};
  FillPose({.frame = frame,
            .capture_ns = 1'700'000'000'000'000'000 + frame * 40'000'000,
            .result = result,
            .body = body,
            .grid = grid},
           1, message);
  return message;
}

/// The same among others.
inline person_t PersonMessage(int id, const std::string& name, const pose_t& pose) {
  person_t person{};
  person.id = id;
  person.name = name;
  person.state = pose.state;
  std::ranges::copy(pose.torso_mm, person.torso_mm);
  std::ranges::copy(pose.torso_axis, person.torso_axis);
  person.torso_angle_rad = pose.torso_angle_rad;
  person.num_joints = pose.num_joints;
  person.joint_rad = pose.joint_rad;
  std::memcpy(person.point_mm, pose.point_mm, sizeof(person.point_mm));
  return person;
}

inline body_t BodyMessage(const BodyModel& body) {
  body_t message{};
  FillBody(body, 0, message);
  return message;
}

}  // namespace mocap::testing
