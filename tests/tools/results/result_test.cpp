#include "tools/results/result.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <lcm/lcm-cpp.hpp>
#include <mocap/body_t.hpp>
#include <mocap/pose_t.hpp>
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

TEST(Result, DamageIsNamedWithFileAndLine) {
  TemporaryFolder folder;
  const auto read = [&] { ReadResult(folder.path()); };
  WriteResult(folder.path(), SomeResult());
  ReplaceInFile(folder.path() / "poses.csv", "tracking", "hovering");
  EXPECT_THAT(Message(read), HasSubstr("poses.csv:4: state is \"hovering\""));
  WriteResult(folder.path(), SomeResult());
  ReplaceInFile(folder.path() / "poses.csv", "2.250000", "2.25x");
  EXPECT_THAT(Message(read), HasSubstr("poses.csv:3: theta_16_rad is \"2.25x\", wanted a number"));
  WriteResult(folder.path(), SomeResult());
  ReplaceInFile(folder.path() / "poses.csv", ",acquiring", "");
  EXPECT_THAT(Message(read), HasSubstr("poses.csv:3: has 96 columns, wanted 97"));
  WriteResult(folder.path(), SomeResult());
  ReplaceInFile(folder.path() / "poses.csv", "timestamp_ns", "time");
  EXPECT_THAT(Message(read), HasSubstr("poses.csv:1: "));
  WriteResult(folder.path(), SomeResult());
  ReplaceInFile(folder.path() / "body.toml", "neck_mm", "throat_mm");
  EXPECT_THAT(Message(read), HasSubstr("body.toml: sizes.neck_mm: missing"));
  WriteResult(folder.path(), SomeResult());
  ReplaceInFile(folder.path() / "poses.csv", "2.250000", "nan");
  EXPECT_THAT(Message(read), HasSubstr("has a number that is not finite"));
  WriteResult(folder.path(), SomeResult());
  ReplaceInFile(folder.path() / "body.toml", "stature_mm = ", "stature_mm = inf # ");
  EXPECT_THAT(Message(read), HasSubstr("the body has a size that is no finite number"));
  EXPECT_THAT(Message([&] { ReadResult(folder.path() / "absent"); }), HasSubstr("is missing"));
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

TEST(Result, ALogWithoutPosesIsASetupError) {
  TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "lcm.log";
  testing::WriteText(file, "no log at all\n");
  EXPECT_THAT(Message([&] { ReadResult(file); }), HasSubstr("holds no MOCAP_POSE"));
  {
    lcm::LogFile log(file, "w");
    Log(log, "MOCAP_POSE", body_t{});
  }
  EXPECT_THAT(Message([&] { ReadResult(file); }), HasSubstr("MOCAP_POSE is not a message"));
}

}  // namespace
}  // namespace mocap
