#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/moving_body.h"
#include "tools/interchange/csv_writer.h"
#include "tools/interchange/mot_writer.h"
#include "tools/interchange/people_times.h"
#include "tools/interchange/trc_writer.h"
#include "tools/results/result_columns.h"

namespace mocap {
namespace {

using ::testing::ElementsAre;

/// Two frames 50 ms apart; the second is lost and has no pose.
Result TwoFrames() {
  Result result;
  result.poses.resize(2);
  PoseRow& row = result.poses[0];
  row.frame = 7;
  row.timestamp_ns = 1'700'000'000'000'000'000;
  row.state = CaptureState::kTracking;
  row.has_pose = true;
  row.paper.theta_rad[15] = 0.25;
  row.paper.torso_mm = {0, 0, 1100};
  row.points_W.col(static_cast<int>(Point::kTorso)) = Vector3(0, 0, 1105);
  row.points_W.col(static_cast<int>(Point::kFingertipsR)) = Vector3(100, -300, 2150);
  result.body.joints = {{"wrist_l_x"}, {"knee_r_y", 16}};
  row.joint_rad = Eigen::Vector2d(-0.5, 0.25);
  row.point_std_mm.setConstant(4.5);
  row.probability = 0.625;
  row.residual_mm = 12.5;
  row.voxels = 4321;
  result.poses[1].frame = 8;
  result.poses[1].timestamp_ns = row.timestamp_ns + 50'000'000;
  result.poses[1].state = CaptureState::kLost;
  return result;
}

/// What a writer makes of somebody who is alone.
std::string Written(ExportRemarks (*write)(const ExportScene&, std::ostream&), const Result& result,
                    const std::string& file_name = "walk") {
  const ExportSubject subject{"", result};
  std::ostringstream text;
  write({std::span(&subject, 1), result.poses, file_name}, text);
  return text.str();
}

std::vector<std::vector<std::string>> Cells(const std::string& text, char separator) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::vector<std::string>& row = rows.emplace_back();
    std::istringstream cells(line + separator);
    for (std::string cell; std::getline(cells, cell, separator);) row.push_back(cell);
  }
  return rows;
}

TEST(TrcWriter, WritesTheHeaderThatOpenSimReads) {
  const std::string text = Written(WriteTrc, TwoFrames(), "walk.trc");
  const auto rows = Cells(text, '\t');
  ASSERT_EQ(rows.size(), 8u);
  EXPECT_THAT(rows[0], ElementsAre("PathFileType", "4", "(X/Y/Z)", "walk.trc"));
  EXPECT_THAT(rows[1], ElementsAre("DataRate", "CameraRate", "NumFrames", "NumMarkers", "Units",
                                   "OrigDataRate", "OrigDataStartFrame", "OrigNumFrames"));
  EXPECT_THAT(rows[2],
              ElementsAre("20.000000", "20.000000", "2", "31", "mm", "20.000000", "1", "2"));
  EXPECT_EQ(rows[3][0], "Frame#");
  EXPECT_EQ(rows[3][2 + 3 * 18], "fingertips_r");
  EXPECT_EQ(rows[3][2 + 3 * static_cast<int>(Point::kHipL)], "LHJC");
  EXPECT_EQ(rows[3][2 + 3 * static_cast<int>(Point::kElbowR)], "REJC");
  EXPECT_EQ(rows[4][2 + 3 * 18], "X19");
  EXPECT_EQ(rows[3][2 + 3 * 23], "LHeel");
  EXPECT_EQ(rows[3][2 + 3 * 26], "RToe");
  EXPECT_EQ(rows[4].back(), "Z31");
}

TEST(TrcWriter, TurnsTheWorldYUpWithoutMirroringIt) {
  const std::string text = Written(WriteTrc, TwoFrames(), "walk.trc");
  const auto rows = Cells(text, '\t');
  const std::vector<std::string>& row = rows[6];
  ASSERT_EQ(row.size(), 2u + 3 * 31);
  EXPECT_EQ(row[0], "1");
  // World (100, -300, 2150): 100 before the origin, 300 to the right, 2150 up.
  EXPECT_EQ(row[2 + 3 * 18], "-300.000");
  EXPECT_EQ(row[3 + 3 * 18], "2150.000");
  EXPECT_EQ(row[4 + 3 * 18], "100.000");
}

TEST(TrcWriter, HasHeelsToesAnklesAndWrists) {
  const BodyModel body = testing::GrownBody();
  const Result result = testing::ResultOf(body, testing::RightArmRaised(body));
  const auto rows = Cells(Written(WriteTrc, result), '\t');
  const std::map<std::string, Point> markers = {{"LHeel", Point::kHeelL}, {"RHeel", Point::kHeelR},
                                                {"LToe", Point::kToeL},   {"RToe", Point::kToeR},
                                                {"LAJC", Point::kAnkleL}, {"RAJC", Point::kAnkleR},
                                                {"LWJC", Point::kWristL}, {"RWJC", Point::kWristR}};
  for (const auto& [name, point] : markers) {
    const auto column = std::ranges::find(rows[3], name) - rows[3].begin();
    const Vector3 p_W = FurtherOf(result.poses[0].further_W, point);
    EXPECT_NEAR(std::stod(rows[6].at(column)), p_W.y(), 0.001) << name;
    EXPECT_NEAR(std::stod(rows[6].at(column + 1)), p_W.z(), 0.001) << name;
    EXPECT_NEAR(std::stod(rows[6].at(column + 2)), p_W.x(), 0.001) << name;
  }
}

/// As OpenSim's reader: what follows the last tab counts if it is not empty.
std::vector<std::string> OpenSimFields(const std::string& line) {
  std::vector<std::string> fields = Cells(line, '\t').at(0);
  if (fields.back().empty()) fields.pop_back();
  return fields;
}

TEST(TrcWriter, OpenSimFindsAllColumnsInEveryRow) {
  const std::string text = Written(WriteTrc, TwoFrames(), "walk.trc");
  std::istringstream lines(text);
  std::string line;
  for (int i = 0; i < 6; ++i) std::getline(lines, line);
  int rows = 0;
  for (; std::getline(lines, line); ++rows) EXPECT_EQ(OpenSimFields(line).size(), 2u + 3 * 31);
  EXPECT_EQ(rows, 2);
}

TEST(TrcWriter, SeveralPeopleStandBesideEachOtherWithTheirNames) {
  const Result first = TwoFrames();
  Result second = TwoFrames();
  second.poses.erase(second.poses.begin());
  second.poses[0].state = CaptureState::kTracking;
  second.poses[0].has_pose = true;
  second.poses[0].points_W.setConstant(5);
  second.poses[0].further_W.setConstant(5);
  const ExportSubject subjects[] = {{"anna", first}, {"person-2", second}};
  std::ostringstream written;
  WriteTrc({subjects, MomentsOf({{"anna", first}, {"person-2", second}}), "both.trc", true},
           written);
  const std::string text = written.str();
  const auto rows = Cells(text, '\t');
  ASSERT_EQ(rows.size(), 8u);
  EXPECT_EQ(rows[2][3], "62");
  EXPECT_EQ(rows[3][2], "anna:torso");
  EXPECT_EQ(rows[3][2 + 3 * 31], "person-2:torso");
  EXPECT_EQ(rows[4].back(), "Z62");
  ASSERT_EQ(rows[6].size(), 2u + 3 * 62);
  EXPECT_EQ(rows[6][2 + 3 * 18], "-300.000");
  EXPECT_EQ(rows[6].back(), "nan") << "the second was not there yet";
  EXPECT_EQ(rows[7][2], "nan") << "the first was lost";
  EXPECT_EQ(rows[7].back(), "5.000");
}

TEST(PeopleTimes, HoldingTheFirstPoseBeginsWithEverybody) {
  Result late = TwoFrames();
  late.poses[0].frame = 9;
  late.poses[0].timestamp_ns += 100'000'000;
  late.poses.pop_back();
  const Result held = HoldingFirstPose(late, MomentsOf({{"a", TwoFrames()}, {"b", late}}));
  ASSERT_EQ(held.poses.size(), 3u);
  EXPECT_EQ(held.poses[0].frame, 7);
  EXPECT_EQ(held.poses[0].timestamp_ns, TwoFrames().poses[0].timestamp_ns);
  EXPECT_EQ(held.poses[0].points_W, late.poses[0].points_W);
  EXPECT_EQ(held.poses[2].frame, 9);
}

TEST(CsvWriter, TimesCountFromTheFirstMomentOfAll) {
  const Result result = TwoFrames();
  std::vector<PoseRow> moments = result.poses;
  moments.front().timestamp_ns -= 1'500'000'000;
  const ExportSubject subject{"anna", result};
  std::ostringstream text;
  WriteCsv({std::span(&subject, 1), moments, "walk.csv"}, text);
  EXPECT_EQ(Cells(text.str(), ',')[1][0], "1.500000");
}

TEST(TrcWriter, ANameOfAFileForgesNoLine) {
  const std::string text = Written(WriteTrc, TwoFrames(), "a\nb\t.trc");
  EXPECT_EQ(Cells(text, '\t')[0].back(), "a\\x0ab\\x09.trc");
}

TEST(TableWriters, WriteNoMinusBeforeZero) {
  Result result = TwoFrames();
  result.poses[0].points_W.setConstant(-1e-9);
  result.poses[0].paper.torso_axis.setConstant(-1e-9);
  for (const bool as_trc : {true, false}) {
    const std::string text = Written(as_trc ? WriteTrc : WriteCsv, result);
    EXPECT_EQ(text.find("-0.000"), std::string::npos);
  }
}

TEST(TrcWriter, MarksCellsOfAFrameNotTrackedAsMissing) {
  const std::string text = Written(WriteTrc, TwoFrames(), "walk.trc");
  const auto rows = Cells(text, '\t');
  const std::vector<std::string>& row = rows[7];
  ASSERT_EQ(row.size(), 2u + 3 * 31);
  EXPECT_EQ(row[0], "2");
  EXPECT_EQ(row[1], "0.050000");
  EXPECT_THAT(std::vector(row.begin() + 2, row.end()), ::testing::Each("nan"));
}

TEST(CsvWriter, NamesEveryColumnWithItsUnitAndFillsIt) {
  const std::string text = Written(WriteCsv, TwoFrames());
  const auto rows = Cells(text, ',');
  ASSERT_EQ(rows.size(), 3u);
  for (const auto& row : rows) EXPECT_EQ(row.size(), rows[0].size());
  const auto cell = [&](int row, const std::string& name) {
    const auto column = std::ranges::find(rows[0], name) - rows[0].begin();
    return rows.at(row).at(column);
  };
  EXPECT_EQ(cell(1, "time_s"), "0.000000");
  EXPECT_EQ(cell(2, "time_s"), "0.050000");
  EXPECT_EQ(cell(1, "utime_us"), "1700000000000000");
  EXPECT_EQ(cell(1, "frame"), "7");
  EXPECT_EQ(cell(1, "state"), "tracking");
  EXPECT_EQ(cell(1, "theta_16_rad"), "0.250000");
  EXPECT_EQ(cell(1, "fingertips_r_x_mm"), "100.000");
  EXPECT_EQ(cell(1, "fingertips_r_y_mm"), "-300.000");
  EXPECT_EQ(cell(1, "fingertips_r_z_mm"), "2150.000");
  EXPECT_EQ(cell(1, "residual_mm"), "12.500");
  EXPECT_EQ(cell(1, "voxels"), "4321");
  EXPECT_EQ(cell(2, "state"), "lost");
  EXPECT_EQ(cell(1, "torso_origin_z_mm"), "1100.000");
  EXPECT_EQ(cell(1, "torso_z_mm"), "1105.000");
  EXPECT_EQ(cell(1, "wrist_l_x_rad"), "-0.500000");
  EXPECT_EQ(cell(1, "knee_r_y_rad"), "0.250000");
  EXPECT_EQ(cell(1, "deviation_head_mm"), "4.500");
  EXPECT_EQ(cell(1, "probability"), "0.6250");
  EXPECT_EQ(cell(2, "torso_x_mm"), "");
  EXPECT_EQ(cell(2, "knee_angle_r_deg"), "");
  EXPECT_EQ(cell(1, "ankle_angle_l_deg"), "") << "not known";
  EXPECT_EQ(cell(2, "knee_r_y_rad"), "");
  EXPECT_EQ(cell(2, "deviation_head_mm"), "");
  EXPECT_EQ(cell(2, "probability"), "");
  EXPECT_EQ(cell(2, "residual_mm"), "");
  EXPECT_EQ(cell(2, "voxels"), "0");
}

TEST(CsvWriter, HasNoNameTwice) {
  for (const char* body : {"full", "mikic2003"}) {
    const std::vector<std::string> columns = CsvColumns(RecordOf(testing::GrownBody(body)));
    EXPECT_EQ(std::set(columns.begin(), columns.end()).size(), columns.size()) << body;
  }
  const std::vector<std::string> result_columns = ResultColumns();
  EXPECT_EQ(std::ranges::count(result_columns, "torso_x_mm"), 2) << "as others rely on";
}

TEST(TableWriters, GiveNoTwoColumnsOneName) {
  const Result result = testing::SwingingResult(2);
  const auto expect_unique = [](const std::vector<std::string>& header) {
    std::set<std::string> names;
    for (const std::string& name : header) {
      EXPECT_TRUE(name.empty() || names.insert(name).second) << name;
    }
    EXPECT_GT(names.size(), 20u);
  };
  const std::string motion = Written(WriteMot, result);
  expect_unique(Cells(motion.substr(motion.find("\ntime\t") + 1), '\t').at(0));
  const ExportSubject subjects[] = {{"anna", result}, {"person-2", result}};
  std::ostringstream markers;
  WriteTrc({subjects, result.poses, "both.trc", true}, markers);
  expect_unique(Cells(markers.str(), '\t').at(3));
}

TEST(CsvWriter, KeepsThePlacesOfItsFirstColumns) {
  const std::vector<std::string> columns = CsvColumns({});
  ASSERT_GT(columns.size(), 98u);
  EXPECT_EQ(columns[4], "torso_origin_x_mm");
  EXPECT_EQ(columns[11], "theta_1_rad");
  EXPECT_EQ(columns[27], "torso_x_mm");
  EXPECT_EQ(columns[97], "voxels");
  EXPECT_EQ(columns[98], "pelvis_tilt_deg");
}

TEST(CsvWriter, HasTheAnglesOfTheMotionFileInDegrees) {
  const BodyModel body = testing::GrownBody();
  PoseState pose = testing::Standing(body);
  testing::Turn(body, "shoulder_l_x", -90, pose);
  testing::Turn(body, "knee_l_y", 60, pose);
  Result result = testing::ResultOf(body, pose);
  result.poses.front().state = CaptureState::kAcquiring;
  testing::Append(body, pose, result);
  const auto rows = Cells(Written(WriteCsv, result), ',');
  const auto cell = [&](int row, const std::string& name) {
    return rows.at(row).at(std::ranges::find(rows[0], name) - rows[0].begin());
  };
  EXPECT_EQ(cell(1, "knee_angle_l_deg"), "") << "nobody was tracked yet";
  EXPECT_NEAR(std::stod(cell(2, "knee_angle_l_deg")), 60, 0.01);
  EXPECT_NEAR(std::stod(cell(2, "arm_add_l_deg")), 0, 0.01);
  EXPECT_NEAR(std::stod(cell(2, "arm_add_r_deg")), -90, 0.01);
  EXPECT_NEAR(std::stod(cell(2, "shoulder_l_x_rad")), -EIGEN_PI / 2, 1e-5);
}

}  // namespace
}  // namespace mocap
