#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/exported_bvh.h"
#include "tests/support/moving_body.h"

namespace mocap {
namespace {

using testing::ExpectHandsAndFeet;
using testing::ExpectPlaces;
using testing::GrownBody;
using testing::JointsAt;
using testing::PlacesAt;
using testing::ReadBvh;
using testing::ReadNode;
using testing::ResultOf;
using testing::Standing;
using testing::Swinging;
using testing::SwingingResult;
using testing::WrittenBvh;

TEST(Lafan1Skeleton, HasItsNamesInItsOrder) {
  const ReadBvh bvh = WrittenBvh(SwingingResult(2), Lafan1Skeleton());
  std::vector<std::string> names;
  for (const ReadNode& node : bvh.nodes) {
    if (!node.name.ends_with("_end")) names.push_back(node.name);
    if (node.parent < 0) {
      EXPECT_THAT(node.channels, ::testing::ElementsAre("Xposition", "Yposition", "Zposition",
                                                        "Zrotation", "Yrotation", "Xrotation"));
    } else if (!node.name.ends_with("_end")) {
      EXPECT_THAT(node.channels, ::testing::ElementsAre("Zrotation", "Yrotation", "Xrotation"));
    }
  }
  EXPECT_THAT(names, ::testing::ElementsAre(
                         "Hips", "LeftUpLeg", "LeftLeg", "LeftFoot", "LeftToe", "RightUpLeg",
                         "RightLeg", "RightFoot", "RightToe", "Spine", "Spine1", "Spine2", "Neck",
                         "Head", "LeftShoulder", "LeftArm", "LeftForeArm", "LeftHand",
                         "RightShoulder", "RightArm", "RightForeArm", "RightHand"));
}

TEST(Lafan1Skeleton, HasItsAxes) {
  const BodyModel body = GrownBody();
  const Vector3 left(1, 0, 0), up(0, 1, 0), forward(0, 0, 1);
  // Where x and y of a joint point in a T-pose.
  const std::map<std::string, std::pair<Vector3, Vector3>> wanted = {
      {"Hips", {up, forward}},           {"Spine", {up, forward}},
      {"Spine2", {up, forward}},         {"Head", {up, forward}},
      {"LeftUpLeg", {-up, forward}},     {"RightUpLeg", {-up, forward}},
      {"LeftLeg", {-up, forward}},       {"RightLeg", {-up, forward}},
      {"LeftToe", {forward, up}},        {"RightToe", {forward, up}},
      {"LeftArm", {left, -forward}},     {"RightArm", {-left, -forward}},
      {"LeftForeArm", {left, -forward}}, {"RightForeArm", {-left, -forward}},
      {"LeftHand", {left, -forward}},    {"RightHand", {-left, -forward}}};
  const auto joints = JointsAt(WrittenBvh(ResultOf(body, Standing(body)), Lafan1Skeleton()), 0);
  for (const auto& [name, axes] : wanted) {
    // The trunk's joints lie a few degrees behind or before each other.
    EXPECT_GT(joints.at(name).linear().col(0).dot(axes.first), 0.99) << name;
    EXPECT_GT(joints.at(name).linear().col(1).dot(axes.second), 0.99) << name;
  }
  EXPECT_NEAR(joints.at("LeftFoot").linear().col(0).dot(forward), 0.88, 0.05) << "down to the toes";
}

TEST(Lafan1Skeleton, BonesLieAlongXAndJointsAreInPlace) {
  const BodyModel body = GrownBody();
  const Result result = SwingingResult(60, body);
  const ReadBvh bvh = WrittenBvh(result, Lafan1Skeleton());
  const std::set<std::string> branches = {"LeftUpLeg", "RightUpLeg", "Spine", "LeftShoulder",
                                          "RightShoulder"};
  for (const ReadNode& node : bvh.nodes) {
    if (node.parent < 0 || branches.contains(node.name)) continue;
    EXPECT_NEAR(node.offset.x(), node.offset.norm(), 1e-3) << node.name;
  }
  for (int i = 0; i < 60; ++i) {
    std::map<std::string, Eigen::Vector3d> places = PlacesAt(bvh, i);
    places["Spine"] = places.at("Spine2");
    ExpectPlaces(places, result.poses[i]);
    ExpectHandsAndFeet(places, body, Swinging(body, 0.04 * i));
  }
}

}  // namespace
}  // namespace mocap
