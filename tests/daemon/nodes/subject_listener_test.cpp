#include "daemon/nodes/subject_listener.h"

#include <gtest/gtest.h>

#include <vector>

#include "core/motion_capture.h"
#include "daemon/messages/messages.h"

namespace mocap {
namespace {

class SubjectListenerTest : public ::testing::Test {
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
  SubjectListener listener_{LcmConfig{}, position_};
};

TEST_F(SubjectListenerTest, HeadsLookAtTheMiddleOfAllWhoAreTracked) {
  Hear({PersonAt(-500, CaptureState::kTracking), PersonAt(1500, CaptureState::kTracking),
        PersonAt(9000, CaptureState::kLost)});
  ASSERT_TRUE(position_->Told());
  EXPECT_EQ(*position_->Told(), Vector3(500, 0, 1000));
  EXPECT_TRUE(listener_.Hears());
}

TEST_F(SubjectListenerTest, NobodyIsNowhere) {
  Hear({PersonAt(0, CaptureState::kTracking)});
  Hear({});
  EXPECT_FALSE(position_->Told());
}

TEST_F(SubjectListenerTest, AStudioThatIsSilentTellsOfNobody) {
  position_->Tell(Vector3(1, 2, 3));
  EXPECT_FALSE(listener_.Hears());
  EXPECT_FALSE(position_->Told());
}

TEST_F(SubjectListenerTest, WhatIsNoMessageChangesNothing) {
  Hear({PersonAt(700, CaptureState::kTracking)});
  listener_.OnPeople(std::vector<std::uint8_t>(40, 0xff));
  EXPECT_EQ(*position_->Told(), Vector3(700, 0, 1000));
}

}  // namespace
}  // namespace mocap
