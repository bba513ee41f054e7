#include "tools/stream/pose_json.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/motion_capture.h"
#include "daemon/base/json.h"
#include "tools/results/message_body.h"

namespace mocap {
namespace {

double RoundedTo(double value, double steps) { return std::round(value * steps) / steps; }
double Mm(double value) { return RoundedTo(value, 1e3); }
double Rad(double value) { return RoundedTo(value, 1e6); }

Json PointJson(const double (&point_mm)[3]) {
  Json json = Json::array();
  std::ranges::transform(point_mm, std::back_inserter(json), Mm);
  return json;
}

Json RotationJson(const Matrix3& R) {
  Json rows = Json::array();
  for (const auto& row : R.rowwise()) rows.push_back({Rad(row[0]), Rad(row[1]), Rad(row[2])});
  return rows;
}

void AddPose(const pose_t& pose, const body_t& body, Json& json) {
  json["torso_mm"] = PointJson(pose.torso_mm);
  json["torso_rotation"] = RotationJson(StateOf(pose).X_WT.R);
  json["joints_rad"] = Json::object();
  for (int i = 0; i < body.num_joints; ++i) {
    json["joints_rad"][body.joint_name[i]] = Rad(pose.joint_rad[i]);
  }
  for (int i = 0; i < kPointCount; ++i) {
    json["points_mm"][body.point_name[i]] = PointJson(pose.point_mm[i]);
  }
  for (int i = 0; i < kPointCount; ++i) {
    json["points_std_mm"][body.point_name[i]] = Mm(pose.point_std_mm[i]);
  }
  json["residual_mm"] = Mm(pose.residual_mm);
}

void AddDetails(const PoseRow& details, Json& json) {
  for (int i = 0; i < kFurtherPointCount; ++i) {
    const Vector3 p_W = details.further_W.col(i);
    if (!p_W.allFinite()) continue;
    const std::string name(kFurtherPointNames[i]);
    json["points_mm"][name] = {Mm(p_W.x()), Mm(p_W.y()), Mm(p_W.z())};
    json["points_std_mm"][name] = Mm(details.further_std_mm[i]);
  }
  for (int i = 0; i < kContactCount; ++i) {
    if (std::isnan(details.contacts[i])) continue;
    json["contacts"][std::string(kContactNames[i])] = RoundedTo(details.contacts[i], 1e3);
  }
  if (!std::isnan(details.probability)) json["probability"] = RoundedTo(details.probability, 1e4);
}

}  // namespace

std::string PoseJson(const StreamedPose& pose) {
  const auto state = static_cast<std::size_t>(std::clamp<int>(pose.message.state, 0, 3));
  Json json{{"utime", pose.message.utime},
            {"frame", pose.message.frame},
            {"state", kCaptureStateNames[state]}};
  if (pose.person != 0) {
    json["person"] = pose.person;
    json["name"] = pose.name;
  }
  if (pose.is_tracked) {
    AddPose(pose.message, *pose.body, json);
    AddDetails(pose.details, json);
  }
  return JsonText(json);
}

}  // namespace mocap
