#include "tools/results/bvh_writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <sstream>
#include <string>

#include "core/errors.h"

namespace mocap {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

// A reader of BVH that knows nothing of the writer: what an animation program would do.
struct ReadNode {
  std::string name;
  int parent;
  Eigen::Vector3d offset;
  std::vector<std::string> channels;
};

struct ReadBvh {
  std::vector<ReadNode> nodes;
  std::vector<std::vector<double>> frames;
  double frame_time = 0;
};

ReadBvh Parse(const std::string& text) {
  std::istringstream in(text);
  ReadBvh bvh;
  std::vector<int> open;
  std::string word, name;
  while (in >> word && word != "MOTION") {
    if (word == "ROOT" || word == "JOINT") in >> name;
    if (word == "End") {
      in >> word;
      name = bvh.nodes.back().name + "_end";
    }
    if (word == "{") {
      bvh.nodes.push_back({name, open.empty() ? -1 : open.back(), {}, {}});
      open.push_back(static_cast<int>(bvh.nodes.size()) - 1);
    }
    if (word == "}") open.pop_back();
    if (word == "OFFSET") {
      for (double& value : bvh.nodes.back().offset) in >> value;
    }
    if (word == "CHANNELS") {
      int count = 0;
      in >> count;
      for (; count > 0; --count) in >> bvh.nodes.back().channels.emplace_back();
    }
  }
  std::size_t frame_count = 0, width = 0;
  in >> word >> frame_count >> word >> word >> bvh.frame_time;
  for (const ReadNode& node : bvh.nodes) width += node.channels.size();
  bvh.frames.assign(frame_count, std::vector<double>(width));
  for (std::vector<double>& frame : bvh.frames) {
    for (double& value : frame) EXPECT_TRUE(in >> value);
  }
  EXPECT_FALSE(in >> word) << "more numbers than channels";
  return bvh;
}

/// Places of all joints and end sites [cm].
std::map<std::string, Eigen::Vector3d> PlacesAt(const ReadBvh& bvh, std::size_t frame) {
  std::vector<Eigen::Isometry3d> world;
  std::map<std::string, Eigen::Vector3d> places;
  auto value = bvh.frames[frame].begin();
  for (const ReadNode& node : bvh.nodes) {
    Eigen::Isometry3d X = node.parent < 0 ? Eigen::Isometry3d::Identity() : world[node.parent];
    X.translate(node.offset);
    for (const std::string& channel : node.channels) {
      const Eigen::Vector3d axis(channel[0] == 'X', channel[0] == 'Y', channel[0] == 'Z');
      if (channel.ends_with("position")) X.translate(*value * axis);
      if (channel.ends_with("rotation")) X.rotate(Eigen::AngleAxisd(*value * kDegree, axis));
      ++value;
    }
    world.push_back(X);
    places[node.name] = X.translation();
  }
  return places;
}

void Put(PoseRow& row, Point point, const Vector3& p_W) {
  row.points_W.col(static_cast<int>(point)) = p_W;
}

/// Faces world +x; the right arm is raised straight up, the left one hangs down.
PoseRow RightArmRaised() {
  PoseRow row;
  row.state = CaptureState::kTracking;
  row.has_pose = true;
  Put(row, Point::kTorso, {1000, 500, 1200});
  Put(row, Point::kNeck, {1000, 500, 1500});
  Put(row, Point::kHead, {1000, 500, 1650});
  Put(row, Point::kShoulderL, {1000, 700, 1450});
  Put(row, Point::kElbowL, {1000, 700, 1150});
  Put(row, Point::kFingertipsL, {1000, 700, 750});
  Put(row, Point::kShoulderR, {1000, 300, 1450});
  Put(row, Point::kElbowR, {1000, 300, 1750});
  Put(row, Point::kFingertipsR, {1000, 300, 2150});
  Put(row, Point::kHipL, {1000, 600, 900});
  Put(row, Point::kKneeL, {1000, 600, 480});
  Put(row, Point::kFootL, {1000, 600, 30});
  Put(row, Point::kHipR, {1000, 400, 900});
  Put(row, Point::kKneeR, {1000, 400, 480});
  Put(row, Point::kFootR, {1000, 400, 30});
  return row;
}

Result ResultOf(std::vector<PoseRow> poses) {
  Result result;
  result.body.sizes.head = 240;
  result.poses = std::move(poses);
  for (std::size_t i = 0; i < result.poses.size(); ++i) {
    result.poses[i].timestamp_ns = 1'000'000'000 + 40'000'000 * static_cast<std::int64_t>(i);
  }
  return result;
}

ReadBvh WriteAndParse(const Result& result) {
  std::ostringstream text;
  WriteBvh(MakeBvhMotion(result), text);
  return Parse(text.str());
}

void ExpectPlace(const std::map<std::string, Eigen::Vector3d>& places, const std::string& name,
                 const Eigen::Vector3d& cm) {
  ASSERT_TRUE(places.contains(name)) << name;
  EXPECT_LT((places.at(name) - cm).norm(), 0.05)
      << name << " is at " << places.at(name).transpose() << " cm, wanted " << cm.transpose();
}

TEST(BvhWriter, RaisesTheRightArmOnTheRightOfAPersonWhoFacesWorldX) {
  const auto places = PlacesAt(WriteAndParse(ResultOf({RightArmRaised()})), 0);
  // y up; world x, where the person looks, is z; the person's left, world y, is x.
  ExpectPlace(places, "Hips", {50, 90, 100});
  ExpectPlace(places, "Spine", {50, 120, 100});
  ExpectPlace(places, "Head", {50, 165, 100});
  ExpectPlace(places, "Head_end", {50, 177, 100});
  ExpectPlace(places, "RightArm", {30, 145, 100});
  ExpectPlace(places, "RightForeArm", {30, 175, 100});
  ExpectPlace(places, "RightForeArm_end", {30, 215, 100});
  ExpectPlace(places, "LeftArm", {70, 145, 100});
  ExpectPlace(places, "LeftForeArm_end", {70, 75, 100});
  ExpectPlace(places, "LeftLeg_end", {60, 3, 100});
  ExpectPlace(places, "RightLeg_end", {40, 3, 100});
}

TEST(BvhWriter, RestsWithTheArmsOutAndFacesZ) {
  ReadBvh bvh = WriteAndParse(ResultOf({RightArmRaised()}));
  std::ranges::fill(bvh.frames[0], 0);
  const auto places = PlacesAt(bvh, 0);
  ExpectPlace(places, "LeftForeArm_end", {20 + 70, 55, 0});
  ExpectPlace(places, "RightForeArm_end", {-20 - 70, 55, 0});
  ExpectPlace(places, "LeftLeg_end", {10, -87, 0});
}

/// A moving body with a waist: everything above turns against the pelvis about the torso's
/// centroid.
PoseRow Moving(double time) {
  const PoseRow rest = RightArmRaised();
  PoseRow row = rest;
  const auto p = [&](Point point) -> Vector3 { return rest.points_W.col(static_cast<int>(point)); };
  const Matrix3 R_pelvis = ExpRotation({0.3 * std::sin(time), 0.2, 2 * time});
  const Matrix3 R_torso = R_pelvis * ExpRotation({0.2 * std::cos(time), 0.4 * std::sin(time),
                                                  0.7 * std::sin(3 * time)});
  const Vector3 spine = p(Point::kTorso) + Vector3(300 * time, 80 * std::sin(time), 20 * time);
  const auto carry = [&](const Matrix3& R, Point from, Point to) {
    const Vector3 start = row.points_W.col(static_cast<int>(from));
    Put(row, to, start + R * (p(to) - p(from)));
  };
  const Matrix3 arm = R_torso * ExpRotation({0.9 * std::sin(time), -0.8, 0.3});
  const Matrix3 leg = R_pelvis * ExpRotation({0.2, -1.2 * std::sin(time), 0});
  const Matrix3 bend = ExpRotation({0, 1 + std::sin(time), 0});
  Put(row, Point::kTorso, spine);
  carry(R_torso, Point::kTorso, Point::kNeck);
  carry(R_torso * ExpRotation({0.2, 0.3, 0}), Point::kNeck, Point::kHead);
  carry(R_torso, Point::kTorso, Point::kShoulderL);
  carry(R_torso, Point::kTorso, Point::kShoulderR);
  carry(R_pelvis, Point::kTorso, Point::kHipL);
  carry(R_pelvis, Point::kTorso, Point::kHipR);
  carry(arm, Point::kShoulderL, Point::kElbowL);
  carry(arm * bend, Point::kElbowL, Point::kFingertipsL);
  carry(R_torso, Point::kShoulderR, Point::kElbowR);
  carry(R_torso * bend, Point::kElbowR, Point::kFingertipsR);
  carry(leg, Point::kHipL, Point::kKneeL);
  carry(leg * bend, Point::kKneeL, Point::kFootL);
  carry(R_pelvis, Point::kHipR, Point::kKneeR);
  carry(R_pelvis * bend, Point::kKneeR, Point::kFootR);
  const Vector3 rotation = LogRotation(R_torso);
  row.paper.torso_angle_rad = rotation.norm();
  row.paper.torso_axis = rotation.normalized();
  return row;
}

Result MovingResult(int frames) {
  std::vector<PoseRow> rows;
  for (int i = 0; i < frames; ++i) rows.push_back(Moving(0.1 * i));
  return ResultOf(rows);
}

TEST(BvhWriter, KeepsEveryJointInPlaceThoughTheWaistTurns) {
  const Result result = MovingResult(60);
  const ReadBvh bvh = WriteAndParse(result);
  const std::map<std::string, Point> points = {{"Spine", Point::kTorso},
                                               {"Neck", Point::kNeck},
                                               {"Head", Point::kHead},
                                               {"LeftArm", Point::kShoulderL},
                                               {"RightArm", Point::kShoulderR},
                                               {"LeftForeArm", Point::kElbowL},
                                               {"RightForeArm", Point::kElbowR},
                                               {"LeftForeArm_end", Point::kFingertipsL},
                                               {"RightForeArm_end", Point::kFingertipsR},
                                               {"LeftUpLeg", Point::kHipL},
                                               {"RightUpLeg", Point::kHipR},
                                               {"LeftLeg", Point::kKneeL},
                                               {"RightLeg", Point::kKneeR},
                                               {"LeftLeg_end", Point::kFootL},
                                               {"RightLeg_end", Point::kFootR}};
  for (std::size_t i = 0; i < result.poses.size(); ++i) {
    const auto places = PlacesAt(bvh, i);
    for (const auto& [name, point] : points) {
      const Vector3 p_W = result.poses[i].points_W.col(static_cast<int>(point));
      ExpectPlace(places, name, Eigen::Vector3d(p_W.y(), p_W.z(), p_W.x()) / 10);
    }
  }
}

TEST(BvhWriter, HasNoJumpsInItsCurves) {
  const ReadBvh bvh = WriteAndParse(MovingResult(60));
  for (std::size_t i = 1; i < bvh.frames.size(); ++i) {
    for (std::size_t c = 3; c < bvh.frames[i].size(); ++c) {
      EXPECT_LT(std::abs(bvh.frames[i][c] - bvh.frames[i - 1][c]), 90) << "channel " << c;
    }
  }
}

TEST(BvhWriter, GivesTheFrameTime) {
  EXPECT_NEAR(WriteAndParse(MovingResult(5)).frame_time, 0.04, 1e-6);
}

TEST(BvhMotion, SkipsWhatComesBeforeTrackingAndHoldsThePoseInGaps) {
  Result result = MovingResult(6);
  result.poses[0].state = CaptureState::kAcquiring;
  result.poses[3].state = CaptureState::kLost;
  const BvhMotion motion = MakeBvhMotion(result);
  EXPECT_EQ(motion.skipped_frames, 1);
  EXPECT_EQ(motion.held_frames, 1);
  ASSERT_EQ(motion.frames.size(), 5u);
  EXPECT_EQ(motion.frames[2].p_WHips, motion.frames[1].p_WHips);
  EXPECT_NE(motion.frames[3].p_WHips, motion.frames[1].p_WHips);
}

TEST(BvhMotion, KeepsTimeThoughFramesAreMissing) {
  Result result = MovingResult(20);
  // Jitter of a few milliseconds, and three frames gone.
  for (std::size_t i = 0; i < 20; ++i) result.poses[i].timestamp_ns += i % 3 * 2'000'000;
  result.poses.erase(result.poses.begin() + 8, result.poses.begin() + 11);
  const BvhMotion motion = MakeBvhMotion(result);
  EXPECT_EQ(motion.held_frames, 3);
  ASSERT_EQ(motion.frames.size(), 20u);
  EXPECT_NEAR(motion.period_s, 0.04, 0.0002);
  EXPECT_EQ(motion.frames[10].p_WHips, motion.frames[7].p_WHips);
  EXPECT_NE(motion.frames[11].p_WHips, motion.frames[7].p_WHips);
}

TEST(BvhMotion, SaysHowFarJointsAreOffWhenBonesChange) {
  Result result = MovingResult(5);
  EXPECT_LT(MakeBvhMotion(result).worst_mm, 1e-6);
  Put(result.poses[2], Point::kFootL,
      result.poses[2].points_W.col(static_cast<int>(Point::kKneeL)) + Vector3(0, 0, -470));
  EXPECT_NEAR(MakeBvhMotion(result).worst_mm, 20, 1e-6);
}

TEST(BvhMotion, RefusesAPauseThatWouldFillTheMemory) {
  Result result = MovingResult(9);
  result.poses[8].timestamp_ns = std::int64_t{1} << 60;
  EXPECT_THROW(MakeBvhMotion(result), SetupError);
}

TEST(BvhMotion, RefusesAResultWithoutATrackedFrame) {
  Result result = MovingResult(2);
  for (PoseRow& row : result.poses) row.state = CaptureState::kSearching;
  EXPECT_THROW(MakeBvhMotion(result), SetupError);
}

}  // namespace
}  // namespace mocap
