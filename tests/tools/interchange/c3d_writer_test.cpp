#include "tools/interchange/c3d_writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <sstream>
#include <string>

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
                  "RShoulderAngles", "LElbowAngles", "RElbowAngles", "SpineAngles"));
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
  ASSERT_EQ(c3d.labels.size(), 8u * 32);
  EXPECT_EQ(c3d.At("POINT:LABELS").texts.size(), 255u);
  EXPECT_EQ(c3d.labels.back(), "person-8:SpineAngles");
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
