#include "tools/interchange/bvh_writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <sstream>
#include <string>

#include "core/errors.h"
#include "tests/support/moving_body.h"
#include "tools/interchange/skeleton_motion.h"

namespace mocap {
namespace {

using testing::Append;
using testing::GrownBody;
using testing::ResultOf;
using testing::RightArmRaised;
using testing::Standing;
using testing::Swinging;
using testing::SwingingResult;
using testing::TrackedRow;

constexpr double kBvhDegree = std::numbers::pi / 180;

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
      if (channel.ends_with("rotation")) X.rotate(Eigen::AngleAxisd(*value * kBvhDegree, axis));
      ++value;
    }
    world.push_back(X);
    places[node.name] = X.translation();
  }
  return places;
}

ReadBvh WriteAndParse(const Result& result) {
  const ExportSubject subject{"", result};
  std::ostringstream text;
  WriteBvh({std::span(&subject, 1), result.poses, "walk.bvh"}, text);
  return Parse(text.str());
}

/// What a joint or end is at: y up; world x is z, and world y, the left of who faces x, is x.
const std::map<std::string, Point>& Points() {
  static const std::map<std::string, Point> points = {{"Spine", Point::kTorso},
                                                      {"Neck", Point::kNeck},
                                                      {"Head", Point::kHead},
                                                      {"LeftArm", Point::kShoulderL},
                                                      {"RightArm", Point::kShoulderR},
                                                      {"LeftForeArm", Point::kElbowL},
                                                      {"RightForeArm", Point::kElbowR},
                                                      {"LeftHand_end", Point::kFingertipsL},
                                                      {"RightHand_end", Point::kFingertipsR},
                                                      {"LeftUpLeg", Point::kHipL},
                                                      {"RightUpLeg", Point::kHipR},
                                                      {"LeftLeg", Point::kKneeL},
                                                      {"RightLeg", Point::kKneeR},
                                                      {"LeftLeg_end", Point::kFootL},
                                                      {"RightLeg_end", Point::kFootR}};
  return points;
}

void ExpectPlaces(const std::map<std::string, Eigen::Vector3d>& places, const PoseRow& row) {
  for (const auto& [name, point] : Points()) {
    ASSERT_TRUE(places.contains(name)) << name;
    const Vector3 p_W = row.points_W.col(static_cast<int>(point));
    const Eigen::Vector3d cm = Eigen::Vector3d(p_W.y(), p_W.z(), p_W.x()) / 10;
    EXPECT_LT((places.at(name) - cm).norm(), 0.01)
        << name << " is at " << places.at(name).transpose() << " cm, wanted " << cm.transpose();
  }
}

TEST(BvhWriter, RaisesTheRightArmOnTheRightOfAPersonWhoFacesWorldX) {
  const BodyModel body = GrownBody();
  const Result result = ResultOf(body, RightArmRaised(body));
  const auto places = PlacesAt(WriteAndParse(result), 0);
  ExpectPlaces(places, result.poses[0]);
  EXPECT_GT(places.at("RightHand_end").y(), places.at("Head_end").y() + 20);
  EXPECT_LT(places.at("LeftHand_end").y(), places.at("Hips").y());
  EXPECT_LT(places.at("RightHand_end").x(), 40) << "the middle of the body is at 50 cm";
  EXPECT_GT(places.at("LeftHand_end").x(), 60);
  EXPECT_LT(places.at("LeftLeg_end").z(), places.at("LeftLeg").z() - 20) << "the bent knee";
}

TEST(BvhWriter, RestsWithTheArmsOutAndFacesZ) {
  const BodyModel body = GrownBody();
  ReadBvh bvh = WriteAndParse(ResultOf(body, RightArmRaised(body)));
  std::ranges::fill(bvh.frames[0], 0);
  PoseRow rest = TrackedRow(body, Standing(body));
  rest.points_W.colwise() -= (rest.points_W.col(static_cast<int>(Point::kHipL)) +
                              rest.points_W.col(static_cast<int>(Point::kHipR))) /
                             2;
  ExpectPlaces(PlacesAt(bvh, 0), rest);
}

TEST(BvhWriter, KeepsEveryJointInPlaceThoughWaistCollarBonesAndWristsTurn) {
  for (const char* table : {"full", "mikic2003"}) {
    const Result result = SwingingResult(60, GrownBody(table));
    const ReadBvh bvh = WriteAndParse(result);
    for (std::size_t i = 0; i < result.poses.size(); ++i) {
      ExpectPlaces(PlacesAt(bvh, i), result.poses[i]);
    }
  }
}

TEST(BvhWriter, HasNoJumpsInItsCurves) {
  const ReadBvh bvh = WriteAndParse(SwingingResult(60));
  for (std::size_t i = 1; i < bvh.frames.size(); ++i) {
    for (std::size_t c = 3; c < bvh.frames[i].size(); ++c) {
      EXPECT_LT(std::abs(bvh.frames[i][c] - bvh.frames[i - 1][c]), 170) << "channel " << c;
    }
  }
}

TEST(BvhWriter, GivesTheFrameTime) {
  EXPECT_NEAR(WriteAndParse(SwingingResult(5)).frame_time, 0.04, 1e-6);
}

TEST(SkeletonMotion, SkipsWhatComesBeforeTrackingAndHoldsThePoseInGaps) {
  Result result = SwingingResult(6);
  result.poses[0].state = CaptureState::kAcquiring;
  result.poses[3].state = CaptureState::kLost;
  const SkeletonMotion motion = MakeSkeletonMotion(result);
  EXPECT_EQ(motion.skipped_frames, 1);
  EXPECT_EQ(motion.held_frames, 1);
  ASSERT_EQ(motion.frames.size(), 5u);
  EXPECT_EQ(motion.frames[2].offset[0], motion.frames[1].offset[0]);
  EXPECT_NE(motion.frames[3].offset[0], motion.frames[1].offset[0]);
  for (int i = 0; i < 5; ++i) EXPECT_EQ(motion.frames[i].time_ns, result.poses[i + 1].timestamp_ns);
}

TEST(SkeletonMotion, KeepsTimeThoughFramesAreMissing) {
  Result result = SwingingResult(20);
  // Jitter of a few milliseconds, and three frames gone.
  for (std::size_t i = 0; i < 20; ++i) result.poses[i].timestamp_ns += i % 3 * 2'000'000;
  result.poses.erase(result.poses.begin() + 8, result.poses.begin() + 11);
  const SkeletonMotion motion = MakeSkeletonMotion(result);
  EXPECT_EQ(motion.held_frames, 3);
  ASSERT_EQ(motion.frames.size(), 20u);
  EXPECT_NEAR(motion.period_s, 0.04, 0.0002);
  EXPECT_EQ(motion.frames[10].offset[0], motion.frames[7].offset[0]);
  EXPECT_NE(motion.frames[11].offset[0], motion.frames[7].offset[0]);
  for (int i = 1; i < 20; ++i) EXPECT_GT(motion.frames[i].time_ns, motion.frames[i - 1].time_ns);
}

TEST(SkeletonMotion, SaysHowFarJointsAreOffWhenBonesChange) {
  Result result = SwingingResult(5);
  EXPECT_LT(MakeSkeletonMotion(result).worst_mm, 1e-6);
  const int knee = static_cast<int>(Point::kKneeL), foot = static_cast<int>(Point::kFootL);
  Vector3 calf = result.poses[2].points_W.col(foot) - result.poses[2].points_W.col(knee);
  result.poses[2].points_W.col(foot) += 20 * calf.normalized();
  EXPECT_NEAR(MakeSkeletonMotion(result).worst_mm, 20, 1e-6);
}

TEST(SkeletonMotion, HasTheBonesThatTheSizesSettledOn) {
  Result result = SwingingResult(3, BodyModel(LoadBodyTable("full"), AverageSizes(1700)));
  const BodyModel settled = GrownBody();
  result.body = RecordOf(settled);
  Append(settled, Swinging(settled, 1), result);
  const SkeletonMotion motion = MakeSkeletonMotion(result);
  EXPECT_NEAR(motion.bones[static_cast<int>(SkeletonJoint::kLeftLeg)].norm(), settled.sizes().thigh,
              1e-6);
  EXPECT_GT(motion.worst_mm, 10);
}

TEST(SkeletonMotion, RefusesAPauseThatWouldFillTheMemory) {
  Result result = SwingingResult(9);
  result.poses[8].timestamp_ns = std::int64_t{1} << 60;
  EXPECT_THROW(MakeSkeletonMotion(result), SetupError);
}

TEST(SkeletonMotion, RefusesAResultWithoutATrackedFrame) {
  Result result = SwingingResult(2);
  for (PoseRow& row : result.poses) row.state = CaptureState::kSearching;
  EXPECT_THROW(MakeSkeletonMotion(result), SetupError);
}

}  // namespace
}  // namespace mocap
