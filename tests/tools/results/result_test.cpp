#include "tools/results/result.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "core/body/body_sizes.h"
#include "tests/support/setup_error.h"
#include "tests/support/temporary_folder.h"
#include "tools/results/result_sink.h"

namespace mocap {
namespace {

using ::testing::HasSubstr;
using testing::ReadText;
using testing::ReplaceInFile;
using testing::SetupErrorOf;
using ::testing::StartsWith;
using testing::TemporaryFolder;

Result SomeResult() {
  Result result;
  result.body = {"full", 1712.5, AverageSizes(1700), {{"wrist_l_x"}, {"knee_r_y", 16}}};
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
    row.joint_rad = Eigen::Vector2d(-0.5, row.paper.theta_rad[15]);
    row.point_std_mm = PointStds::Constant(4.5);
    if (i == 2) row.probability = 0.625;
  }
  return result;
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
  EXPECT_EQ(row.joint_rad, Eigen::Vector2d(-0.5, 2.25));
  EXPECT_EQ(row.point_std_mm, PointStds::Constant(4.5));
  EXPECT_EQ(row.probability, 0.625);
  EXPECT_TRUE(std::isnan(read.poses[1].probability)) << "the tracker could not tell";
  ASSERT_EQ(read.body.joints.size(), 2u);
  EXPECT_EQ(read.body.joints[0].name, "wrist_l_x");
  EXPECT_EQ(read.body.joints[0].paper_angle, 0);
  EXPECT_EQ(read.body.joints[1].name, "knee_r_y");
  EXPECT_EQ(read.body.joints[1].paper_angle, 16);
}

TEST(Result, HasTheContractsColumns) {
  TemporaryFolder folder;
  WriteResult(folder.path(), SomeResult());
  const std::string csv = ReadText(folder.path() / "poses.csv");
  EXPECT_THAT(csv,
              StartsWith("frame,timestamp_ns,state,torso_x_mm,torso_y_mm,torso_z_mm,"
                         "torso_axis_x,torso_axis_y,torso_axis_z,torso_angle_rad,theta_1_rad,"));
  EXPECT_THAT(csv, HasSubstr(",theta_16_rad,torso_x_mm,torso_y_mm,torso_z_mm,head_x_mm,"));
  EXPECT_THAT(csv, HasSubstr(",foot_r_z_mm,residual_mm,voxels,wrist_l_x_rad,clavicle_l_x_mm,"));
  EXPECT_THAT(csv, HasSubstr(",knuckles_r_z_mm,deviation_torso_mm,"));
  EXPECT_THAT(csv, HasSubstr(",deviation_knuckles_r_mm,contact_heel_l,contact_heel_r,"
                             "contact_toe_l,contact_toe_r,probability\n0,"));
  const std::string first_row = csv.substr(csv.find('\n') + 1, csv.find('\n'));
  EXPECT_THAT(first_row, StartsWith("0,1700000000000000000,searching,,,,"));
  const auto commas = [](const std::string& line) { return std::ranges::count(line, ','); };
  EXPECT_EQ(commas(first_row.substr(0, first_row.find('\n'))),
            3 + 7 + 16 + 69 + 2 + 1 + 3 * 14 + 37 + 4 + 1 - 1);
}

/// Leaves only the first columns of each row.
std::string FirstColumns(const std::string& csv, std::size_t count) {
  std::string text;
  std::istringstream lines(csv);
  for (std::string line; std::getline(lines, line);) {
    std::size_t end = 0;
    for (std::size_t i = 0; i < count; ++i) end = line.find(',', end + 1);
    text += line.substr(0, end) + '\n';
  }
  return text;
}

TEST(Result, WithoutFurtherColumnsIsStillRead) {
  TemporaryFolder folder;
  WriteResult(folder.path(), SomeResult());
  const std::filesystem::path file = folder.path() / "poses.csv";
  testing::WriteText(file, FirstColumns(ReadText(file), 97));
  Result result = ReadResult(folder.path());
  ASSERT_EQ(result.poses.size(), 3u);
  ASSERT_EQ(result.body.joints.size(), 1u) << "the other one has no column";
  EXPECT_EQ(result.poses[2].joint_rad[0], 2.25);
  EXPECT_TRUE(result.poses[2].point_std_mm.array().isNaN().all());
  EXPECT_TRUE(std::isnan(result.poses[2].probability));
  // As results were before they had names of joints.
  const std::string body = ReadText(folder.path() / "body.toml");
  testing::WriteText(folder.path() / "body.toml", body.substr(0, body.find("\n[joints]")));
  result = ReadResult(folder.path());
  ASSERT_EQ(result.body.joints.size(), 16u);
  EXPECT_EQ(result.body.joints[8].name, "elbow_l_z");
  EXPECT_EQ(result.poses[2].joint_rad[15], 2.25);
}

TEST(Result, FurtherColumnsAreFoundByTheirNames) {
  TemporaryFolder folder;
  WriteResult(folder.path(), SomeResult());
  const std::filesystem::path file = folder.path() / "poses.csv";
  std::istringstream lines(FirstColumns(ReadText(file), 97));
  std::string text, line;
  std::getline(lines, line);
  text = line + ",probability,deviation_head_mm,wrist_l_x_rad\n";
  while (std::getline(lines, line)) text += line + ",0.75,6.5,\n";
  testing::WriteText(file, text);
  const PoseRow row = ReadResult(folder.path()).poses.at(2);
  EXPECT_EQ(row.probability, 0.75);
  EXPECT_EQ(row.point_std_mm[1], 6.5);
  EXPECT_TRUE(std::isnan(row.point_std_mm[0]));
  EXPECT_TRUE(std::isnan(row.joint_rad[0])) << "its cell is empty";
  EXPECT_EQ(row.joint_rad[1], 2.25);
  ReplaceInFile(file, "probability", "torso_x_mm");
  EXPECT_THAT(SetupErrorOf([&] { ReadResult(folder.path()); }),
              HasSubstr("poses.csv:1: has the column \"torso_x_mm\" a second time"));
}

TEST(Result, AProbabilityBeyondOneIsRefused) {
  TemporaryFolder folder;
  WriteResult(folder.path(), SomeResult());
  ReplaceInFile(folder.path() / "poses.csv", "0.6250", "62.5");
  EXPECT_THAT(SetupErrorOf([&] { ReadResult(folder.path()); }),
              HasSubstr("poses.csv:4: probability is \"62.5\"; expected a number from 0 to 1"));
}

TEST(Result, AColumnThatTheBodyNamesAndTheTableLacksIsTold) {
  TemporaryFolder folder;
  WriteResult(folder.path(), SomeResult());
  ReplaceInFile(folder.path() / "poses.csv", "wrist_l_x_rad", "wrist_l_y_rad");
  EXPECT_THAT(SetupErrorOf([&] { ReadResult(folder.path()); }),
              HasSubstr("poses.csv:1: has no column \"wrist_l_x_rad\"; expected it, as [joints] "
                        "columns of body.toml names it"));
  WriteResult(folder.path(), SomeResult());
  ReplaceInFile(folder.path() / "body.toml", "wrist_l_x_rad", "wrist_rad");
  EXPECT_THAT(SetupErrorOf([&] { ReadResult(folder.path()); }),
              HasSubstr("joints.columns has \"wrist_rad\" for the joint wrist_l_x; expected "
                        "wrist_l_x_rad, or one of theta_1_rad to theta_16_rad"));
}

TEST(Result, NamesOfJointsThatNoTableMayHaveAreRefused) {
  TemporaryFolder folder;
  for (const char* name : {"wrist,l", "theta_3", "knee_r_y"}) {
    WriteResult(folder.path(), SomeResult());
    ReplaceInFile(folder.path() / "body.toml", "wrist_l_x", name);
    EXPECT_THAT(SetupErrorOf([&] { ReadResult(folder.path()); }), HasSubstr("joints.names has"));
  }
  WriteResult(folder.path(), SomeResult());
  ReplaceInFile(folder.path() / "body.toml", ", \"theta_16_rad\"", "");
  EXPECT_THAT(SetupErrorOf([&] { ReadResult(folder.path()); }),
              HasSubstr("joints.columns has 1 text for 2 joints"));
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
  EXPECT_THAT(SetupErrorOf(read), HasSubstr("poses.csv:4: state is \"hovering\""));
  WriteResult(folder.path(), SomeResult());
  ReplaceInFile(folder.path() / "poses.csv", "2.250000", "2.25x");
  EXPECT_THAT(SetupErrorOf(read),
              HasSubstr("poses.csv:3: theta_16_rad is \"2.25x\"; expected a number"));
  WriteResult(folder.path(), SomeResult());
  ReplaceInFile(folder.path() / "poses.csv", ",acquiring", "");
  EXPECT_THAT(SetupErrorOf(read), HasSubstr("poses.csv:3: has 181 fields; expected 182"));
  WriteResult(folder.path(), SomeResult());
  ReplaceInFile(folder.path() / "poses.csv", "timestamp_ns", "time");
  EXPECT_THAT(SetupErrorOf(read), HasSubstr("poses.csv:1: "));
  WriteResult(folder.path(), SomeResult());
  ReplaceInFile(folder.path() / "body.toml", "neck_mm", "throat_mm");
  EXPECT_THAT(SetupErrorOf(read), HasSubstr("sizes.neck_mm is missing"));
  WriteResult(folder.path(), SomeResult());
  ReplaceInFile(folder.path() / "poses.csv", "2.250000", "nan");
  EXPECT_THAT(SetupErrorOf(read), HasSubstr("poses.csv:3: theta_16_rad is \"nan\""));
  WriteResult(folder.path(), SomeResult());
  ReplaceInFile(folder.path() / "body.toml", "stature_mm = ", "stature_mm = inf # ");
  EXPECT_THAT(SetupErrorOf(read), HasSubstr("body.toml:2: stature_mm has inf"));
  EXPECT_THAT(SetupErrorOf([&] { ReadResult(folder.path() / "absent"); }), HasSubstr("not found"));
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
    return SetupErrorOf([&] { ReadResult(folder.path()); });
  };
  for (int i = 0; i < 3; ++i) result.poses[i].timestamp_ns = 1'763'990'000'000'000 + i * 33'333;
  EXPECT_THAT(error(), HasSubstr("expected timestamp_ns in nanoseconds"));
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

TEST(Result, ForAFileOfAResultItsFolderIsExpected) {
  const testing::TemporaryFolder folder;
  for (const char* name : {"poses.csv", "body.toml"}) {
    const std::filesystem::path file = folder.path() / name;
    testing::WriteText(file, "x");
    const std::string told =
        file.string() + ": is a file of a result; expected its folder, " + folder.path().string();
    EXPECT_EQ(testing::SetupErrorOf([&] { ReadResult(file); }), told);
    EXPECT_EQ(testing::SetupErrorOf([&] { ReadPeople(file); }), told);
  }
}

TEST(Result, AFolderWithoutPosesIsNamed) {
  const testing::TemporaryFolder folder;
  EXPECT_EQ(testing::SetupErrorOf([&] { ReadResult(folder.path()); }),
            folder.path().string() + ": contains no poses.csv; expected what mocap track writes");
}

TEST(Result, WhatSomebodyElseWroteIsNotWrittenOver) {
  TemporaryFolder folder;
  RequireRoomForResult(folder.path() / "new");
  WriteResult(folder.path(), SomeResult());
  RequireRoomForResult(folder.path());
  testing::WriteText(folder.path() / "body.toml", "# my body table\nname = \"mine\"\n");
  EXPECT_THAT(SetupErrorOf([&] { RequireRoomForResult(folder.path()); }),
              HasSubstr("body.toml: exists"));
  const std::filesystem::path other = folder.path() / "other";
  WritePeople(other, {{1, SomeResult()}});
  testing::WriteText(other / "person-1" / "poses.csv", "my poses\n");
  EXPECT_THAT(SetupErrorOf([&] { RequireRoomForResult(other); }),
              HasSubstr("person-1/poses.csv: exists"));
}

TEST(Result, ATakeIsNotWrittenInto) {
  TemporaryFolder folder;
  testing::WriteText(folder.path() / "take.toml", "format = 1\n");
  EXPECT_THAT(SetupErrorOf([&] { RequireRoomForResult(folder.path()); }),
              HasSubstr("is a take; expected another folder for the result"));
}

TEST(Result, HasPosesIfAnybodyWasTracked) {
  TemporaryFolder folder;
  EXPECT_FALSE(HasPoses(folder.path() / "none"));
  struct Result nobody = SomeResult();
  for (PoseRow& row : nobody.poses) {
    row.state = CaptureState::kSearching;
    row.has_pose = false;
  }
  WriteResult(folder.path(), nobody);
  EXPECT_FALSE(HasPoses(folder.path()));
  WritePeople(folder.path(), {{1, nobody}, {2, SomeResult()}});
  EXPECT_TRUE(HasPoses(folder.path()));
}

TEST(Result, ABodysNameMayHoldAnything) {
  TemporaryFolder folder;
  Result result = SomeResult();
  result.body.model = "a \"b\"\n\\c";
  WriteResult(folder.path(), result);
  EXPECT_EQ(ReadResult(folder.path()).body.model, result.body.model);
}

TEST(ResultSink, ClearsItsLineOnTheTerminalAlsoAfterAFailure) {
  ::testing::internal::CaptureStderr();
  { const ResultSink sink(KeptPeople::kFirst, true); }
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "\r\x1b[K");
}

}  // namespace
}  // namespace mocap
