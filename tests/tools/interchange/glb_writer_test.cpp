#include "tools/interchange/glb_writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/moving_body.h"
#include "tools/interchange/body_mesh.h"
#include "tools/results/export_axes.h"

namespace mocap {
namespace {

using nlohmann::json;
using testing::Append;
using testing::GrownBody;
using testing::ResultOf;
using testing::RightArmRaised;
using testing::Standing;
using testing::Swinging;
using testing::SwingingResult;

/// A reader of GLB that knows nothing of the writer: what a viewer would do.
class ReadGlb {
 public:
  explicit ReadGlb(const std::string& file) {
    EXPECT_EQ(file.substr(0, 4), "glTF");
    EXPECT_EQ(Number<std::uint32_t>(file, 8), file.size());
    const auto json_size = Number<std::uint32_t>(file, 12);
    root_ = json::parse(file.substr(20, json_size));
    binary_ = file.substr(20 + json_size + 8);
    EXPECT_EQ(Number<std::uint32_t>(file, 20 + json_size), binary_.size());
    for (const json& channel : root_["animations"][0]["channels"]) {
      const json& sampler = root_["animations"][0]["samplers"][channel["sampler"].get<int>()];
      times_ = Floats(sampler["input"]);
      curves_[{channel["target"]["node"], channel["target"]["path"]}] = Floats(sampler["output"]);
    }
  }

  const json& root() const { return root_; }
  const std::vector<float>& times() const { return times_; }
  std::vector<float> Floats(int accessor) const {
    const json& about = root_["accessors"][accessor];
    const std::map<std::string, int> widths = {
        {"SCALAR", 1}, {"VEC3", 3}, {"VEC4", 4}, {"MAT4", 16}};
    const int count = about["count"].get<int>() * widths.at(about["type"]);
    const std::size_t from = root_["bufferViews"][about["bufferView"].get<int>()]["byteOffset"];
    std::vector<float> values;
    for (int i = 0; i < count; ++i) values.push_back(Number<float>(binary_, from + 4 * i));
    return values;
  }
  std::vector<Eigen::Isometry3d> NodesAt(std::size_t frame) const {
    std::vector<Eigen::Isometry3d> world(root_["nodes"].size(), Eigen::Isometry3d::Identity());
    for (const int node : root_["scenes"][0]["nodes"]) {
      Place(node, Eigen::Isometry3d::Identity(), frame, world);
    }
    return world;
  }
  /// Of all nodes with names [m].
  std::map<std::string, Vector3> PlacesAt(std::size_t frame) const {
    const std::vector<Eigen::Isometry3d> world = NodesAt(frame);
    std::map<std::string, Vector3> places;
    for (std::size_t i = 0; i < world.size(); ++i) {
      places[root_["nodes"][i]["name"]] = world[i].translation();
    }
    return places;
  }

 private:
  template <typename T>
  static T Number(const std::string& bytes, std::size_t at) {
    T number;
    EXPECT_LE(at + sizeof(T), bytes.size());
    std::memcpy(&number, bytes.data() + at, sizeof(T));
    return number;
  }
  void Place(int node, const Eigen::Isometry3d& parent, std::size_t frame,
             std::vector<Eigen::Isometry3d>& world) const {
    const json& about = root_["nodes"][node];
    Eigen::Isometry3d X = parent;
    const auto moved = curves_.find({node, "translation"});
    if (moved != curves_.end()) {
      const float* p = &moved->second.at(3 * frame);
      X.translate(Vector3(p[0], p[1], p[2]));
    } else if (about.contains("translation")) {
      const std::vector<double> p = about["translation"];
      X.translate(Vector3(p[0], p[1], p[2]));
    }
    const auto turned = curves_.find({node, "rotation"});
    if (turned != curves_.end()) {
      const float* q = &turned->second.at(4 * frame);
      const Eigen::Quaterniond rotation(q[3], q[0], q[1], q[2]);
      EXPECT_NEAR(rotation.norm(), 1, 1e-5);
      X.rotate(rotation);
    }
    world[node] = X;
    if (!about.contains("children")) return;
    for (const int child : about["children"]) Place(child, X, frame, world);
  }

  json root_;
  std::string binary_;
  std::vector<float> times_;
  std::map<std::pair<int, std::string>, std::vector<float>> curves_;
};

ReadGlb WriteAndRead(const Result& result) {
  const ExportSubject subject{"", result};
  std::ostringstream file;
  WriteGlb({std::span(&subject, 1), result.poses, "walk.glb"}, file);
  return ReadGlb(file.str());
}

void ExpectNodes(const std::map<std::string, Vector3>& places, const PoseRow& row) {
  const std::pair<const char*, Point> points[] = {{"Spine", Point::kTorso},
                                                  {"Neck", Point::kNeck},
                                                  {"Head", Point::kHead},
                                                  {"LeftArm", Point::kShoulderL},
                                                  {"RightArm", Point::kShoulderR},
                                                  {"LeftForeArm", Point::kElbowL},
                                                  {"RightForeArm", Point::kElbowR},
                                                  {"LeftHandEnd", Point::kFingertipsL},
                                                  {"RightHandEnd", Point::kFingertipsR},
                                                  {"LeftUpLeg", Point::kHipL},
                                                  {"RightUpLeg", Point::kHipR},
                                                  {"LeftLeg", Point::kKneeL},
                                                  {"RightLeg", Point::kKneeR},
                                                  {"LeftShoulder", Point::kClavicleL},
                                                  {"RightShoulder", Point::kClavicleR},
                                                  {"LeftHand", Point::kWristL},
                                                  {"RightHand", Point::kWristR},
                                                  {"LeftFoot", Point::kAnkleL},
                                                  {"RightFoot", Point::kAnkleR},
                                                  {"LeftToe", Point::kBallL},
                                                  {"RightToe", Point::kBallR},
                                                  {"LeftToeEnd", Point::kToeL},
                                                  {"RightToeEnd", Point::kToeR}};
  BodyPlaces points_W;
  points_W << row.points_W, row.further_W;
  for (const auto& [name, point] : points) {
    const Vector3 m = 1e-3 * (YUpFromWorld() * points_W.col(static_cast<int>(point)));
    EXPECT_LT((places.at(name) - m).norm(), 1e-4) << name;
  }
}

TEST(GlbWriter, KeepsEveryJointInPlaceThoughWaistCollarBonesAndWristsTurn) {
  const Result result = SwingingResult(60);
  const ReadGlb glb = WriteAndRead(result);
  for (std::size_t i = 0; i < 60; ++i) {
    ExpectNodes(glb.PlacesAt(i), result.poses[i]);
    EXPECT_NEAR(glb.times()[i], 0.04 * static_cast<double>(i), 1e-6);
  }
}

TEST(GlbWriter, RaisesTheRightArmOnTheRightOfAPersonWhoFacesZ) {
  const BodyModel body = GrownBody();
  const auto places = WriteAndRead(ResultOf(body, RightArmRaised(body))).PlacesAt(0);
  EXPECT_GT(places.at("RightHandEnd").y(), places.at("Head").y() + 0.2);
  EXPECT_LT(places.at("RightHandEnd").x(), places.at("Spine").x());
  EXPECT_LT(places.at("LeftFoot").z(), places.at("LeftLeg").z() - 0.2) << "the bent knee";
  EXPECT_GT(places.at("RightToeEnd").z(), places.at("RightFoot").z() + 0.15);
}

TEST(GlbWriter, TheFootsFleshTurnsWithTheFoot) {
  const BodyModel body = GrownBody();
  PoseState pose = Standing(body);
  testing::Turn(body, "ankle_l_y", 30, pose);
  std::vector<PosedCapsule> flesh;
  body.PoseShape(body.PostureAt(pose), flesh);
  const ReadGlb glb = WriteAndRead(ResultOf(body, pose));
  const auto world = glb.NodesAt(0);
  const auto rest = WriteAndRead(ResultOf(body, Standing(body))).PlacesAt(0);
  const Vector3 torso = 1e-3 * (YUpFromWorld() * Standing(body).X_WT.p);
  int feet = 0;
  for (const MeshVertex& vertex : MakeBodyMesh(RecordOf(body)).vertices) {
    if (vertex.joint != SkeletonJoint::kLeftFoot) continue;
    ++feet;
    const Vector3 at_rest = torso + 1e-3 * (YUpFromWorld() * vertex.p_T) - rest.at("LeftFoot");
    const Vector3 m = world[static_cast<std::size_t>(SkeletonJoint::kLeftFoot)] * at_rest;
    const Vector3 p_W = 1e3 * (YUpFromWorld().transpose() * m);
    double outside_mm = 1e9;
    for (const PosedCapsule& capsule : flesh)
      outside_mm = std::min(outside_mm, std::abs(capsule.DistanceTo(p_W).outside_mm));
    EXPECT_LT(outside_mm, 10);
  }
  EXPECT_GT(feet, 100);
}

TEST(GlbWriter, JointsFollowBonesThatChangeUntilSizesHaveSettled) {
  Result result = SwingingResult(3, BodyModel(LoadBodyTable("full"), AverageSizes(1700)));
  const BodyModel settled = GrownBody();
  result.body = RecordOf(settled);
  Append(settled, Swinging(settled, 1), result);
  const ReadGlb glb = WriteAndRead(result);
  for (std::size_t i = 0; i < 4; ++i) ExpectNodes(glb.PlacesAt(i), result.poses[i]);
}

TEST(GlbWriter, HoldsThePoseInGapsAndKeepsTheTakesClock) {
  Result result = SwingingResult(6);
  result.poses[0].state = CaptureState::kAcquiring;
  result.poses[3].state = CaptureState::kLost;
  const ReadGlb glb = WriteAndRead(result);
  ASSERT_EQ(glb.times().size(), 5u);
  EXPECT_NEAR(glb.times()[0], 0.04, 1e-6);
  ExpectNodes(glb.PlacesAt(2), result.poses[2]);
  ExpectNodes(glb.PlacesAt(3), result.poses[4]);
}

TEST(GlbWriter, TheMeshIsBoundToJointsAtRest) {
  const BodyModel body = GrownBody();
  const ReadGlb glb = WriteAndRead(ResultOf(body, Standing(body)));
  const auto world = glb.NodesAt(0);
  const json& skin = glb.root()["skins"][0];
  const std::vector<float> inverse = glb.Floats(skin["inverseBindMatrices"]);
  const Vector3 torso = 1e-3 * (YUpFromWorld() * Vector3(2000, 500, 1200));
  for (std::size_t i = 0; i < skin["joints"].size(); ++i) {
    const Vector3 offset(inverse[16 * i + 12], inverse[16 * i + 13], inverse[16 * i + 14]);
    // Of somebody who stands as at rest, each joint moves the mesh in the same way.
    EXPECT_LT((world[skin["joints"][i].get<int>()] * offset - torso).norm(), 1e-4) << i;
  }
}

TEST(BodyMesh, IsTheMeasuredFleshSeenFromOutside) {
  for (const char* table : {"full", "mikic2003"}) {
    const BodyModel body = GrownBody(table);
    const BodyMesh mesh = MakeBodyMesh(RecordOf(body));
    PoseState rest = Standing(body);
    rest.X_WT.p.setZero();
    std::vector<PosedCapsule> flesh;
    body.PoseShape(body.PostureAt(rest), flesh);
    double worst_mm = 0;
    for (const MeshVertex& vertex : mesh.vertices) {
      double outside_mm = 1e9;
      for (const PosedCapsule& capsule : flesh) {
        outside_mm = std::min(outside_mm, std::abs(capsule.DistanceTo(vertex.p_T).outside_mm));
      }
      worst_mm = std::max(worst_mm, outside_mm);
      EXPECT_NEAR(vertex.normal_T.norm(), 1, 1e-6);
    }
    // What is nearest of the core is not what touches a steep taper.
    EXPECT_LT(worst_mm, 10);
    for (const auto& [a, b, c] : mesh.triangles) {
      const MeshVertex& v = mesh.vertices.at(a);
      const Vector3 normal =
          (mesh.vertices.at(b).p_T - v.p_T).cross(mesh.vertices.at(c).p_T - v.p_T);
      const Vector3 outward = v.normal_T + mesh.vertices[b].normal_T + mesh.vertices[c].normal_T;
      EXPECT_GE(normal.dot(outward), -1e-6);
    }
    EXPECT_LT(mesh.vertices.size(), 65'536u);
  }
}

TEST(BodyMesh, ItsHighestAndLowestPlacesAreTheStatureApart) {
  const BodyModel body = GrownBody();
  double low = 0, high = 0;
  for (const MeshVertex& vertex : MakeBodyMesh(RecordOf(body)).vertices) {
    low = std::min(low, vertex.p_T.z());
    high = std::max(high, vertex.p_T.z());
  }
  // Shoes and hair lie outside of the body.
  EXPECT_NEAR(high - low, 1780, 50);
}

}  // namespace
}  // namespace mocap
