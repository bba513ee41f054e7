#include "tools/interchange/mot_writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "core/errors.h"
#include "tests/support/moving_body.h"
#include "tools/kinematics/foot_angles.h"
#include "tools/results/export_axes.h"

namespace mocap {
namespace {

using testing::GrownBody;
using testing::ResultOf;
using testing::Standing;
using testing::SwingingResult;
using testing::Turn;

using Row = std::map<std::string, double>;

struct ReadMot {
  std::vector<std::string> header;
  std::vector<Row> rows;
};

ReadMot WriteAndReadMot(const Result& result) {
  const ExportSubject subject{"", result};
  std::stringstream text;
  WriteMot({std::span(&subject, 1), result.poses, "walk.mot"}, text);
  ReadMot mot;
  std::string line;
  while (std::getline(text, line) && line != "endheader") mot.header.push_back(line);
  std::getline(text, line);
  std::vector<std::string> names;
  std::istringstream words(line);
  for (std::string name; words >> name;) names.push_back(name);
  while (std::getline(text, line)) {
    std::istringstream numbers(line);
    Row& row = mot.rows.emplace_back();
    for (const std::string& name : names) EXPECT_TRUE(numbers >> row[name]) << name;
    EXPECT_FALSE(numbers >> line);
  }
  return mot;
}

TEST(MotWriter, SaysHowManyFramesHaveNoRow) {
  Result result = SwingingResult(6);
  const ExportSubject subject{"", result};
  const auto remarks = [&] {
    std::stringstream text;
    return WriteMot({std::span(&subject, 1), result.poses, "walk.mot"}, text);
  };
  const std::string held = "not measured, and 0 in the file: pro_sup_r, pro_sup_l";
  EXPECT_THAT(remarks(), ::testing::ElementsAre(held));
  result.poses[3].state = CaptureState::kLost;
  EXPECT_THAT(remarks(), ::testing::ElementsAre(held, "1 frame is not tracked and has no row"));
  result.poses[4].state = CaptureState::kLost;
  EXPECT_THAT(remarks(), ::testing::ElementsAre(held, "2 frames are not tracked and have no row"));
}

TEST(MotWriter, HoldsWhatAnOldResultDoesNotShowAndSaysSo) {
  Result result = SwingingResult(3);
  testing::MakeOld(result);
  const ExportSubject subject{"", result};
  std::stringstream text;
  EXPECT_THAT(WriteMot({std::span(&subject, 1), result.poses, "walk.mot"}, text),
              ::testing::ElementsAre(
                  "not measured, and 0 in the file: ankle_angle_r, subtalar_angle_r, mtp_angle_r, "
                  "ankle_angle_l, subtalar_angle_l, mtp_angle_l, pro_sup_r, wrist_flex_r, "
                  "wrist_dev_r, pro_sup_l, wrist_flex_l, wrist_dev_l"));
  for (const Row& row : WriteAndReadMot(result).rows) {
    EXPECT_EQ(row.at("ankle_angle_l"), 0);
    EXPECT_EQ(row.at("wrist_dev_r"), 0);
  }
}

TEST(MotWriter, HoldsTheLastAnglesOfFeetAndHandsThatAFrameLacks) {
  const Result whole = SwingingResult(12);
  Result result = whole;
  for (const std::size_t i : {0u, 5u, 6u}) testing::LoseDetails(result.poses[i]);
  const ExportSubject subject{"", result};
  std::stringstream text;
  EXPECT_THAT(WriteMot({std::span(&subject, 1), result.poses, "walk.mot"}, text),
              ::testing::ElementsAre("not measured, and 0 in the file: pro_sup_r, pro_sup_l",
                                     "3 frames without feet or hands; their last angles are held"));
  const ReadMot mot = WriteAndReadMot(result), wanted = WriteAndReadMot(whole);
  for (std::size_t i = 0; i < 12; ++i) {
    const bool is_held = i == 0 || i == 5 || i == 6;
    const std::size_t shown = i == 0 ? 1 : is_held ? 4 : i;
    for (const char* name : {"ankle_angle_l", "subtalar_angle_r", "mtp_angle_l", "wrist_flex_r"})
      EXPECT_EQ(mot.rows.at(i).at(name), wanted.rows.at(shown).at(name)) << name << ' ' << i;
    // The thigh is tracked all the same.
    EXPECT_NEAR(mot.rows.at(i).at("hip_rotation_l"), wanted.rows.at(i).at("hip_rotation_l"), 1e-3)
        << i;
  }
}

/// The angles of somebody who stands with hanging arms and turns one joint.
Row AnglesOfTurn(const std::string& joint, double degrees) {
  const BodyModel body = GrownBody();
  PoseState pose = Standing(body);
  Turn(body, "shoulder_l_x", -90, pose);
  Turn(body, "shoulder_r_x", 90, pose);
  if (!joint.empty()) Turn(body, joint, degrees, pose);
  return WriteAndReadMot(ResultOf(body, pose)).rows.at(0);
}

TEST(MotWriter, WritesTheHeaderThatOpenSimReads) {
  const ReadMot mot = WriteAndReadMot(SwingingResult(7));
  ASSERT_GE(mot.header.size(), 5u);
  EXPECT_EQ(mot.header[0], "Coordinates");
  EXPECT_THAT(mot.header,
              ::testing::IsSupersetOf({"version=1", "nRows=7", "nColumns=40", "inDegrees=yes"}));
  EXPECT_NEAR(mot.rows.at(6).at("time"), 0.24, 1e-9);
}

TEST(MotWriter, AllAnglesAreZeroOfSomebodyWhoStandsWithHangingArms) {
  const Row row = AnglesOfTurn("", 0);
  for (const auto& [name, degrees] : row) {
    if (name.starts_with("pelvis_") || name == "time") continue;
    EXPECT_NEAR(degrees, 0, 1e-3) << name;
  }
  EXPECT_NEAR(row.at("pelvis_tilt"), 0, 1e-3);
  EXPECT_NEAR(row.at("pelvis_list"), 0, 1e-3);
  // Who faces world x faces z of the ground, and OpenSim's people face x.
  EXPECT_NEAR(row.at("pelvis_rotation"), -90, 1e-3);
}

TEST(MotWriter, AnglesHaveTheSignsOfOpenSimsModel) {
  struct Case {
    const char* joint;
    double degrees;
    const char* coordinate;
    double wanted;
  };
  const Case cases[] = {
      {"hip_l_y", -40, "hip_flexion_l", 40},    {"hip_r_y", -40, "hip_flexion_r", 40},
      {"hip_l_y", 20, "hip_flexion_l", -20},    {"hip_l_x", 30, "hip_adduction_l", -30},
      {"hip_r_x", -30, "hip_adduction_r", -30}, {"knee_l_y", 50, "knee_angle_l", 50},
      {"knee_r_y", 50, "knee_angle_r", 50},     {"elbow_l_z", -70, "elbow_flex_l", 70},
      {"elbow_r_z", 70, "elbow_flex_r", 70},    {"waist_y", 20, "lumbar_extension", 20},
      {"waist_y", 20, "pelvis_list", 20},       {"knee_l_y", 50, "knee_angle_l_beta", 50},
      {"wrist_l_x", 20, "wrist_dev_l", -20},    {"wrist_r_x", 20, "wrist_dev_r", 20},
      {"wrist_l_z", -20, "wrist_flex_l", 20},   {"wrist_r_z", 20, "wrist_flex_r", 20},
      {"hip_l_z", 25, "hip_rotation_l", -25},   {"hip_r_z", 25, "hip_rotation_r", 25},
  };
  for (const Case& c : cases) {
    EXPECT_NEAR(AnglesOfTurn(c.joint, c.degrees).at(c.coordinate), c.wanted, 0.01)
        << c.joint << ' ' << c.degrees;
  }
  // An arm that is raised: to the side, and forward.
  EXPECT_NEAR(AnglesOfTurn("shoulder_l_x", -30).at("arm_add_l"), -60, 0.01);
  EXPECT_NEAR(AnglesOfTurn("shoulder_r_x", 30).at("arm_add_r"), -60, 0.01);
}

TEST(MotWriter, ReadsTurnsOfALimbAboutItselfFromItsBend) {
  const BodyModel body = GrownBody();
  PoseState pose = Standing(body);
  Turn(body, "knee_l_y", 80, pose);
  Turn(body, "hip_l_z", 25, pose);  // The left thigh turned out.
  Turn(body, "knee_r_y", 80, pose);
  Turn(body, "hip_r_z", 25, pose);  // The right one in.
  const Row row = WriteAndReadMot(ResultOf(body, pose)).rows.at(0);
  EXPECT_NEAR(row.at("hip_rotation_l"), -25, 0.01);
  EXPECT_NEAR(row.at("hip_rotation_r"), 25, 0.01);
  EXPECT_NEAR(row.at("knee_angle_l"), 80, 0.01);
}

/// Turned about the axes of the model's ankle, a left foot mirrored.
TEST(FootAngles, AreThoseOfTheModelsAxes) {
  const Vector3 ankle(-0.10501355, -0.17402245, 0.97912632);
  const Vector3 subtalar(0.78717961, 0.60474746, -0.12094949);
  for (const double up : {-0.8, -0.2, 0.0, 0.5}) {
    for (const double in : {-0.6, 0.0, 0.3}) {
      const FootAngles angles = FootAnglesOf(ExpRotation(ankle * up) * ExpRotation(subtalar * in));
      EXPECT_NEAR(angles.ankle, up, 1e-6);
      EXPECT_NEAR(angles.subtalar, in, 1e-6);
    }
  }
}

TEST(FootAngles, ToesUpAndTheSoleInwardArePositive) {
  const FootAngles up = FootAnglesOf(ExpRotation({0, 0, 0.3}));
  EXPECT_GT(up.ankle, 0.25);
  EXPECT_NEAR(up.about_shin[0], 0.3, 1e-9);
  // Of the right foot, whose inner side is the left one.
  const FootAngles inward = FootAnglesOf(ExpRotation({0.3, 0, 0}));
  EXPECT_GT(inward.subtalar, 0.2);
  EXPECT_NEAR(inward.about_shin[1], 0.3, 1e-9);
}

TEST(FootAngles, AboutTheShinAreToesUpThenInwardThenTheSoleInward) {
  constexpr double kDegree = EIGEN_PI / 180;
  const Matrix3 R_ShinFoot = ExpRotation({0, 0, 30 * kDegree}) * ExpRotation({0, 20 * kDegree, 0}) *
                             ExpRotation({10 * kDegree, 0, 0});
  const Vector3 degrees = FootAnglesOf(R_ShinFoot).about_shin / kDegree;
  EXPECT_LT((degrees - Vector3(30, 10, 20)).norm(), 1e-6) << degrees.transpose();
}

TEST(MotWriter, BothFeetHaveTheSameSigns) {
  for (const double degrees : {-20.0, 15.0}) {
    const Row left = AnglesOfTurn("ankle_l_y", degrees), right = AnglesOfTurn("ankle_r_y", degrees);
    EXPECT_NEAR(left.at("ankle_angle_l"), right.at("ankle_angle_r"), 0.01);
    EXPECT_NEAR(left.at("subtalar_angle_l"), right.at("subtalar_angle_r"), 0.01);
    EXPECT_NEAR(left.at("ankle_angle_l"), -degrees, 0.1 * std::abs(degrees)) << "down is negative";
  }
}

TEST(MotWriter, FeetShowHowAStraightLegIsTurned) {
  for (double bend = 0; bend <= 30; bend += 5) {
    const BodyModel body = GrownBody();
    PoseState pose = Standing(body);
    Turn(body, "knee_l_y", bend, pose);
    Turn(body, "hip_l_z", 25, pose);
    const Row row = WriteAndReadMot(ResultOf(body, pose)).rows.at(0);
    EXPECT_NEAR(row.at("hip_rotation_l"), -25, 0.01) << bend;
    EXPECT_NEAR(row.at("knee_angle_l"), bend, 0.01);
    EXPECT_NEAR(row.at("ankle_angle_l"), 0, 0.01);
  }
}

TEST(MotWriter, WithoutFeetTurnsOfAStraightLimbAboutItselfFadeOut) {
  double last = 0;
  const BodyModel body = GrownBody();
  for (double bend = 0; bend <= 30; bend += 0.5) {
    PoseState pose = Standing(body);
    Turn(body, "knee_l_y", bend, pose);
    Turn(body, "hip_l_z", 25, pose);
    Result result = ResultOf(body, pose);
    testing::MakeOld(result);
    const double rotation = WriteAndReadMot(result).rows.at(0).at("hip_rotation_l");
    if (bend < 10) {
      EXPECT_NEAR(rotation, 0, 0.01) << bend;
    }
    EXPECT_LE(rotation, last + 1e-3) << "no jump at " << bend;
    EXPECT_GT(rotation, last - 3) << "no jump at " << bend;
    last = rotation;
  }
  EXPECT_NEAR(last, -25, 0.01);
}

TEST(MotWriter, AStraightLimbBentTheWrongWayIsOverstretched) {
  for (double bend = 1; bend < 20; ++bend) {
    const Row row = AnglesOfTurn("knee_l_y", -bend);
    EXPECT_NEAR(row.at("knee_angle_l"), -bend, 0.01);
    EXPECT_NEAR(row.at("hip_rotation_l"), 0, 0.01);
  }
}

/// R = Rz Rx Ry, as OpenSim's joints turn.
Matrix3 Turned(double z_deg, double x_deg, double y_deg) {
  constexpr double kDegree = EIGEN_PI / 180;
  return (Eigen::AngleAxisd(z_deg * kDegree, Vector3::UnitZ()) *
          Eigen::AngleAxisd(x_deg * kDegree, Vector3::UnitX()) *
          Eigen::AngleAxisd(y_deg * kDegree, Vector3::UnitY()))
      .toRotationMatrix();
}

TEST(MotWriter, TheModelsJointsTurnedByTheAnglesPointWhereTheLimbsDo) {
  const Result result = SwingingResult(200);
  const ReadMot mot = WriteAndReadMot(result);
  const Vector3 down = -Vector3::UnitY();
  for (std::size_t i = 0; i < result.poses.size(); ++i) {
    const PoseRow& pose = result.poses[i];
    const Row& row = mot.rows.at(i);
    const auto along = [&](Point a, Point b) -> Vector3 {
      return YUpFromWorld() *
             (pose.points_W.col(static_cast<int>(b)) - pose.points_W.col(static_cast<int>(a)))
                 .normalized();
    };
    const auto turned = [&](const char* z, const char* x, const char* y, double side) {
      return Turned(row.at(z), side * row.at(x), side * row.at(y));
    };
    const Matrix3 R_pelvis = turned("pelvis_tilt", "pelvis_list", "pelvis_rotation", 1);
    const Matrix3 R_torso =
        R_pelvis * turned("lumbar_extension", "lumbar_bending", "lumbar_rotation", 1);
    const Matrix3 R_thigh =
        R_pelvis * turned("hip_flexion_l", "hip_adduction_l", "hip_rotation_l", -1);
    const Matrix3 R_arm = R_torso * turned("arm_flex_r", "arm_add_r", "arm_rot_r", 1);
    EXPECT_LT((R_pelvis.col(2) - along(Point::kHipL, Point::kHipR)).norm(), 1e-4);
    EXPECT_LT((R_thigh * down - along(Point::kHipL, Point::kKneeL)).norm(), 1e-4) << i;
    EXPECT_LT((R_arm * down - along(Point::kShoulderR, Point::kElbowR)).norm(), 1e-4) << i;
    // Limbs that are nearly straight have no plane to turn in.
    const double bent = std::abs(row.at("knee_angle_l")) > 21 ? 1e-4 : 0.35;
    EXPECT_LT((R_thigh * Turned(-row.at("knee_angle_l"), 0, 0) * down -
               along(Point::kKneeL, Point::kFootL))
                  .norm(),
              bent)
        << i;
    const double elbow = std::abs(row.at("elbow_flex_r")) > 21 ? 1e-4 : 0.35;
    EXPECT_LT((R_arm * Turned(row.at("elbow_flex_r"), 0, 0) * down -
               along(Point::kElbowR, Point::kLowerArmR))
                  .norm(),
              elbow)
        << i;
  }
}

TEST(MotWriter, TheModelsFeetAndHandsPointWhereThePersonsDo) {
  const BodyModel body = GrownBody();
  for (int i = 0; i < 100; ++i) {
    const Result result = ResultOf(body, testing::Swinging(body, 0.1 * i));
    const Row row = WriteAndReadMot(result).rows.at(0);
    const auto along = [&](Point a, Point b) -> Vector3 {
      BodyPlaces places;
      places << result.poses[0].points_W, result.poses[0].further_W;
      return YUpFromWorld() *
             (places.col(static_cast<int>(b)) - places.col(static_cast<int>(a))).normalized();
    };
    const auto turned = [&](const char* z, const char* x, const char* y) {
      return Turned(row.at(z), row.at(x), row.at(y));
    };
    const auto about = [&](const Vector3& axis, const char* name) {
      return ExpRotation(axis * (row.at(name) * EIGEN_PI / 180));
    };
    const Matrix3 R_pelvis = turned("pelvis_tilt", "pelvis_list", "pelvis_rotation");
    const Matrix3 R_torso =
        R_pelvis * turned("lumbar_extension", "lumbar_bending", "lumbar_rotation");
    const Matrix3 R_foot = R_pelvis * turned("hip_flexion_r", "hip_adduction_r", "hip_rotation_r") *
                           Turned(-row.at("knee_angle_r"), 0, 0) *
                           about({-0.10501355, -0.17402245, 0.97912632}, "ankle_angle_r") *
                           about({0.78717961, 0.60474746, -0.12094949}, "subtalar_angle_r");
    EXPECT_GT((R_foot * Vector3::UnitX()).dot(along(Point::kHeelR, Point::kBallR)), 0.9999) << i;
    const Matrix3 R_hand = R_torso * turned("arm_flex_r", "arm_add_r", "arm_rot_r") *
                           Turned(row.at("elbow_flex_r"), 0, 0) *
                           Turned(row.at("wrist_flex_r"), row.at("wrist_dev_r"), 0);
    EXPECT_LT((-R_hand.col(1) - along(Point::kWristR, Point::kFingertipsR)).norm(), 1e-4) << i;
  }
}

TEST(MotWriter, LeavesOutRowsOfFramesNotTracked) {
  Result result = SwingingResult(6);
  result.poses[0].state = CaptureState::kAcquiring;
  result.poses[3].state = CaptureState::kLost;
  const ReadMot mot = WriteAndReadMot(result);
  ASSERT_EQ(mot.rows.size(), 4u);
  EXPECT_NEAR(mot.rows[0].at("time"), 0.04, 1e-9);
  EXPECT_NEAR(mot.rows[2].at("time"), 0.16, 1e-9);
}

TEST(MotWriter, RefusesAResultWithoutATrackedFrame) {
  Result result = SwingingResult(1);
  result.poses[0].state = CaptureState::kLost;
  EXPECT_THROW(WriteAndReadMot(result), SetupError);
}

}  // namespace
}  // namespace mocap
