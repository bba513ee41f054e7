// Probabilities in logs of messages.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <lcm/lcm-cpp.hpp>
#include <mocap/people_t.hpp>
#include <mocap/person_body_t.hpp>
#include <mocap/person_details_t.hpp>
#include <mocap/pose_t.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tests/support/posed_people.h"
#include "tests/support/temporary_folder.h"
#include "tools/results/result.h"

namespace mocap {
namespace {

using testing::BodyMessage;
using testing::PersonMessage;
using testing::PoseMessage;
using testing::RandomPose;

/// A log of a daemon that tells how sure poses are.
class DetailsLog : public ::testing::Test {
 protected:
  template <typename Message>
  void Add(const std::string& channel, const Message& message) {
    std::vector<char> bytes(static_cast<std::size_t>(message.getEncodedSize()));
    message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
    lcm::LogEvent event{0, 1, channel, static_cast<int>(bytes.size()), bytes.data()};
    ASSERT_EQ(log_->writeEvent(&event), 0);
  }
  pose_t Pose(int frame) const { return PoseMessage(body_, RandomPose(body_, 1), frame); }
  void AddBodyOf(int id) {
    person_body_t message{};
    message.id = id;
    message.body = BodyMessage(body_);
    Add("MOCAP_BODIES", message);
  }
  void AddPeople(int frame, const std::vector<int>& ids) {
    people_t set{};
    set.frame = frame;
    set.utime = Pose(frame).utime;
    set.num_people = static_cast<std::int32_t>(ids.size());
    for (const int id : ids) set.people.push_back(PersonMessage(id, "", Pose(frame)));
    Add("MOCAP_PEOPLE", set);
  }
  void AddDetails(int frame, int id, int place, double probability, const char* prefix = "") {
    person_details_t message{};
    message.frame = frame;
    message.utime = Pose(frame).utime;
    message.person = id;
    message.place = place;
    message.probability = probability;
    Add(std::string(prefix) + "MOCAP_DETAILS", message);
  }

  const BodyModel body_{LoadBodyTable("full"), AverageSizes(1700)};
  testing::TemporaryFolder folder_;
  const std::string file_ = folder_.path() / "lcm.log";
  std::optional<lcm::LogFile> log_{std::in_place, file_, "w"};
};

TEST_F(DetailsLog, TellsHowSureThePoseOfEachPersonIs) {
  for (const int id : {1, 12}) AddBodyOf(id);
  AddDetails(0, 1, 0, 0.9);
  AddDetails(0, 12, 1, 0.6);
  AddPeople(0, {1, 12});
  AddDetails(1, 12, 0, 0.7, "left.");
  AddPeople(1, {1, 12});
  log_.reset();
  const PeopleResults people = ReadPeople(file_);
  ASSERT_EQ(people.size(), 2u);
  EXPECT_EQ(people[0].second.poses.at(0).probability, 0.9);
  EXPECT_EQ(people[1].second.poses.at(0).probability, 0.6);
  for (const auto& [name, result] : people)
    EXPECT_TRUE(std::isnan(result.poses.at(1).probability)) << name << "'s details were lost";
}

TEST_F(DetailsLog, ThePersonTrackedLongestIsTheFirstOfTheDetails) {
  Add("MOCAP_BODY", BodyMessage(body_));
  AddDetails(0, 12, 0, 0.6);
  AddDetails(0, 1, 1, 0.9);
  Add("MOCAP_POSE", Pose(0));
  AddDetails(1, 12, 0, 7);
  Add("MOCAP_POSE", Pose(1));
  log_.reset();
  const Result result = ReadResult(file_);
  ASSERT_EQ(result.poses.size(), 2u);
  EXPECT_EQ(result.poses[0].probability, 0.6);
  EXPECT_TRUE(std::isnan(result.poses[1].probability)) << "7 is no probability";
  EXPECT_THAT(
      result.remarks,
      ::testing::ElementsAre(::testing::HasSubstr("1 message on MOCAP_DETAILS not understood")));
}

}  // namespace
}  // namespace mocap
