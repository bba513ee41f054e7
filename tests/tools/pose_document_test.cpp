// docs/poses.md, held to the code.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "core/degrees.h"
#include "tests/support/moving_body.h"
#include "tests/support/temporary_folder.h"
#include "tools/interchange/bvh_writer.h"
#include "tools/kinematics/joint_angles.h"
#include "tools/results/fixed_text.h"
#include "tools/results/result_columns.h"

namespace mocap {
namespace {

using testing::GrownBody;
using ::testing::HasSubstr;
using testing::Turn;

std::string Document() {
  return testing::ReadText(std::filesystem::path(MOCAP_SOURCE_DIR) / "docs/poses.md");
}

PoseState ArmsHanging(const BodyModel& body) {
  PoseState pose = testing::Standing(body);
  Turn(body, "shoulder_l_x", -90, pose);
  Turn(body, "shoulder_r_x", 90, pose);
  return pose;
}

Eigen::Index RowOf(const BodyModel& body, const std::string& joint) {
  return std::ranges::find(body.table().joints, joint, &JointAxis::name) -
         body.table().joints.begin();
}

std::array<double, kCoordinateNames.size()> DegreesOf(const BodyModel& body,
                                                      const PoseState& pose) {
  auto values = CoordinatesOf(AnglesOf(testing::ResultOf(body, pose)).at(0));
  for (double& value : values) value *= kDegreesPerRad;
  return values;
}

/// The coordinate of the motion file that a joint changes most, and with which sign. Elbows and
/// knees are bent, because a straight limb does not show how it is twisted.
std::string CoordinateOf(const BodyModel& body, const JointAxis& joint) {
  constexpr double kTurn_deg = 4;
  PoseState pose = ArmsHanging(body);
  Turn(body, "elbow_l_z", -40, pose);
  Turn(body, "elbow_r_z", 40, pose);
  Turn(body, "knee_l_y", 40, pose);
  Turn(body, "knee_r_y", 40, pose);
  const auto before = DegreesOf(body, pose);
  const auto row = static_cast<Eigen::Index>(&joint - body.table().joints.data());
  pose.theta[row] += kTurn_deg / kDegreesPerRad;
  const auto after = DegreesOf(body, pose);
  std::string coordinate = "–";
  double largest = kTurn_deg / 2;
  for (std::size_t i = 0; i < kCoordinateNames.size(); ++i) {
    const double change = after[i] - before[i];
    if (kCoordinateNames[i].starts_with("pelvis") || std::abs(change) <= largest) continue;
    largest = std::abs(change);
    coordinate = fmt::format("`{}` {}", kCoordinateNames[i], change > 0 ? "+" : "−");
  }
  return coordinate;
}

std::string Degrees(double rad) {
  const auto degrees = static_cast<int>(std::lround(rad * kDegreesPerRad));
  return degrees < 0 ? fmt::format("−{}", -degrees) : fmt::format("{}", degrees);
}

TEST(PoseDocument, ListsTheJointsAsTheyAre) {
  const std::string document = Document();
  const BodyModel body = GrownBody();
  std::string expected;
  for (const JointAxis& joint : body.table().joints) {
    const auto along = [](double a, double b) { return std::abs(a) < std::abs(b); };
    const char axis = "xyz"[std::ranges::max_element(joint.axis_T, along) - joint.axis_T.begin()];
    const std::string column =
        joint.paper_angle > 0 ? PaperAngleColumn(joint.paper_angle) : JointColumn(joint.name);
    const std::string row =
        fmt::format("| `{}` | `{}` | {} | {} to {} | {} |", joint.name, column, axis,
                    Degrees(joint.min_rad), Degrees(joint.max_rad), CoordinateOf(body, joint));
    expected += row + '\n';
    EXPECT_TRUE(document.find('\n' + row) != std::string::npos) << row;
  }
  if (HasFailure()) ADD_FAILURE() << "expected rows:\n" << expected;
}

/// "4–6": where columns are, counted from 1.
std::string Places(const std::vector<std::string>& columns, const std::string& first,
                   const std::string& last, std::size_t from) {
  const auto place_of = [&](const std::string& name) {
    const auto begin = columns.begin() + static_cast<std::ptrdiff_t>(from);
    return std::find(begin, columns.end(), name) - columns.begin() + 1;
  };
  if (first == last) return fmt::format("| {} | `{}` |", place_of(first), first);
  return fmt::format("| {}–{} | `{}` … `{}` |", place_of(first), place_of(last), first, last);
}

TEST(PoseDocument, ListsTheColumnsOfAResultInOrder) {
  const std::string document = Document();
  const std::vector<std::string> columns = ResultColumns();
  const auto expect_row = [&](const std::string& first, const std::string& last,
                              std::size_t from = 0) {
    EXPECT_THAT(document, HasSubstr('\n' + Places(columns, first, last, from)));
  };
  for (const char* name :
       {"frame", "timestamp_ns", "state", "torso_angle_rad", "residual_mm", "voxels"})
    expect_row(name, name);
  expect_row("torso_x_mm", "torso_z_mm");
  expect_row("torso_axis_x", "torso_axis_z");
  expect_row("theta_1_rad", "theta_16_rad");
  expect_row("torso_x_mm", "foot_r_z_mm", 10);
  EXPECT_THAT(document, HasSubstr("`" + fmt::format("{}", fmt::join(kPointNames, "`, `")) + "`"));
  EXPECT_THAT(document,
              HasSubstr("`" + fmt::format("{}", fmt::join(kCoordinateNames, "`, `")) + "`"));
  std::size_t end = 0;
  const auto expect_next = [&](const std::string& told) {
    end = document.find("| then | " + told + " |", end);
    EXPECT_NE(end, std::string::npos) << told;
  };
  expect_next('`' + JointColumn("<joint>") + '`');
  // Of further columns of a kind, the first and the last are named.
  const std::vector<FurtherColumn> further = FurtherColumns({}, ListedJoints::kAll);
  constexpr std::size_t kCoordinates = 3 * kFurtherPointCount;
  const auto expect_kind = [&](std::size_t first, std::size_t count) {
    expect_next(
        fmt::format("`{}` … `{}`", further.at(first).name, further.at(first + count - 1).name));
  };
  expect_kind(0, kCoordinates);
  expect_next('`' + DeviationColumn("<point>") + '`');
  expect_kind(kCoordinates + kPlaceCount, kContactCount);
  expect_next('`' + further.at(kCoordinates + kPlaceCount + kContactCount).name + '`');
  EXPECT_EQ(further.size(), kCoordinates + kPlaceCount + kContactCount + 1);
}

/// The numbers of a file's last frame, such as "LeftArm Zrotation".
std::map<std::string, double> LastFrameOf(const std::string& bvh) {
  std::vector<std::string> names;
  std::istringstream lines(bvh);
  std::string joint, line;
  while (std::getline(lines, line)) {
    std::istringstream words(line);
    std::string word;
    words >> word;
    if (word == "ROOT" || word == "JOINT") words >> joint;
    if (word == "MOTION") break;
    if (word != "CHANNELS") continue;
    for (words >> word; words >> word;) names.push_back(fmt::format("{} {}", joint, word));
  }
  while (lines.peek() != EOF) std::getline(lines, line);
  std::map<std::string, double> values;
  std::istringstream numbers(line);
  for (const std::string& name : names) numbers >> values[name];
  return values;
}

TEST(PoseDocument, ComparesOnePoseInAllConventions) {
  const std::string document = Document();
  const BodyModel body = GrownBody();
  PoseState pose = ArmsHanging(body);
  Turn(body, "knee_l_y", 60, pose);
  const Result result = testing::ResultOf(body, pose);
  const auto degrees = DegreesOf(body, pose);
  const auto coordinate = [&](std::string_view name) {
    return FixedText(degrees[std::ranges::find(kCoordinateNames, name) - kCoordinateNames.begin()],
                     0);
  };
  EXPECT_EQ(coordinate("arm_flex_l"), "0");
  EXPECT_THAT(document,
              HasSubstr(fmt::format("| `arm_add_l` {} | `knee_angle_l` {} |",
                                    coordinate("arm_add_l"), coordinate("knee_angle_l"))));
  EXPECT_THAT(document, HasSubstr(fmt::format("| `theta_3_rad` −{} | `theta_15_rad` {} |",
                                              FixedText(-result.poses[0].paper.theta_rad[2], 2),
                                              FixedText(result.poses[0].paper.theta_rad[14], 2))));
  EXPECT_THAT(document,
              HasSubstr(fmt::format("| `shoulder_l_x` −{} | `knee_l_y` {} |",
                                    FixedText(-pose.theta[RowOf(body, "shoulder_l_x")], 2),
                                    FixedText(pose.theta[RowOf(body, "knee_l_y")], 2))));
  const ExportSubject subject{"", result};
  std::ostringstream bvh;
  WriteBvh({std::span(&subject, 1), result.poses, "walk.bvh"}, bvh);
  const std::map<std::string, double> frame = LastFrameOf(bvh.str());
  EXPECT_THAT(document,
              HasSubstr(fmt::format("| `LeftArm` Z {} | `LeftLeg` X {} |",
                                    Degrees(frame.at("LeftArm Zrotation") / kDegreesPerRad),
                                    Degrees(frame.at("LeftLeg Xrotation") / kDegreesPerRad))));
}

}  // namespace
}  // namespace mocap
