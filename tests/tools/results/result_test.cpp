#include "tools/results/result.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <functional>
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
#include "core/errors.h"
#include "daemon/messages/messages.h"
#include "tests/support/temporary_folder.h"

namespace mocap {
namespace {

using ::testing::HasSubstr;
using testing::ReadText;
using testing::ReplaceInFile;
using ::testing::StartsWith;
using testing::TemporaryFolder;

Result SomeResult() {
  Result result;
  result.body = {"full", 1712.5, AverageSizes(1700)};
  result.poses.resize(3);
  for (int i = 0; i < 3; ++i) {
    PoseRow& row = result.poses[i];
    row.frame = i;
    row.timestamp_ns = 1'700'000'000'000'000'000 + i * 33'333'333;
    row.voxels = 100 * i;
    row.has_pose = i > 0;
    if (!row.has_pose) continue;
    row.state = i == 1 ? CaptureState::kAcquiring : CaptureState::kTracking;
    row.paper.torso_mm = Vector3(1, -2.5, 1300.125);
    row.paper.torso_axis = Vector3(0.6, 0, 0.8);
    row.paper.torso_angle_rad = -1e-9;
    row.paper.theta_rad[15] = 2.25;
    row.points_W = BodyPoints::Constant(-0.0001);
    row.points_W(2, 22) = 83.5;
    row.residual_mm = 12.25;
  }
  return result;
}

std::string Message(const std::function<void()>& action) {
  try {
    action();
  } catch (const SetupError& error) {
    return error.what();
  }
  return "nothing was thrown";
}

TEST(Result, ReadsBackWhatWasWritten) {
  TemporaryFolder folder;
  const Result written = SomeResult();
  WriteResult(folder.path() / "out", written);
  const Result read = ReadResult(folder.path() / "out");
  EXPECT_EQ(read.body.model, "full");
  EXPECT_EQ(read.body.stature_mm, 1712.5);
  EXPECT_NEAR(read.body.sizes.hip_width, written.body.sizes.hip_width, 0.05);
  ASSERT_EQ(read.poses.size(), 3u);
  EXPECT_FALSE(read.poses[0].has_pose);
  EXPECT_EQ(read.poses[1].state, CaptureState::kAcquiring);
  const PoseRow& row = read.poses[2];
  EXPECT_EQ(row.frame, 2);
  EXPECT_EQ(row.timestamp_ns, written.poses[2].timestamp_ns);
  EXPECT_EQ(row.paper.torso_mm, written.poses[2].paper.torso_mm);
  EXPECT_EQ(row.paper.theta_rad[15], 2.25);
  EXPECT_EQ(row.points_W(2, 22), 83.5);
  EXPECT_EQ(row.residual_mm, 12.25);
  EXPECT_EQ(row.voxels, 200);
}

TEST(Result, HasTheContractsColumns) {
  TemporaryFolder folder;
  WriteResult(folder.path(), SomeResult());
  const std::string csv = ReadText(folder.path() / "poses.csv");
  EXPECT_THAT(csv,
              StartsWith("frame,timestamp_ns,state,torso_x_mm,torso_y_mm,torso_z_mm,"
                         "torso_axis_x,torso_axis_y,torso_axis_z,torso_angle_rad,theta_1_rad,"));
  EXPECT_THAT(csv, HasSubstr(",theta_16_rad,torso_x_mm,torso_y_mm,torso_z_mm,head_x_mm,"));
  EXPECT_THAT(csv, HasSubstr(",foot_r_z_mm,residual_mm,voxels\n0,"));
  const std::string first_row = csv.substr(csv.find('\n') + 1, csv.find('\n'));
  EXPECT_THAT(first_row, StartsWith("0,1700000000000000000,searching,,,,"));
  const auto commas = [](const std::string& line) { return std::ranges::count(line, ','); };
  EXPECT_EQ(commas(first_row.substr(0, first_row.find('\n'))), 3 + 7 + 16 + 69 + 2 - 1);
}

TEST(Result, WritesNoNegativeZero) {
  TemporaryFolder folder;
  WriteResult(folder.path(), SomeResult());
  EXPECT_EQ(ReadText(folder.path() / "poses.csv").find("-0.000,"), std::string::npos);
}

TEST(Result, WritesTheSameBytesOverAnOlderResult) {
  TemporaryFolder folder;
  WriteResult(folder.path(), SomeResult());
  const std::string before = ReadText(folder.path() / "poses.csv");
  WriteResult(folder.path(), Result{});
  WriteResult(folder.path(), SomeResult());
  EXPECT_EQ(ReadText(folder.path() / "poses.csv"), before);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 2)
      << "nothing unfinished is left";
}

TEST(Result, HoldsOnlyThePeopleOfTheLastRun) {
  TemporaryFolder folder;
  WritePeople(folder.path(), {{1, SomeResult()}, {2, SomeResult()}});
  testing::WriteText(folder.path() / "person-1" / "truth.csv", "somebody's");
  WritePeople(folder.path(), {{3, SomeResult()}});
  EXPECT_EQ(PersonFolders(folder.path()),
            (std::vector{folder.path() / "person-1", folder.path() / "person-3"}));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "person-1" / "poses.csv"));
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "person-1" / "truth.csv"));
  EXPECT_EQ(ReadResult(folder.path() / "person-3").poses.size(), 3u);

  WriteResult(folder.path(), SomeResult());
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "person-3"));
  WritePeople(folder.path(), {{1, SomeResult()}});
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "poses.csv"));
}

TEST(Result, DamageIsNamedWithFileAndLine) {
  TemporaryFolder folder;
  const auto read = [&] { ReadResult(folder.path()); };
  WriteResult(folder.path(), SomeResult());
  ReplaceInFile(folder.path() / "poses.csv", "tracking", "hovering");
  EXPECT_THAT(Message(read), HasSubstr("poses.csv:4: state is \"hovering\""));
  WriteResult(folder.path(), SomeResult());
  ReplaceInFile(folder.path() / "poses.csv", "2.250000", "2.25x");
  EXPECT_THAT(Message(read),
              HasSubstr("poses.csv:3: theta_16_rad is \"2.25x\"; a number is wanted"));
  WriteResult(folder.path(), SomeResult());
  ReplaceInFile(folder.path() / "poses.csv", ",acquiring", "");
  EXPECT_THAT(Message(read), HasSubstr("poses.csv:3: has 96 fields; 97 are wanted"));
  WriteResult(folder.path(), SomeResult());
  ReplaceInFile(folder.path() / "poses.csv", "timestamp_ns", "time");
  EXPECT_THAT(Message(read), HasSubstr("poses.csv:1: "));
  WriteResult(folder.path(), SomeResult());
  ReplaceInFile(folder.path() / "body.toml", "neck_mm", "throat_mm");
  EXPECT_THAT(Message(read), HasSubstr("sizes.neck_mm is missing"));
  WriteResult(folder.path(), SomeResult());
  ReplaceInFile(folder.path() / "poses.csv", "2.250000", "nan");
  EXPECT_THAT(Message(read), HasSubstr("poses.csv:3: theta_16_rad is \"nan\""));
  WriteResult(folder.path(), SomeResult());
  ReplaceInFile(folder.path() / "body.toml", "stature_mm = ", "stature_mm = inf # ");
  EXPECT_THAT(Message(read), HasSubstr("body.toml:2: stature_mm has inf"));
  EXPECT_THAT(Message([&] { ReadResult(folder.path() / "absent"); }), HasSubstr("is missing"));
}

TEST(Result, IsReadHoweverASpreadsheetSavedIt) {
  TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "poses.csv";
  WriteResult(folder.path(), SomeResult());
  const std::string plain = ReadText(file);
  std::string saved = "\xef\xbb\xbf" + plain;
  for (std::size_t end = 0; (end = saved.find('\n', end)) != std::string::npos; end += 2) {
    saved.insert(end, "\r");
  }
  for (const std::string& text : {saved, saved + "\r\n", plain.substr(0, plain.size() - 1)}) {
    testing::WriteText(file, text);
    EXPECT_EQ(ReadResult(folder.path()).poses.size(), 3u);
  }
  EXPECT_THAT(ReadResult(folder.path()).remarks,
              ::testing::ElementsAre(HasSubstr("the last line has no end")));
}

TEST(Result, TimesThatAreNoNanosecondsOrGoBackAreRefused) {
  TemporaryFolder folder;
  Result result = SomeResult();
  const auto error = [&] {
    WriteResult(folder.path(), result);
    return Message([&] { ReadResult(folder.path()); });
  };
  for (int i = 0; i < 3; ++i) result.poses[i].timestamp_ns = 1'763'990'000'000'000 + i * 33'333;
  EXPECT_THAT(error(), HasSubstr("nanoseconds is wanted"));
  result.poses[1].timestamp_ns = 5;
  EXPECT_THAT(error(), HasSubstr("poses.csv:3: timestamp_ns 5 follows 1763990000000000"));
}

TEST(Result, PeopleAreReadInTheOrderOfTheirNumbers) {
  TemporaryFolder folder;
  WritePeople(folder.path(), {{2, SomeResult()}, {10, SomeResult()}});
  EXPECT_TRUE(IsOfPeople(folder.path()));
  const PeopleResults people = ReadPeople(folder.path());
  ASSERT_EQ(people.size(), 2u);
  EXPECT_EQ(people[0].first, "person-2");
  EXPECT_EQ(people[1].first, "person-10");
  EXPECT_EQ(people[1].second.poses.size(), 3u);
  EXPECT_FALSE(IsOfPeople(folder.path() / "person-2")) << "that is one of them";
}

TEST(Result, WhatSomebodyElseWroteIsNotWrittenOver) {
  TemporaryFolder folder;
  RequireRoomForResult(folder.path() / "new");
  WriteResult(folder.path(), SomeResult());
  RequireRoomForResult(folder.path());
  testing::WriteText(folder.path() / "body.toml", "# my body table\nname = \"mine\"\n");
  EXPECT_THAT(Message([&] { RequireRoomForResult(folder.path()); }),
              HasSubstr("body.toml: is there"));
  const std::filesystem::path other = folder.path() / "other";
  WritePeople(other, {{1, SomeResult()}});
  testing::WriteText(other / "person-1" / "poses.csv", "my poses\n");
  EXPECT_THAT(Message([&] { RequireRoomForResult(other); }),
              HasSubstr("person-1/poses.csv: is there"));
}

TEST(Result, ABodysNameMayHoldAnything) {
  TemporaryFolder folder;
  Result result = SomeResult();
  result.body.model = "a \"b\"\n\\c";
  WriteResult(folder.path(), result);
  EXPECT_EQ(ReadResult(folder.path()).body.model, result.body.model);
}

/// Writes a message into a log as lcm-logger does.
template <typename Message>
void Log(lcm::LogFile& log, const std::string& channel, const Message& message) {
  std::vector<char> bytes(message.getEncodedSize());
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  lcm::LogEvent event{0, 1, channel, static_cast<int>(bytes.size()), bytes.data()};
  ASSERT_EQ(log.writeEvent(&event), 0);
}

TEST(Result, IsReadFromALogOfMessages) {
  TemporaryFolder folder;
  const std::string file = folder.path() / "lcm.log";
  const BodyModel body(LoadBodyTable("mikic2003"), AverageSizes(1700));
  CaptureResult tracked;
  tracked.state = CaptureState::kTracking;
  tracked.pose.theta = JointAngles::Zero(body.joint_count());
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
    FillPose({.frame = 4, .capture_ns = 9000, .result = tracked, .body = body, .grid = grid}, 1,
             pose);
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
    return Message([&] { ReadResult(file_, prefix); });
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
  EXPECT_THAT(Error("middle."), ::testing::AllOf(HasSubstr("holds no middle.MOCAP_POSE"),
                                                 HasSubstr("\"left.\", \"right.\"")));
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
  EXPECT_THAT(people[0].second.remarks, ::testing::ElementsAre(HasSubstr("1 pose with a number")));
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
  EXPECT_THAT(people[0].second.remarks, ::testing::ElementsAre(HasSubstr("started again")));
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
  EXPECT_THAT(Message([&] { ReadPeople(file_); }),
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
  EXPECT_THAT(Message([&] { ReadPeople(file_); }), HasSubstr("is no LCM log"));
  testing::WriteText(file_, "");
  EXPECT_THAT(Message([&] { ReadPeople(file_); }), HasSubstr("is empty"));
}

TEST_F(PeopleLog, OfTwoDaemonsIsNeverMixed) {
  for (const char* prefix : {"left.", "right."}) {
    BodyOf(1, prefix);
    People(0, {1}, prefix);
  }
  log_.reset();
  EXPECT_THAT(Message([&] { ReadPeople(file_); }), HasSubstr("\"left.\", \"right.\""));
  EXPECT_EQ(ReadPeople(file_, "left.").size(), 1u);
  EXPECT_THAT(Message([&] { ReadPeople(file_, "up."); }), HasSubstr("nobody on up.MOCAP_PEOPLE"));
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

TEST(Result, ALogWithoutPosesIsASetupError) {
  TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "lcm.log";
  testing::WriteText(file, "no log at all\n");
  EXPECT_THAT(Message([&] { ReadResult(file); }), HasSubstr("is no LCM log"));
  testing::WriteText(file, "");
  EXPECT_THAT(Message([&] { ReadResult(file); }), HasSubstr("is empty"));
  {
    lcm::LogFile log(file, "w");
    Log(log, "MOCAP_POSE", body_t{});
  }
  EXPECT_THAT(Message([&] { ReadResult(file); }),
              HasSubstr("holds no MOCAP_POSE message of this version"));
}

}  // namespace
}  // namespace mocap
