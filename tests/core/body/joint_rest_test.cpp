#include "core/body/joint_rest.h"

#include <gtest/gtest.h>

#include "config/load_config.h"
#include "core/degrees.h"

namespace mocap {
namespace {

class Rest : public ::testing::Test {
 protected:
  int RowOf(const std::string& name) const {
    for (int row = 0; row < std::ssize(table_.joints); ++row) {
      if (table_.joints[row].name == name) return row;
    }
    throw std::logic_error("no such joint");
  }
  double DegreesOf(const std::string& name) const {
    return RestOf(table_, RowOf(name), theta_).rest_rad * kDegreesPerRad;
  }

  BodyTable table_ = LoadBodyTable("full");
  JointAngles theta_ = JointAngles::Zero(std::ssize(table_.joints));
};

TEST_F(Rest, CollarBonesRiseWithTheirArms) {
  theta_[RowOf("shoulder_l_x")] = -90 / kDegreesPerRad;
  EXPECT_NEAR(DegreesOf("clavicle_l_x"), 0, 1e-9);
  EXPECT_NEAR(DegreesOf("clavicle_r_x"), -36, 1e-9) << "the right arm is level";
  theta_[RowOf("shoulder_l_x")] = 60 / kDegreesPerRad;
  theta_[RowOf("clavicle_l_x")] = 30 / kDegreesPerRad;
  EXPECT_NEAR(DegreesOf("clavicle_l_x"), 72, 1e-9) << "overhead";
}

TEST_F(Rest, AnArmThatPointsForwardIsLevel) {
  theta_[RowOf("shoulder_l_z")] = -90 / kDegreesPerRad;
  EXPECT_NEAR(DegreesOf("clavicle_l_x"), 36, 1e-9);
}

TEST_F(Rest, OtherJointsRestWhereTheTableSays) {
  const JointRest rest = RestOf(table_, RowOf("hip_l_z"), theta_);
  EXPECT_NEAR(rest.rest_rad, 5 / kDegreesPerRad, 1e-9);
  EXPECT_EQ(rest.J_by_angle, JointAngles::Zero(theta_.size()));
}

TEST_F(Rest, ChiSquareIsInStandardDeviationsOfTheTable) {
  for (int row = 0; row < theta_.size(); ++row) {
    if (table_.joints[row].rise_rad == 0) theta_[row] = table_.joints[row].rest_rad;
  }
  const double before = ChiSquareFromRest(table_, theta_);
  theta_[RowOf("ankle_l_y")] += 40 / kDegreesPerRad;
  theta_[RowOf("waist_x")] -= 10 / kDegreesPerRad;
  EXPECT_NEAR(ChiSquareFromRest(table_, theta_) - before, 4 + 1, 1e-9);
  theta_[RowOf("knee_l_y")] += 1;
  EXPECT_NEAR(ChiSquareFromRest(table_, theta_) - before, 4 + 1, 1e-9) << "has no rest";
}

TEST_F(Rest, ChiSquareOfARaisedArmIsLeastWithARaisedCollarBone) {
  theta_[RowOf("shoulder_l_z")] = -90 / kDegreesPerRad;
  const double lowered = ChiSquareFromRest(table_, theta_);
  theta_[RowOf("clavicle_l_x")] = 36 / kDegreesPerRad;
  EXPECT_LT(ChiSquareFromRest(table_, theta_), lowered - 10);
}

TEST_F(Rest, ChangesAsItsJacobianSays) {
  constexpr double kStepRad = 1e-6;
  for (int i = 0; i < theta_.size(); ++i) theta_[i] = 0.4 - 0.07 * i;
  for (const char* name : {"clavicle_l_x", "clavicle_r_x"}) {
    const JointRest rest = RestOf(table_, RowOf(name), theta_);
    for (int i = 0; i < theta_.size(); ++i) {
      JointAngles moved = theta_;
      moved[i] += kStepRad;
      const double by_difference =
          (RestOf(table_, RowOf(name), moved).rest_rad - rest.rest_rad) / kStepRad;
      EXPECT_NEAR(rest.J_by_angle[i], by_difference, 1e-5) << name << " by " << i;
    }
  }
}

}  // namespace
}  // namespace mocap
