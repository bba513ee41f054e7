#include "daemon/nodes/studio_listener.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "core/motion_capture.h"
#include "daemon/messages/messages.h"
#include "drivers/clock.h"

namespace mocap {
namespace {

class StudioListenerTest : public ::testing::Test {
 protected:
  static person_t PersonAt(double x_mm, CaptureState state) {
    person_t person{};
    person.state = static_cast<std::int8_t>(state);
    person.torso_mm[0] = x_mm;
    person.torso_mm[2] = 1000;
    person.num_joints = 0;
    return person;
  }
  void Hear(const std::vector<person_t>& people) {
    people_t message{};
    message.people = people;
    message.num_people = static_cast<std::int32_t>(people.size());
    message.num_cameras = 0;
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
    message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
    listener_.OnPeople(bytes);
  }

  std::shared_ptr<SubjectPosition> position_ = std::make_shared<SubjectPosition>();
  StudioListener listener_{LcmConfig{}, {"cam1", "cam2"}, position_};
};

TEST_F(StudioListenerTest, HeadsLookAtTheMiddleOfAllWhoAreTracked) {
  Hear({PersonAt(-500, CaptureState::kTracking), PersonAt(1500, CaptureState::kTracking),
        PersonAt(9000, CaptureState::kLost)});
  ASSERT_TRUE(position_->Told());
  EXPECT_EQ(*position_->Told(), Vector3(500, 0, 1000));
  listener_.Hears();
  EXPECT_TRUE(position_->Told()) << "what was heard just now holds";
}

TEST_F(StudioListenerTest, NobodyIsNowhere) {
  Hear({PersonAt(0, CaptureState::kTracking)});
  Hear({});
  EXPECT_FALSE(position_->Told());
}

TEST_F(StudioListenerTest, AStudioThatIsSilentTellsOfNobody) {
  position_->Tell(Vector3(1, 2, 3));
  EXPECT_FALSE(listener_.Hears());
  EXPECT_FALSE(position_->Told());
}

TEST_F(StudioListenerTest, WhatIsNoMessageChangesNothing) {
  Hear({PersonAt(700, CaptureState::kTracking)});
  listener_.OnPeople(std::vector<std::uint8_t>(40, 0xff));
  EXPECT_EQ(*position_->Told(), Vector3(700, 0, 1000));
}

constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr int kStarting = camera_status_t::STARTING, kStreaming = camera_status_t::STREAMING,
              kLost = camera_status_t::LOST;

std::vector<std::uint8_t> StatusOf(const std::vector<std::pair<std::string, int>>& cameras) {
  status_t message{};
  for (const auto& [name, state] : cameras) {
    camera_status_t& camera = message.cameras.emplace_back();
    camera = {};
    camera.name = name;
    camera.state = static_cast<std::int8_t>(state);
  }
  message.num_cameras = static_cast<std::int32_t>(cameras.size());
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

std::vector<std::uint8_t> ServiceThat(std::int8_t recording_state) {
  service_t message{};
  message.recording_state = recording_state;
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

TEST_F(StudioListenerTest, AStudioThatIsNotHeardIsSilentSinceTheStart) {
  const std::int64_t now_ns = SteadyNs();
  const StudioLink link = listener_.Link(now_ns + 9 * kSecond_ns);
  EXPECT_GE(link.silent_ns, 8 * kSecond_ns);
  EXPECT_TRUE(link.unreceived.empty()) << "one fault is told once";
}

TEST_F(StudioListenerTest, CamerasThatTheStudioDoesNotReceiveAreNamed) {
  std::int64_t now_ns = SteadyNs();
  for (int s = 0; s < 8; ++s) {
    now_ns += kSecond_ns;
    listener_.OnStatus(StatusOf({{"cam1", kStreaming}, {"cam2", kLost}}), now_ns);
  }
  EXPECT_EQ(listener_.Link(now_ns).silent_ns, 0);
  EXPECT_EQ(listener_.Link(now_ns).unreceived, std::vector<std::string>{"cam2"});
  listener_.OnStatus(StatusOf({{"cam2", kStreaming}}), now_ns);
  EXPECT_TRUE(listener_.Link(now_ns).unreceived.empty());
}

TEST_F(StudioListenerTest, AStudioThatWasStartedAnewHasTimeToReceive) {
  const std::int64_t now_ns = SteadyNs() + 60 * kSecond_ns;
  listener_.OnStatus(StatusOf({{"cam1", kStarting}}), now_ns);
  EXPECT_TRUE(listener_.Link(now_ns).unreceived.empty());
}

TEST_F(StudioListenerTest, KnowsSinceWhenTheStudioRecordsNothing) {
  const std::int64_t now_ns = SteadyNs() + 60 * kSecond_ns;
  listener_.OnService(ServiceThat(service_t::RUNNING), now_ns);
  EXPECT_EQ(listener_.Link(now_ns).unrecorded_ns, 0);
  listener_.OnService(ServiceThat(service_t::COMPLETE), now_ns + 4 * kSecond_ns);
  EXPECT_EQ(listener_.Link(now_ns + 7 * kSecond_ns).unrecorded_ns, 7 * kSecond_ns);
  listener_.OnService(std::vector<std::uint8_t>(40, 0xff), now_ns + 8 * kSecond_ns);
  EXPECT_EQ(listener_.Link(now_ns + 8 * kSecond_ns).unrecorded_ns, 8 * kSecond_ns);
}

TEST_F(StudioListenerTest, WhatIsNoStatusIsNotHeard) {
  listener_.OnStatus(std::vector<std::uint8_t>(40, 0xff), SteadyNs() + 5 * kSecond_ns);
  EXPECT_GT(listener_.Link(SteadyNs() + 5 * kSecond_ns).silent_ns, 4 * kSecond_ns);
}

}  // namespace
}  // namespace mocap
