#include "daemon/messages/decode_message.h"

#include <gtest/gtest.h>

#include <vector>

namespace mocap {
namespace {

template <typename Message>
std::vector<std::uint8_t> Encoded(const Message& message) {
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

pose_t SomePose() {
  pose_t pose{};
  pose.frame = 7;
  pose.num_joints = 2;
  pose.joint_rad = {0.1, 0.2};
  pose.num_cameras = 3;
  pose.camera_used = {1, 0, 1};
  return pose;
}

body_t SomeBody() {
  body_t body{};
  body.model = "full";
  for (std::string& name : body.point_name) name.assign("point");
  body.num_joints = 1;
  body.joint_name = {"neck"};
  body.joint_parent = {-1};
  body.joint_axis = body.joint_place_mm = {{0, 0, 1}};
  body.joint_min_rad = body.joint_max_rad = {0};
  body.num_sizes = 1;
  body.size_name = {"thigh"};
  body.size_mm = {440};
  return body;
}

people_t SomePeople() {
  people_t people{};
  people.num_people = 2;
  people.people.resize(2);
  people.people[0].id = 3;
  people.people[0].name = "anna";
  people.people[1].num_joints = 2;
  people.people[1].joint_rad = {0.1, 0.2};
  people.num_cameras = 1;
  people.camera_used = {1};
  return people;
}

person_body_t SomePersonBody() {
  person_body_t body{};
  body.id = 3;
  body.name = "anna";
  body.body = SomeBody();
  return body;
}

person_details_t SomeDetails() {
  person_details_t details{};
  details.person = 3;
  details.probability = 0.75;
  details.num_points = 2;
  details.point_name = {"head", "toe_l"};
  details.point_mm = {{1, 2, 3}, {4, 5, 6}};
  details.point_std_mm = {7, 8};
  details.num_joints = 1;
  details.joint_name = {"neck_x"};
  details.joint_rad = {0.1};
  details.joint_std_rad = {0.01};
  details.num_contacts = 1;
  details.contact_name = {"heel_l"};
  details.contact = {1};
  details.rival_probability = 0.25;
  details.num_rival_points = 2;
  details.rival_point_mm = {{1, 2, 3}, {4, 5, 6}};
  return details;
}

status_t SomeStatus() {
  status_t status{};
  status.version = "0.1.0";
  status.num_cameras = 1;
  status.cameras.resize(1);
  status.cameras[0].name = "cam1";
  status.num_stages = 1;
  status.stages.resize(1);
  status.stages[0].name = "carve";
  return status;
}

service_t SomeService() {
  service_t service{};
  service.studio = "small";
  service.num_complaints = 1;
  service.complaint = {"cam1 is lost"};
  service.calibration = "calibration.toml";
  service.num_cameras = 2;
  service.camera_trust = {0.9, -1};
  service.camera_off_px = {0.4, 0};
  service.camera_light = {1, 0.8};
  return service;
}

contrast_t SomeContrast() {
  contrast_t contrast{};
  contrast.num_cameras = 2;
  contrast.camera = {"cam1", "cam2"};
  contrast.unknown_share = {0.4, -1};
  return contrast;
}

studio_t SomeStudio() {
  studio_t studio{};
  studio.name = "small";
  studio.calibration = "[cameras.cam1]";
  return studio;
}

preview_t SomePreview() {
  preview_t preview{};
  preview.camera = "cam1";
  preview.num_bytes = 3;
  preview.jpeg = {0xff, 0xd8, 0xff};
  preview.num_runs = 2;
  preview.run = {5, 7};
  return preview;
}

unknown_t SomeUnknown() {
  unknown_t unknown{};
  unknown.camera = "cam1";
  unknown.num_runs = 2;
  unknown.run = {5, 7};
  return unknown;
}

voxels_t SomeVoxels() {
  voxels_t voxels{};
  voxels.num_runs = 2;
  voxels.run = {1, 2};
  voxels.num_labels = 2;
  voxels.label = {0, -1};
  return voxels;
}

keypoints_t SomeKeypoints() {
  keypoints_t keypoints{};
  keypoints.version = keypoints_t::VERSION;
  keypoints.sender = "witness";
  keypoints.camera = "cam1";
  keypoints.num_points = 2;
  keypoints.points = {{"nose", 1, 2, 0.5}, {"hip_l", 3, 4, 1}};
  return keypoints;
}

keypoint_senders_t SomeKeypointSenders() {
  keypoint_senders_t senders{};
  senders.num_senders = 1;
  senders.name = {"witness"};
  senders.views_per_second = {3};
  senders.lag_ms = {80};
  senders.taken = {900};
  senders.dropped_points = {1};
  senders.agreement = {-1};
  senders.num_reasons = 2;
  senders.reason = {"old", "full"};
  senders.refused = {{1, 0}};
  return senders;
}

look_request_t SomeLookRequest() {
  look_request_t request{};
  request.asker = "witness";
  request.rate_hz = 3;
  request.hold_s = 10;
  return request;
}

look_t SomeLook() {
  look_t look{};
  look.camera = "cam1";
  look.num_bytes = 3;
  look.picture = {0xff, 0xd8, 0xff};
  return look;
}

/// Whole messages come back; none of their beginnings is taken for one.
template <typename Message>
void ExpectWholeOrNothing(const Message& message) {
  const std::vector<std::uint8_t> bytes = Encoded(message);
  const std::span<const std::uint8_t> all(bytes);
  ASSERT_TRUE(DecodeMessage<Message>(all));
  EXPECT_EQ(Encoded(*DecodeMessage<Message>(all)), bytes);
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_FALSE(DecodeMessage<Message>(all.first(size))) << size;
  }
}

TEST(DecodeMessage, GivesWholeMessagesOrNothing) {
  ExpectWholeOrNothing(SomePose());
  ExpectWholeOrNothing(SomeBody());
  ExpectWholeOrNothing(SomePeople());
  ExpectWholeOrNothing(SomePersonBody());
  ExpectWholeOrNothing(SomeDetails());
  ExpectWholeOrNothing(SomeStatus());
  ExpectWholeOrNothing(SomeService());
  ExpectWholeOrNothing(SomeContrast());
  ExpectWholeOrNothing(SomeStudio());
  ExpectWholeOrNothing(SomePreview());
  ExpectWholeOrNothing(SomeUnknown());
  ExpectWholeOrNothing(SomeVoxels());
  ExpectWholeOrNothing(SomeKeypoints());
  ExpectWholeOrNothing(SomeLookRequest());
  ExpectWholeOrNothing(SomeLook());
  ExpectWholeOrNothing(SomeKeypointSenders());
}

TEST(DecodeMessage, AForgedCountTakesNoMemory) {
  std::vector<std::uint8_t> bytes = Encoded(SomePose());
  const std::size_t num_joints = 8 + 4 * 8 + 1 + 6 * 8 + 17 * 8;
  ASSERT_EQ(bytes[num_joints + 3], 2);
  for (const std::uint8_t first : {0x7f, 0xff}) {
    bytes[num_joints] = first;
    EXPECT_FALSE(DecodeMessage<pose_t>(bytes));
  }
}

TEST(DecodeMessage, AForgedNumberOfPointsTakesNoMemory) {
  std::vector<std::uint8_t> bytes = Encoded(SomeDetails());
  const std::size_t num_points = 8 + 2 * 8 + 2 * 4 + 1 + 8;
  const std::size_t num_rival_points = bytes.size() - 2 * 3 * 8 - 4;
  for (const std::size_t place : {num_points, num_rival_points}) {
    ASSERT_EQ(bytes[place + 3], 2);
    for (const std::uint8_t first : {0x7f, 0xff}) {
      bytes[place] = first;
      EXPECT_FALSE(DecodeMessage<person_details_t>(bytes));
    }
    bytes[place] = 0;
  }
}

TEST(DecodeMessage, AForgedNumberOfPeopleTakesNoMemory) {
  std::vector<std::uint8_t> bytes = Encoded(SomePeople());
  const std::size_t num_people = 8 + 4 * 8;
  ASSERT_EQ(bytes[num_people + 3], 2);
  for (const std::uint8_t first : {0x7f, 0xff}) {
    bytes[num_people] = first;
    EXPECT_FALSE(DecodeMessage<people_t>(bytes));
  }
}

}  // namespace
}  // namespace mocap
