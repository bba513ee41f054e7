#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <lcm/lcm-cpp.hpp>
#include <limits>
#include <map>
#include <mocap/body_t.hpp>
#include <mocap/people_t.hpp>
#include <mocap/person_body_t.hpp>
#include <mocap/pose_t.hpp>
#include <optional>
#include <string>
#include <vector>

#include "config/load_config.h"
#include "core/body/body_sizes.h"
#include "daemon/messages/messages.h"
#include "tests/support/box_take.h"
#include "tests/support/setup_error.h"
#include "tests/support/temporary_folder.h"
#include "tools/results/result.h"
#include "tools/view/take_site.h"

namespace mocap {
namespace {

using ::testing::HasSubstr;
using testing::ReadText;
using testing::SetupErrorOf;
using testing::TemporaryFolder;

/// Writes a message into a log as lcm-logger does.
template <typename Message>
void Log(lcm::LogFile& log, const std::string& channel, const Message& message) {
  std::vector<char> bytes(message.getEncodedSize());
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  lcm::LogEvent event{0, 1, channel, static_cast<int>(bytes.size()), bytes.data()};
  ASSERT_EQ(log.writeEvent(&event), 0);
}

TEST(ResultLog, IsReadAsAResult) {
  TemporaryFolder folder;
  const std::string file = folder.path() / "lcm.log";
  const BodyModel body(LoadBodyTable("mikic2003"), AverageSizes(1700));
  CaptureResult tracked;
  tracked.state = CaptureState::kTracking;
  tracked.pose.theta = JointAngles::LinSpaced(body.joint_count(), 0, 1);
  tracked.pose.X_WT.p = Vector3(1, 2, 3);
  tracked.points_W.setConstant(7);
  tracked.point_std_mm.setConstant(1);
  tracked.voxels = 5;
  const VoxelGrid grid;
  {
    lcm::LogFile log(file, "w");
    body_t body_message{};
    FillBody(body, 0, body_message);
    Log(log, "PRE_MOCAP_BODY", body_message);
    pose_t pose{};
    FillPose({.frame = 4,
              .capture_ns = 9000,
              .cameras = 0b101,
              .result = tracked,
              .body = body,
              .grid = grid},
             3, pose);
    Log(log, "OTHER", pose);
    Log(log, "PRE_MOCAP_POSE", pose);
    CaptureResult searching;
    FillPose({.frame = 5, .capture_ns = 42000, .result = searching, .body = body, .grid = grid}, 1,
             pose);
    Log(log, "PRE_MOCAP_POSE", pose);
  }
  const Result result = ReadResult(file);
  EXPECT_EQ(result.body.model, "mikic2003");
  EXPECT_EQ(result.body.sizes.thigh, body.sizes().thigh);
  ASSERT_EQ(result.poses.size(), 2u);
  EXPECT_EQ(result.poses[0].frame, 4);
  EXPECT_EQ(result.poses[0].timestamp_ns, 9000);
  EXPECT_EQ(result.poses[0].state, CaptureState::kTracking);
  EXPECT_TRUE(result.poses[0].has_pose);
  EXPECT_EQ(result.poses[0].paper.torso_mm, Vector3(1, 2, 3));
  EXPECT_EQ(result.poses[0].points_W(1, 8), 7);
  EXPECT_EQ(result.poses[0].first_cameras, 0b101);
  EXPECT_EQ(result.poses[0].point_std_mm, PointStds::Constant(1));
  EXPECT_EQ(result.body.joints.at(5).name, body.table().joints[5].name);
  EXPECT_EQ(result.poses[0].joint_rad, tracked.pose.theta);
  EXPECT_FALSE(result.poses[1].has_pose);
}

/// A log of daemons that see somebody walk.
class PoseLog : public ::testing::Test {
 protected:
  void Body(const std::string& prefix) {
    body_t message{};
    FillBody(body_, 0, message);
    Log(*log_, prefix + "MOCAP_BODY", message);
  }
  void Pose(const std::string& prefix, int frame, std::int64_t time_ns, double z_mm = 0) {
    CaptureResult tracked;
    tracked.state = CaptureState::kTracking;
    tracked.pose.theta = JointAngles::Zero(body_.joint_count());
    tracked.points_W.setConstant(z_mm);
    tracked.point_std_mm.setConstant(1);
    const VoxelGrid grid;
    pose_t message{};
    FillPose(
        {.frame = frame, .capture_ns = time_ns, .result = tracked, .body = body_, .grid = grid}, 1,
        message);
    Log(*log_, prefix + "MOCAP_POSE", message);
  }
  std::string Error(const std::optional<std::string>& prefix = {}) {
    log_.reset();
    return SetupErrorOf([&] { ReadResult(file_, prefix); });
  }
  Result Read(const std::optional<std::string>& prefix = {}) {
    log_.reset();
    return ReadResult(file_, prefix);
  }

  TemporaryFolder folder_;
  const std::string file_ = folder_.path() / "lcm.log";
  const BodyModel body_{LoadBodyTable("mikic2003"), AverageSizes(1700)};
  std::optional<lcm::LogFile> log_{std::in_place, file_, "w"};
};

constexpr std::int64_t kStart_ns = 1'700'000'000'000'000'000, kPeriod_ns = 40'000'000;

TEST_F(PoseLog, OfTwoDaemonsIsNeverMixed) {
  for (const char* prefix : {"left.", "right."}) Body(prefix);
  for (int i = 0; i < 5; ++i) {
    Pose("left.", i, kStart_ns + i * kPeriod_ns, 1);
    Pose("right.", 100 + i, kStart_ns + i * kPeriod_ns + 1000, 2);
  }
  EXPECT_THAT(Error(), ::testing::AllOf(HasSubstr("\"left.\", \"right.\""), HasSubstr("--prefix")));
  const Result right = Read("right.");
  ASSERT_EQ(right.poses.size(), 5u);
  for (const PoseRow& row : right.poses) EXPECT_EQ(row.points_W(0, 0), 2);
  EXPECT_THAT(Error("middle."), ::testing::AllOf(HasSubstr("contains no middle.MOCAP_POSE"),
                                                 HasSubstr("\"left.\", \"right.\"")));
}

TEST_F(PoseLog, IsShownOfTheDaemonThatItsMessageAsksFor) {
  const std::filesystem::path take = folder_.path() / "take";
  testing::WriteBoxTake(take);
  for (const char* prefix : {"left.", "right."}) {
    Body(prefix);
    Pose(prefix, 0, testing::kFirstNs, 1);
  }
  log_.reset();
  EXPECT_THAT(SetupErrorOf([&] { TakeSite(take, {file_}); }), HasSubstr("with --prefix"));
  EXPECT_EQ(SetupErrorOf([&] { TakeSite(take, {file_}, "left."); }), "nothing was thrown");
}

/// A log of a daemon that follows several people.
class PeopleLog : public PoseLog {
 protected:
  /// A set with people of these numbers, each as far along x as his number says.
  void People(int frame, const std::vector<int>& ids, const std::string& prefix = "") {
    people_t set{};
    set.frame = frame;
    set.utime = (kStart_ns + later_ns_ + frame * kPeriod_ns) / 1000;
    set.num_people = static_cast<std::int32_t>(ids.size());
    for (const int id : ids) {
      person_t& person = set.people.emplace_back();
      person.id = id;
      person.name = names_[id];
      person.state = pose_t::TRACKING;
      person.residual_mm = residuals_mm_[id];
      for (auto& point : person.point_mm) point[0] = id;
    }
    Log(*log_, prefix + "MOCAP_PEOPLE", set);
  }
  void BodyOf(int id, const std::string& prefix = "") {
    person_body_t message{};
    message.id = id;
    FillBody(body_, 0, message.body);
    Log(*log_, prefix + "MOCAP_BODIES", message);
  }
  PeopleResults ReadAll(const std::optional<std::string>& prefix = {}) {
    log_.reset();
    return ReadPeople(file_, prefix);
  }

  std::map<int, std::string> names_;
  std::map<int, double> residuals_mm_;
  std::int64_t later_ns_ = 0;  ///< Than the time of a daemon's first frame.
};

TEST_F(PeopleLog, EachPersonIsAResult) {
  BodyOf(1);
  People(0, {1});
  BodyOf(12);
  People(1, {1, 12});
  People(2, {12});
  const PeopleResults people = ReadAll();
  ASSERT_EQ(people.size(), 2u);
  EXPECT_EQ(people[0].first, "person-1");
  EXPECT_EQ(people[1].first, "person-12");
  ASSERT_EQ(people[1].second.poses.size(), 2u);
  EXPECT_EQ(people[1].second.poses[0].frame, 1);
  EXPECT_EQ(people[1].second.poses[0].points_W(0, 3), 12);
  EXPECT_EQ(people[1].second.body.sizes.thigh, body_.sizes().thigh);
}

TEST_F(PeopleLog, ReadForOnePersonItTellsOfTheOthers) {
  Body("");
  Pose("", 0, kStart_ns);
  People(0, {1});
  Pose("", 1, kStart_ns + kPeriod_ns);
  People(1, {1, 2});
  EXPECT_THAT(Read().remarks, ::testing::ElementsAre(HasSubstr("several people")));
}

TEST_F(PeopleLog, NamesAreTakenThatMayBeFiles) {
  names_ = {{1, "anna"}, {2, "../x"}, {3, "anna"}};
  for (const int id : {1, 2, 3}) BodyOf(id);
  People(0, {1, 2, 3});
  const PeopleResults people = ReadAll();
  ASSERT_EQ(people.size(), 3u);
  EXPECT_EQ(people[0].first, "anna");
  EXPECT_EQ(people[1].first, "person-2");
  EXPECT_EQ(people[2].first, "person-3");
}

TEST_F(PeopleLog, WhatIsNotUnderstoodIsToldAndLeftOut) {
  BodyOf(1);
  People(1, {1, 2});
  People(1, {1});
  Log(*log_, "MOCAP_PEOPLE", body_t{});
  const PeopleResults people = ReadAll();
  ASSERT_EQ(people.size(), 1u);
  EXPECT_THAT(
      people[0].second.remarks,
      ::testing::ElementsAre(HasSubstr("1 message on MOCAP_PEOPLE not understood"),
                             HasSubstr("person-2 has no body"), HasSubstr("1 pose not later")));
}

TEST_F(PeopleLog, ANameIsNeverThatOfAnothersNumberNorTheSameInCapitals) {
  names_ = {{1, "Person-2"}, {3, "anna"}, {4, "Anna"}};
  for (const int id : {1, 2, 3, 4}) BodyOf(id);
  People(0, {1, 2, 3, 4});
  std::vector<std::string> names;
  for (const auto& [name, result] : ReadAll()) names.push_back(name);
  EXPECT_THAT(names, ::testing::ElementsAre("person-1", "person-2", "anna", "person-4"));
}

TEST_F(PeopleLog, OneWithNumbersThatAreNoneLeavesTheOthers) {
  residuals_mm_[1] = std::numeric_limits<double>::quiet_NaN();
  for (const int id : {1, 2}) BodyOf(id);
  People(0, {1, 2});
  residuals_mm_.clear();
  People(1, {1, 2});
  const PeopleResults people = ReadAll();
  ASSERT_EQ(people.size(), 2u);
  EXPECT_EQ(people[0].second.poses.size(), 1u);
  EXPECT_EQ(people[1].second.poses.size(), 2u);
  EXPECT_THAT(people[0].second.remarks,
              ::testing::ElementsAre(HasSubstr("1 pose with an invalid number")));
}

TEST_F(PeopleLog, AfterAnotherStartOfTheDaemonTheSameNumberIsSomebodyElse) {
  for (const int id : {1, 2}) BodyOf(id);
  for (const int frame : {0, 1, 2}) People(frame, {1, 2});
  later_ns_ = 60'000'000'000;
  People(0, {});
  BodyOf(1);
  People(1, {1});
  const PeopleResults people = ReadAll();
  ASSERT_EQ(people.size(), 3u);
  EXPECT_EQ(people[0].second.poses.size(), 3u);
  EXPECT_EQ(people[2].first, "person-3");
  EXPECT_EQ(people[2].second.poses.size(), 1u);
  EXPECT_THAT(people[0].second.remarks, ::testing::ElementsAre(HasSubstr("restarted")));
}

TEST_F(PeopleLog, AMessageThatWasOvertakenIsNoOtherStart) {
  BodyOf(1);
  for (const int frame : {0, 2, 1, 3}) People(frame, {1});
  const PeopleResults people = ReadAll();
  ASSERT_EQ(people.size(), 1u);
  EXPECT_EQ(people[0].second.poses.size(), 3u);
}

TEST_F(PeopleLog, OfTwoDaemonsOnOneChannelIsRefused) {
  BodyOf(1);
  for (int frame = 0; frame < 20; ++frame) {
    People(frame, {1});
    later_ns_ = 1'000'000;
    People(frame, {1});
    later_ns_ = 0;
  }
  log_.reset();
  EXPECT_THAT(SetupErrorOf([&] { ReadPeople(file_); }),
              HasSubstr("several daemons in turns on MOCAP_PEOPLE"));
}

TEST_F(PeopleLog, ThatIsDamagedOrNoLogIsTold) {
  BodyOf(1);
  for (const int frame : {0, 1, 2}) People(frame, {1});
  log_.reset();
  std::string log = ReadText(file_);
  const std::size_t second = log.find("MOCAP_PEOPLE", log.find("MOCAP_PEOPLE") + 1);
  testing::WriteText(file_, log.replace(second - 8, 4, "\x7f\xff\xff\xff"));
  const PeopleResults people = ReadPeople(file_);
  EXPECT_EQ(people[0].second.poses.size(), 2u);
  EXPECT_THAT(people[0].second.remarks, ::testing::ElementsAre(HasSubstr("damaged in 1 place")));
  testing::WriteText(file_, "no log at all\n");
  EXPECT_THAT(SetupErrorOf([&] { ReadPeople(file_); }), HasSubstr("is not an LCM log"));
  testing::WriteText(file_, "");
  EXPECT_THAT(SetupErrorOf([&] { ReadPeople(file_); }), HasSubstr("is empty"));
}

TEST_F(PeopleLog, OfTwoDaemonsIsNeverMixed) {
  for (const char* prefix : {"left.", "right."}) {
    BodyOf(1, prefix);
    People(0, {1}, prefix);
  }
  log_.reset();
  EXPECT_THAT(SetupErrorOf([&] { ReadPeople(file_); }), HasSubstr("\"left.\", \"right.\""));
  EXPECT_EQ(ReadPeople(file_, "left.").size(), 1u);
  EXPECT_THAT(SetupErrorOf([&] { ReadPeople(file_, "up."); }),
              HasSubstr("no people on up.MOCAP_PEOPLE"));
}

TEST_F(PoseLog, WithoutAPrefixIsNotSaidToHaveAnEmptyOne) {
  Body("");
  Pose("", 0, kStart_ns);
  EXPECT_THAT(Error("left."), HasSubstr("no left.MOCAP_POSE message of this version (it has "
                                        "channels without a prefix); expected"));
}

TEST_F(PoseLog, OfTwoDaemonsOnOneChannelIsRefused) {
  Body("");
  for (int i = 0; i < 20; ++i) {
    Pose("", i, kStart_ns + i * kPeriod_ns);
    Pose("", i, kStart_ns + i * kPeriod_ns + 1000);
  }
  EXPECT_THAT(Error(), HasSubstr("several daemons in turns on MOCAP_POSE"));
}

TEST_F(PoseLog, OfADaemonThatWasStartedAgainIsOne) {
  Body("");
  for (int i = 0; i < 10; ++i) Pose("", i, kStart_ns + i * kPeriod_ns);
  for (int i = 0; i < 10; ++i) Pose("", i, kStart_ns + 60'000'000'000 + i * kPeriod_ns);
  EXPECT_EQ(Read().poses.size(), 20u);
}

TEST_F(PoseLog, ForeignMessagesOnSuchAChannelBlockNobodyAndAreCounted) {
  Body("");
  Pose("", 0, kStart_ns);
  Log(*log_, "OLD_MOCAP_POSE", body_t{});
  Log(*log_, "MOCAP_POSE", body_t{});
  Pose("", 1, kStart_ns + kPeriod_ns);
  Pose("", 2, kStart_ns + 2 * kPeriod_ns, std::numeric_limits<double>::quiet_NaN());
  const Result result = Read();
  EXPECT_EQ(result.poses.size(), 2u);
  EXPECT_THAT(result.remarks, ::testing::ElementsAre(HasSubstr("2 messages on MOCAP_POSE"),
                                                     HasSubstr("1 message on OLD_MOCAP_POSE")));
}

TEST_F(PoseLog, DamageIsPassedOverAndTold) {
  Body("");
  for (int i = 0; i < 4; ++i) Pose("", i, kStart_ns + i * kPeriod_ns);
  log_.reset();
  std::string log = ReadText(file_);
  const std::size_t second = log.find("MOCAP_POSE", log.find("MOCAP_POSE") + 1);
  testing::WriteText(file_,
                     log.replace(second - 8, 4, "\x7f\xff\xff\xff").substr(0, log.size() - 9));
  const Result result = Read();
  EXPECT_EQ(result.poses.size(), 2u);
  EXPECT_THAT(result.remarks, ::testing::ElementsAre(HasSubstr("is damaged in 2 places")));
}

TEST_F(PoseLog, AClockThatWasSetBackIsTold) {
  Body("");
  for (int i = 0; i < 5; ++i) Pose("", i, kStart_ns + i * kPeriod_ns);
  for (int i = 5; i < 10; ++i) Pose("", i, kStart_ns - 3'600'000'000'000 + i * kPeriod_ns);
  EXPECT_THAT(Read().remarks, ::testing::ElementsAre(HasSubstr("go back at frame 5")));
}

TEST(ResultLog, WithoutPosesIsASetupError) {
  TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "lcm.log";
  testing::WriteText(file, "no log at all\n");
  EXPECT_THAT(SetupErrorOf([&] { ReadResult(file); }), HasSubstr("is not an LCM log"));
  testing::WriteText(file, "");
  EXPECT_THAT(SetupErrorOf([&] { ReadResult(file); }), HasSubstr("is empty"));
  {
    lcm::LogFile log(file, "w");
    Log(log, "MOCAP_POSE", body_t{});
  }
  EXPECT_THAT(SetupErrorOf([&] { ReadResult(file); }),
              HasSubstr("contains no MOCAP_POSE message of this version"));
}

}  // namespace
}  // namespace mocap
