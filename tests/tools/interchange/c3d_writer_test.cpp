#include "tools/interchange/c3d_writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "core/errors.h"
#include "tests/support/c3d_reader.h"
#include "tests/support/moving_body.h"
#include "tests/support/temporary_folder.h"
#include "tools/interchange/people_times.h"

namespace mocap {
namespace {

using testing::C3dPoint;
using ::testing::ElementsAre;
using testing::GrownBody;
using testing::ReadC3d;
using testing::ResultOf;
using testing::RightArmRaised;
using testing::SwingingResult;

ReadC3d WriteAndReadC3d(const ExportScene& scene) {
  std::ostringstream file;
  WriteC3d(scene, file);
  return testing::ReadC3dFile(file.str());
}

ReadC3d WriteAndReadC3d(const Result& result) {
  const ExportSubject subject{"", result};
  return WriteAndReadC3d({std::span(&subject, 1), result.poses, "walk.c3d"});
}

void ExpectPoints(const ReadC3d& c3d, std::size_t frame, const PoseRow& row,
                  const std::string& prefix = "") {
  for (int i = 0; i < kPointCount; ++i) {
    const C3dPoint& point = c3d.Point(frame, prefix + std::string(kPointNames[i]));
    EXPECT_LT((Vector3(point.x, point.y, point.z) - row.points_W.col(i)).norm(), 0.01);
    EXPECT_NEAR(point.residual, row.residual_mm, 0.13);
  }
  const std::map<std::string, Point> markers = {{"LHEE", Point::kHeelL},  {"RHEE", Point::kHeelR},
                                                {"LTOE", Point::kToeL},   {"RTOE", Point::kToeR},
                                                {"LANK", Point::kAnkleL}, {"RANK", Point::kAnkleR},
                                                {"LWRA", Point::kWristL}, {"RWRA", Point::kWristR}};
  for (const auto& [name, at] : markers) {
    const C3dPoint& point = c3d.Point(frame, prefix + name);
    const Vector3 p_W = FurtherOf(row.further_W, at);
    EXPECT_LT((Vector3(point.x, point.y, point.z) - p_W).norm(), 0.01) << name;
  }
}

TEST(C3dReaderOfTests, ReadsAFileOfViconAsOpenSimDoes) {
  const std::filesystem::path folder = std::filesystem::path(MOCAP_SHARED_DIR) / "data/mocap_io";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "needs OpenSim's files in " << folder;
  const ReadC3d c3d = testing::ReadC3dFile(testing::ReadText(folder / "walking2.c3d"));
  std::ifstream trc(folder / "std_walking2_markers.trc");
  std::string line, cell;
  std::vector<std::string> names;
  for (int i = 0; i < 6; ++i) {
    std::getline(trc, line);
    std::istringstream cells(line);
    for (int k = 0; i == 3 && std::getline(cells, cell, '\t'); ++k) {
      if (k >= 2 && !cell.empty() && cell != "\r") names.push_back(cell);
    }
  }
  ASSERT_EQ(names.size(), 44u);
  int compared = 0;
  while (std::getline(trc, line) && line.size() > 1) {
    std::istringstream cells(line);
    std::getline(cells, cell, '\t');
    std::getline(cells, cell, '\t');
    const auto frame = static_cast<std::size_t>(std::lround(std::stod(cell) * 250));
    for (const std::string& name : names) {
      std::array<double, 3> at{};
      for (double& value : at) {
        std::getline(cells, cell, '\t');
        value = std::atof(cell.c_str());
      }
      const C3dPoint& point = c3d.Point(frame, name);
      EXPECT_EQ(point.residual < 0, std::isnan(at[0])) << name << " in frame " << frame;
      if (std::isnan(at[0])) continue;
      const Vector3 apart(point.x - at[0], point.y - at[1], point.z - at[2]);
      EXPECT_LT(apart.cwiseAbs().maxCoeff(), 0.051) << name << " in frame " << frame;
      ++compared;
    }
  }
  EXPECT_GT(compared, 1000);
}

TEST(C3dWriter, KeepsEveryPointInPlaceAndSaysWhichAxisIsUp) {
  const Result result = SwingingResult(30);
  const ReadC3d c3d = WriteAndReadC3d(result);
  ASSERT_EQ(c3d.frames.size(), 30u);
  for (std::size_t i = 0; i < 30; ++i) ExpectPoints(c3d, i, result.poses[i]);
  EXPECT_EQ(c3d.At("POINT:UNITS").texts[0], "mm");
  EXPECT_EQ(c3d.At("POINT:X_SCREEN").texts[0], "+X");
  EXPECT_EQ(c3d.At("POINT:Y_SCREEN").texts[0], "+Z");
  EXPECT_FLOAT_EQ(c3d.Number("POINT:RATE"), 25);
  EXPECT_EQ(c3d.header_last, 30);
  EXPECT_EQ(c3d.Number("POINT:USED"), c3d.header_points);
  EXPECT_EQ(static_cast<int>(c3d.labels.size()), c3d.header_points);
}

TEST(C3dWriter, HeaderAndParametersAgreeAsReadersDemand) {
  const ReadC3d c3d = WriteAndReadC3d(SwingingResult(30));
  EXPECT_EQ(c3d.header_points, c3d.Number("POINT:USED"));
  EXPECT_EQ(c3d.header_scale, c3d.Number("POINT:SCALE"));
  EXPECT_EQ(c3d.header_rate_hz, c3d.Number("POINT:RATE"));
  EXPECT_EQ(c3d.header_data_block, c3d.Number("POINT:DATA_START"));
  EXPECT_EQ(c3d.header_last - c3d.header_first + 1, c3d.Number("POINT:FRAMES"));
  EXPECT_EQ(c3d.header_analog_samples, c3d.Number("ANALOG:RATE") / c3d.Number("POINT:RATE"));
  EXPECT_EQ(c3d.header_analog_values, c3d.Number("ANALOG:USED") * c3d.header_analog_samples);
}

TEST(C3dWriter, HasTheRaisedArmOnTheRight) {
  const BodyModel body = GrownBody();
  const ReadC3d c3d = WriteAndReadC3d(ResultOf(body, RightArmRaised(body)));
  // Who faces world x has his right at smaller y.
  EXPECT_GT(c3d.Point(0, "fingertips_r").z, c3d.Point(0, "head").z + 200);
  EXPECT_LT(c3d.Point(0, "fingertips_r").y, c3d.Point(0, "torso").y);
  EXPECT_NEAR(c3d.Point(0, "LKneeAngles").x, 60, 0.01);
  EXPECT_NEAR(c3d.Point(0, "RKneeAngles").x, 0, 0.01);
}

TEST(C3dWriter, AnglesArePointsOfATypeOfTheirOwn) {
  const ReadC3d c3d = WriteAndReadC3d(SwingingResult(2));
  EXPECT_THAT(
      c3d.At("POINT:ANGLES").texts,
      ElementsAre("LHipAngles", "RHipAngles", "LKneeAngles", "RKneeAngles", "LShoulderAngles",
                  "RShoulderAngles", "LElbowAngles", "RElbowAngles", "SpineAngles", "LAnkleAngles",
                  "RAnkleAngles", "LWristAngles", "RWristAngles", "LPelvisAngles", "RPelvisAngles",
                  "LThoraxAngles", "RThoraxAngles", "LHeadAngles", "RHeadAngles"));
  EXPECT_THAT(c3d.At("POINT:TYPE_GROUPS").texts, ElementsAre("ANGLES", "ANGLE_UNITS"));
  EXPECT_THAT(c3d.At("POINT:TYPE_GROUPS").dims, ElementsAre(11, 2, 1));
  EXPECT_EQ(c3d.At("POINT:ANGLE_UNITS").texts[0], "deg");
}

TEST(C3dWriter, FramesWithoutTrackingAreNotSeenAndEventsTellOfThem) {
  Result result = SwingingResult(10);
  for (const int i : {0, 1, 6}) result.poses[i].state = CaptureState::kLost;
  result.poses.erase(result.poses.begin() + 3);
  const ReadC3d c3d = WriteAndReadC3d(result);
  ASSERT_EQ(c3d.frames.size(), 10u) << "the missing frame is filled in";
  for (int i = 0; i < 10; ++i) {
    const bool is_seen = i != 0 && i != 1 && i != 3 && i != 6;
    for (const C3dPoint& point : c3d.frames[i]) EXPECT_EQ(point.residual >= 0, is_seen) << i;
  }
  ExpectPoints(c3d, 9, result.poses[8]);
  EXPECT_EQ(c3d.Number("EVENT:USED"), 4);
  EXPECT_THAT(c3d.At("EVENT:LABELS").texts,
              ElementsAre("Tracking starts", "Tracking ends", "Tracking starts", "Tracking ends"));
  const std::vector<double> seconds = {2 * 0.04, 5 * 0.04, 7 * 0.04, 9 * 0.04};
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(c3d.Number("EVENT:TIMES", 2 * i), 0);
    EXPECT_NEAR(c3d.Number("EVENT:TIMES", 2 * i + 1), seconds[i], 1e-5);
  }
}

using JointTurns = std::vector<std::pair<const char*, double>>;

/// Angles of somebody who stands with hanging arms and has turned some joints [degrees].
Vector3 C3dAnglesOfTurns(const std::string& label, const JointTurns& turns,
                         const Matrix3& R_WTorso) {
  const BodyModel body = GrownBody();
  PoseState pose = testing::Standing(body);
  pose.X_WT.R = R_WTorso;
  testing::Turn(body, "shoulder_l_x", -90, pose);
  testing::Turn(body, "shoulder_r_x", 90, pose);
  for (const auto& [joint, degrees] : turns) testing::Turn(body, joint, degrees, pose);
  const C3dPoint point = WriteAndReadC3d(ResultOf(body, pose)).Point(0, label);
  EXPECT_GE(point.residual, 0) << label;
  return {point.x, point.y, point.z};
}

/// With every heading.
void ExpectC3dAngles(const std::string& label, const JointTurns& turns, const Vector3& wanted,
                     const Vector3& torso_deg = Vector3::Zero()) {
  for (const double heading_rad : {0.0, 1.0, -2.5}) {
    const Matrix3 R_WTorso =
        ExpRotation({0, 0, heading_rad}) * ExpRotation(torso_deg * (EIGEN_PI / 180));
    const Vector3 angles = C3dAnglesOfTurns(label, turns, R_WTorso);
    EXPECT_LT((angles - wanted).norm(), 0.01)
        << label << " of " << (turns.empty() ? "leaning" : turns[0].first) << ": "
        << angles.transpose();
  }
}

TEST(C3dWriter, AnglesHaveTheSignsOfPlugInGait) {
  ExpectC3dAngles("LWristAngles", {{"wrist_l_x", 20}}, {-20, 0, 0});
  ExpectC3dAngles("RWristAngles", {{"wrist_r_x", 20}}, {20, 0, 0});
  ExpectC3dAngles("LWristAngles", {{"wrist_l_z", -20}}, {0, -20, 0});
  ExpectC3dAngles("RWristAngles", {{"wrist_r_z", 20}}, {0, -20, 0});
  ExpectC3dAngles("LPelvisAngles", {{"waist_x", 10}}, {0, 10, 0});
  ExpectC3dAngles("RPelvisAngles", {{"waist_x", 10}}, {0, -10, 0});
  ExpectC3dAngles("LPelvisAngles", {{"waist_y", -10}}, {-10, 0, 0});
  ExpectC3dAngles("LHeadAngles", {{"neck_y", 20}}, {-20, 0, 0});
  ExpectC3dAngles("LHeadAngles", {{"neck_x", 20}}, {0, 20, 0});
  ExpectC3dAngles("RHeadAngles", {{"neck_x", 20}}, {0, -20, 0});
  ExpectC3dAngles("LHeadAngles", {{"neck_z", 20}}, {0, 0, -20});
  ExpectC3dAngles("RHeadAngles", {{"neck_z", 20}}, {0, 0, 20});
}

TEST(C3dWriter, ArmsLiftedToTheSideAreAbducted) {
  ExpectC3dAngles("LShoulderAngles", {{"shoulder_l_x", -30}}, {0, 60, 0});
  ExpectC3dAngles("RShoulderAngles", {{"shoulder_r_x", 30}}, {0, 60, 0});
  // A leg that is lifted to the side is negative.
  ExpectC3dAngles("LHipAngles", {{"hip_l_x", 30}}, {0, -30, 0});
  ExpectC3dAngles("RHipAngles", {{"hip_r_x", -30}}, {0, -30, 0});
}

TEST(C3dWriter, ThoraxAnglesAreForwardAndTowardsTheOtherSide) {
  for (const auto& [label, side] :
       {std::pair("LThoraxAngles", 1.0), std::pair("RThoraxAngles", -1.0)}) {
    ExpectC3dAngles(label, {}, {10, 0, 0}, {0, 10, 0});         // Leans forward.
    ExpectC3dAngles(label, {}, {0, side * 10, 0}, {10, 0, 0});  // To the right.
    // The pelvis, which tells where a standing person faces, turns left of it.
    ExpectC3dAngles(label, {{"waist_z", 20}}, {0, 0, side * 20});
  }
}

TEST(C3dWriter, AnkleAndWristTurnInTheOrderOfPlugInGait) {
  // From the product of both turns: toes up, toes inward, sole inward. The axes are oblique.
  ExpectC3dAngles("LAnkleAngles", {{"ankle_l_y", 20}}, {-19.5423, 1.4723, 3.7678});
  ExpectC3dAngles("RAnkleAngles", {{"ankle_r_y", -15}}, {14.7297, -1.8917, -2.3803});
  ExpectC3dAngles("LAnkleAngles", {{"ankle_l_y", -20}, {"subtalar_l_x", 15}},
                  {18.3667, 9.1450, 6.0912});
  ExpectC3dAngles("RAnkleAngles", {{"ankle_r_y", 15}, {"subtalar_r_x", 25}},
                  {-14.7127, 21.0101, 18.1301});
  ExpectC3dAngles("LWristAngles", {{"wrist_l_x", 20}, {"wrist_l_z", -30}}, {-20, -30, 0});
  ExpectC3dAngles("RWristAngles", {{"wrist_r_x", 20}, {"wrist_r_z", 30}}, {20, -30, 0});
}

TEST(C3dWriter, WhoWalksTurnsThePelvisAgainstTheDirectionOfWalking) {
  for (const double heading_rad : {0.0, 2.0}) {
    Result result = testing::WalkingResult(60, heading_rad);
    const BodyModel body = GrownBody();
    const auto turn = Eigen::AngleAxisd(0.2, Vector3::UnitZ()).toRotationMatrix();
    PoseState pose = testing::Standing(body);
    pose.X_WT.R = turn * ExpRotation({0, 0, heading_rad});
    pose.X_WT.p = (result.poses[30].paper.torso_mm + result.poses[31].paper.torso_mm) / 2;
    PoseRow row = testing::TrackedRow(body, pose);
    row.frame = 30;
    row.timestamp_ns = result.poses[30].timestamp_ns;
    result.poses[30] = row;
    const ReadC3d c3d = WriteAndReadC3d(result);
    // Turned left: the right side is forward.
    EXPECT_NEAR(c3d.Point(30, "LPelvisAngles").z, -0.2 * 180 / EIGEN_PI, 0.1);
    EXPECT_NEAR(c3d.Point(30, "RPelvisAngles").z, 0.2 * 180 / EIGEN_PI, 0.1);
    EXPECT_NEAR(c3d.Point(20, "LPelvisAngles").z, 0, 0.1);
  }
}

TEST(C3dWriter, WhatAnOldResultDoesNotHaveIsNotSeen) {
  Result result = SwingingResult(2);
  testing::MakeOld(result);
  const ReadC3d c3d = WriteAndReadC3d(result);
  for (const char* label : {"LHEE", "RTOE", "LANK", "RWRA", "LAnkleAngles", "RWristAngles"})
    EXPECT_LT(c3d.Point(1, label).residual, 0) << label;
  for (const char* label : {"foot_l", "LKneeAngles", "LPelvisAngles", "RHeadAngles"})
    EXPECT_GE(c3d.Point(1, label).residual, 0) << label;
}

TEST(C3dWriter, FeetStrikeAndLeaveTheFloorOnTheirSide) {
  Result result = testing::WalkingResult(150);
  // Seconds count from the file's first frame, though a frame is missing.
  result.poses.erase(result.poses.begin() + 70);
  const ReadC3d c3d = WriteAndReadC3d(result);
  EXPECT_THAT(c3d.At("EVENT_CONTEXT:LABELS").texts, ElementsAre("General", "Left", "Right"));
  std::map<std::string, int> counts;
  double last_s = 0;
  for (int i = 0; i < c3d.Number("EVENT:USED"); ++i) {
    const std::string label = c3d.At("EVENT:LABELS").texts.at(i);
    const std::string context = c3d.At("EVENT:CONTEXTS").texts.at(i);
    const double time_s =
        60 * c3d.Number("EVENT:TIMES", 2 * i) + c3d.Number("EVENT:TIMES", 2 * i + 1);
    EXPECT_GE(time_s, last_s) << "in order of time";
    last_s = time_s;
    ++counts[context + ' ' + label];
    if (context == "General") continue;
    const bool is_strike = label == "Foot Strike";
    EXPECT_EQ(c3d.Number("EVENT:ICON_IDS", i), is_strike ? 1 : 2);
    const double cycles =
        time_s / testing::kWalkCycle_s - (context == "Left" ? 0.25 : 0.75) - (is_strike ? 0 : 0.5);
    EXPECT_NEAR(cycles, std::round(cycles), 0.02) << context << ' ' << label << ' ' << time_s;
  }
  for (const char* event :
       {"Left Foot Strike", "Left Foot Off", "Right Foot Strike", "Right Foot Off"}) {
    EXPECT_GE(counts[event], 4) << event;
    EXPECT_LE(counts[event], 6) << event;
  }
  EXPECT_EQ(counts["General Tracking starts"], 1);
}

TEST(C3dWriter, MoreEventsThanItHoldsAreTold) {
  const Result result = testing::WalkingResult(2000);
  const ExportSubject subject{"", result};
  std::ostringstream file;
  const ExportRemarks remarks = WriteC3d({std::span(&subject, 1), result.poses, "walk.c3d"}, file);
  EXPECT_THAT(remarks, ElementsAre(::testing::HasSubstr("of which C3D can hold the first 255")));
  const ReadC3d c3d = testing::ReadC3dFile(file.str());
  EXPECT_EQ(c3d.Number("EVENT:USED"), 255);
  EXPECT_EQ(c3d.At("EVENT:LABELS").texts.size(), 255u);
}

TEST(C3dWriter, SeveralPeopleStandBesideEachOtherWithTheirNames) {
  const Result first = SwingingResult(4);
  Result second = SwingingResult(4);
  second.poses.erase(second.poses.begin(), second.poses.begin() + 2);
  const ExportSubject subjects[] = {{"anna", first}, {"person-2", second}};
  const auto moments = MomentsOf({{"anna", first}, {"person-2", second}});
  const ReadC3d c3d = WriteAndReadC3d({subjects, moments, "both.c3d", true});
  ASSERT_EQ(c3d.frames.size(), 4u);
  ExpectPoints(c3d, 1, first.poses[1], "anna:");
  ExpectPoints(c3d, 3, second.poses[1], "person-2:");
  EXPECT_LT(c3d.Point(1, "person-2:head").residual, 0) << "he was not there yet";
  EXPECT_THAT(c3d.At("SUBJECTS:NAMES").texts, ElementsAre("anna", "person-2"));
  EXPECT_THAT(c3d.At("SUBJECTS:LABEL_PREFIXES").texts, ElementsAre("anna:", "person-2:"));
  EXPECT_EQ(c3d.Number("SUBJECTS:USES_PREFIXES"), 1);
  EXPECT_THAT(c3d.At("EVENT:SUBJECTS").texts, ElementsAre("anna", "person-2", "anna", "person-2"));
}

TEST(C3dWriter, EightPeopleHaveMoreLabelsThanOneArrayHolds) {
  const Result result = SwingingResult(1);
  std::vector<ExportSubject> subjects;
  for (int i = 1; i <= 8; ++i) subjects.push_back({"person-" + std::to_string(i), result});
  const ReadC3d c3d = WriteAndReadC3d({subjects, result.poses, "all.c3d", true});
  ASSERT_EQ(c3d.labels.size(), 8u * 50);
  EXPECT_EQ(c3d.At("POINT:LABELS").texts.size(), 255u);
  EXPECT_EQ(c3d.labels.back(), "person-8:RHeadAngles");
}

TEST(C3dWriter, MorePeopleThanItCanNameAreTold) {
  const Result result = SwingingResult(1);
  std::vector<ExportSubject> subjects;
  for (int i = 1; i <= 300; ++i) subjects.push_back({"person-" + std::to_string(i), result});
  EXPECT_THROW(WriteAndReadC3d({subjects, result.poses, "all.c3d", true}), SetupError);
}

TEST(C3dWriter, CountsMoreFramesThanSixteenBitsHold) {
  Result result = SwingingResult(1);
  for (int i = 1; i < 70'000; ++i) {
    PoseRow& row = result.poses.emplace_back();
    row.frame = i;
    row.timestamp_ns = result.poses[0].timestamp_ns + 10'000'000LL * i;
  }
  const ReadC3d c3d = WriteAndReadC3d(result);
  EXPECT_EQ(c3d.frames.size(), 70'000u);
  EXPECT_EQ(c3d.header_last, 65'535);
  EXPECT_EQ(c3d.Number("POINT:FRAMES"), 65'535);
  EXPECT_EQ(c3d.Number("POINT:LONG_FRAMES"), 70'000);
}

TEST(C3dWriter, TellsTheCamerasOfALog) {
  Result result = SwingingResult(1);
  result.poses[0].first_cameras = 0b0101101;
  EXPECT_EQ(WriteAndReadC3d(result).Point(0, "head").cameras, 0b0101101);
}

TEST(C3dWriter, RefusesAPauseThatWouldFillTheDisk) {
  Result result = SwingingResult(9);
  result.poses[8].timestamp_ns = std::int64_t{1} << 60;
  EXPECT_THROW(WriteAndReadC3d(result), SetupError);
}

}  // namespace
}  // namespace mocap
