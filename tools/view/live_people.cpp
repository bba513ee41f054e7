#include "tools/view/live_people.h"

#include <algorithm>

#include "core/people/people_capture.h"
#include "daemon/base/json.h"
#include "tools/results/pose_log.h"

namespace mocap {
namespace {

/// A sender that is silent for longer may have been restarted.
constexpr double kLongestGapUs = 3e6;

void AddDoubt(const person_details_t* details, DrawnPose& drawn) {
  ApplyDetails(details, drawn.row);
  if (!details || details->rival_probability == 0 || details->num_rival_points < kPointCount)
    return;
  RivalPose& rival = drawn.rival.emplace();
  rival.probability = details->rival_probability;
  for (int i = 0; i < kPointCount; ++i)
    rival.points_W.col(i) = Vector3(details->rival_point_mm[i].data());
}

}  // namespace

DrawnPose DrawnPoseOf(const pose_t& pose, const PoseRow& row, const DrawnBody* body) {
  DrawnPose drawn;
  drawn.row = row;
  drawn.publish_ms = static_cast<double>(pose.publish_utime) / 1000;
  if (body) drawn.capsules = body->Pose(pose, row);
  return drawn;
}

std::vector<DrawnPose> LivePeople::Take(const people_t& set, const SetDetails& details) {
  // Another daemon numbers people independently.
  const auto at_us = static_cast<double>(set.publish_utime);
  const bool goes_on = heard_us_ && at_us >= *heard_us_ && at_us - *heard_us_ < kLongestGapUs;
  if (!goes_on) {
    people_.clear();
    heard_us_.reset();
  }
  // Remove those who left first, to free their colours.
  std::erase_if(people_, [&](const Person& person) {
    return std::ranges::find(set.people, person.id, &person_t::id) == set.people.end();
  });
  std::vector<DrawnPose> poses;
  for (const person_t& person : set.people) {
    if (poses.size() == kMostPeople) break;
    const pose_t pose = PoseOf(set, person);
    const std::optional<PoseRow> row = PoseRowOf(pose);
    if (!row) continue;
    const Person& known = Welcome(set, person);
    DrawnPose& drawn =
        poses.emplace_back(DrawnPoseOf(pose, *row, known.body ? &*known.body : nullptr));
    drawn.person = known.color;
    drawn.id = known.id;
    AddDoubt(details.Of(set.utime, known.id), drawn);
  }
  heard_us_ = at_us;
  return poses;
}

LivePeople::Person& LivePeople::Welcome(const people_t& set, const person_t& person) {
  auto found = std::ranges::find(people_, person.id, &Person::id);
  if (found == people_.end()) {
    int color = 0;
    while (std::ranges::find(people_, color, &Person::color) != people_.end()) ++color;
    people_.push_back({.id = person.id,
                       .color = color,
                       .since_ms = static_cast<double>(set.publish_utime) / 1000,
                       .has_come = heard_us_.has_value()});
    found = people_.end() - 1;
  }
  found->name = person.name;
  return *found;
}

void LivePeople::TakeBody(const person_body_t& message) {
  const auto found = std::ranges::find(people_, message.id, &Person::id);
  const std::optional<BodyRecord> record = BodyRecordOf(message.body);
  if (found == people_.end() || !record) return;
  if (!found->body || !found->body->IsOf(*record)) found->body.emplace(*record);
}

const LivePeople::Person* LivePeople::Find(int id) const {
  const auto found = std::ranges::find(people_, id, &Person::id);
  return found == people_.end() ? nullptr : &*found;
}

std::string LivePeople::Json() const {
  nlohmann::ordered_json json{{"type", "people"}, {"people", nlohmann::ordered_json::array()}};
  for (const Person& person : people_) {
    json["people"].push_back({{"id", person.id},
                              {"color", person.color},
                              {"name", person.name},
                              {"since_ms", person.since_ms},
                              {"has_come", person.has_come}});
  }
  return JsonText(json);
}

}  // namespace mocap
