#include "tools/comparison/point_names.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace mocap {
namespace {

using ::testing::ElementsAre;

/// The markers of the first pair of a point.
std::vector<std::string> FirstAt(const std::string& point, const std::vector<std::string>& names) {
  RecordedMotion other;
  for (const std::string& name : names) other.points.push_back({name, {}});
  const std::vector<NamedPair> pairs = PairsByName(other);
  const auto pair = std::ranges::find(pairs, point, &NamedPair::point);
  return pair == pairs.end() ? std::vector<std::string>() : pair->others;
}

TEST(PointNames, AreThoseOfEveryConvention) {
  EXPECT_THAT(FirstAt("heel_l", {"RHEE", "LHEE"}), ElementsAre("LHEE"));
  EXPECT_THAT(FirstAt("heel_r", {"R.Heel"}), ElementsAre("R.Heel"));
  EXPECT_THAT(FirstAt("knee_r", {"subject:rkne"}), ElementsAre("subject:rkne"));
  EXPECT_THAT(FirstAt("hip_l", {"mixamorig:LeftUpLeg"}), ElementsAre("mixamorig:LeftUpLeg"));
  EXPECT_THAT(FirstAt("wrist_r", {"RFAradius", "RFAulna"}), ElementsAre("RFAradius", "RFAulna"));
  EXPECT_THAT(FirstAt("upper_arm_l", {"upper_arm_l"}), ElementsAre("upper_arm_l"));
  EXPECT_THAT(FirstAt("knee_r", {"R.Knee.Lat", "R.Knee.Med"}),
              ElementsAre("R.Knee.Lat", "R.Knee.Med"));
  EXPECT_THAT(FirstAt("toe_l", {"LBigToe"}), ElementsAre("LBigToe"));
  EXPECT_TRUE(FirstAt("knee_l", {"M1", "RKNE"}).empty());
}

TEST(PointNames, TheMiddleOfTwoMarkersIsBetterThanOne) {
  EXPECT_THAT(FirstAt("knee_l", {"LKNE", "LLFC", "LMFC"}), ElementsAre("LLFC", "LMFC"));
  EXPECT_THAT(FirstAt("knee_l", {"LLFC"}), ElementsAre("LLFC"));
  EXPECT_THAT(FirstAt("torso", {"Spine", "Spine2", "Spine1"}), ElementsAre("Spine2"));
}

TEST(PointNames, AMarkerMayBelongToSeveralPoints) {
  EXPECT_THAT(PointsNamed("LTOE"), ElementsAre("toe_l", "ball_l"));
  EXPECT_TRUE(PointsNamed("M1").empty());
}

}  // namespace
}  // namespace mocap
