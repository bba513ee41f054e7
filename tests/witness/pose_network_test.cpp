#include "tools/witness/pose_network.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "tests/support/setup_error.h"
#include "tests/support/temporary_folder.h"
#include "tests/witness/onnx_bytes.h"
#include "tools/witness/self_test.h"

namespace mocap {
namespace {

using ::testing::HasSubstr;

const std::filesystem::path kBlazePoseFile =
    std::filesystem::path(MOCAP_SHARED_DIR) / "witness/full.onnx";

class TinyNetwork : public ::testing::Test {
 protected:
  void Write(const std::string& model, const std::string& description) {
    testing::WriteText(file_, model);
    if (!description.empty()) testing::WriteText(DescriptionBeside(file_), description);
  }
  void WriteColorMaps() { Write(testing::ColorMapNetwork(), testing::kColorMapDescription); }
  std::string Error() {
    return testing::SetupErrorOf([&] { PoseNetwork network(file_); });
  }
  std::string ErrorWith(const std::string& from, const std::string& to) {
    WriteColorMaps();
    testing::ReplaceInFile(DescriptionBeside(file_), from, to);
    return Error();
  }

  testing::TemporaryFolder folder_;
  std::filesystem::path file_ = folder_.path() / "tiny.onnx";
};

TEST_F(TinyNetwork, FindsPointsInThePicture) {
  WriteColorMaps();
  PoseNetwork network(file_);
  Image<Bgr> picture(200, 100, {40, 40, 40});
  // Each pixel of the crop is one of the picture, whose corner is at (90, 80).
  picture(100, 85) = {0, 0, 255};
  picture(92, 99) = {0, 200, 0};
  const PictureRegion region{.middle_px = {105.5, 95.5}, .width_px = 32, .height_px = 32};
  const std::vector<Keypoint> points = network.Find(picture.view(), region);
  ASSERT_EQ(points.size(), 2u);
  EXPECT_EQ(points[0].landmark, Landmark::kNose);
  EXPECT_LT((points[0].px - Eigen::Vector2f(100, 85)).norm(), 1e-3);
  EXPECT_NEAR(points[0].score, 1, 1e-3);
  EXPECT_EQ(points[1].landmark, Landmark::kNeck);
  EXPECT_LT((points[1].px - Eigen::Vector2f(92, 99)).norm(), 0.3);
}

TEST_F(TinyNetwork, FindsPointsInATurnedPicture) {
  WriteColorMaps();
  PoseNetwork network(file_);
  Image<Bgr> picture(64, 64, {40, 40, 40});
  picture(20, 40) = {0, 0, 255};
  for (int turns = 0; turns < 4; ++turns) {
    const PictureRegion region{
        .middle_px = {31.5, 31.5}, .width_px = 32, .height_px = 32, .turns = turns};
    const std::vector<Keypoint> points = network.Find(picture.view(), region);
    EXPECT_LT((points[0].px - Eigen::Vector2f(20, 40)).norm(), 1e-3) << turns;
  }
}

TEST_F(TinyNetwork, SaysWhatDoesNotFit) {
  EXPECT_THAT(Error(), HasSubstr("tiny.onnx: not found"));
  Write("no network", "");
  EXPECT_THAT(Error(), HasSubstr("tiny.onnx: OpenCV cannot read it"));
  Write(testing::ColorMapNetwork(), "");
  EXPECT_THAT(Error(), HasSubstr("expected a description of its input and outputs in"));
  EXPECT_THAT(ErrorWith("[\"maps\"]", "[\"mops\"]"),
              HasSubstr("has no output \"mops\"; did you mean maps?"));
  EXPECT_THAT(ErrorWith("\"neck\"", "\"neck\", \"-\""),
              HasSubstr("its output maps is 1 x 2 x 32 x 32; expected 1 x 3 x height x width"));
  EXPECT_THAT(ErrorWith("heatmaps\"", "coordinates\"\ncolumns = [\"x\", \"y\"]"),
              HasSubstr("expected 2 x 2 numbers"));
  EXPECT_THAT(ErrorWith("score =", "presence = \"maps\"\nscore ="),
              HasSubstr("expected one number"));
}

TEST_F(TinyNetwork, IsKnownAsRtmPoseByItsOutputs) {
  Write(testing::StillRtmPose(17), "");
  PoseNetwork network(file_);
  EXPECT_EQ(network.description().kind, AnswerKind::kSimcc);
  EXPECT_EQ(network.description().width_px, 192);
  const Image<Bgr> picture(192, 256);
  const std::vector<Keypoint> points =
      network.Find(picture.view(), {.middle_px = {95.5, 127.5}, .width_px = 192, .height_px = 256});
  ASSERT_EQ(points.size(), 17u);
  EXPECT_EQ(points[5].landmark, Landmark::kShoulderL);
  EXPECT_LT((points[5].px - Eigen::Vector2f(20, 10)).norm(), 1e-3);
  EXPECT_EQ(points[5].score, 0.5f);
  EXPECT_THAT(testing::SetupErrorOf([&] { RequireGoodAnswers(network, file_); }),
              HasSubstr("joints that it finds"));
}

TEST_F(TinyNetwork, MustFollowThePicture) {
  WriteColorMaps();
  PoseNetwork network(file_);
  EXPECT_EQ(testing::SetupErrorOf([&] { RequireGoodAnswers(network, file_); }),
            "nothing was thrown");
  // Always at the same place of the crop.
  std::string still = testing::kColorMapDescription;
  still.replace(still.find("[255, 255, 255]"), 15, "[1e9, 1e9, 1e9]");
  still.replace(still.find("probability"), 11, "logit");
  testing::OnnxGraph graph;
  std::vector<float> ramp(32 * 32 * 2);
  for (std::size_t i = 0; i < ramp.size(); ++i) ramp[i] = static_cast<float>(i % 700);
  graph.AddInput("picture", {1, 3, 32, 32});
  graph.AddConstant("weights", {2, 3, 1, 1}, std::vector<float>(6, 0));
  graph.AddConstant("ramp", {1, 2, 32, 32}, ramp);
  graph.AddNode("Conv", {"picture", "weights"}, "nothing", {{"kernel_shape", {1, 1}}});
  graph.AddNode("Add", {"nothing", "ramp"}, "maps");
  graph.AddOutput("maps", {1, 2, 32, 32});
  Write(graph.Model(), still);
  PoseNetwork stiff(file_);
  EXPECT_THAT(testing::SetupErrorOf([&] { RequireGoodAnswers(stiff, file_); }),
              HasSubstr("is cut out elsewhere"));
}

TEST_F(TinyNetwork, HasNoPointsWithoutFiniteNumbers) {
  testing::OnnxGraph graph;
  const float infinite = std::numeric_limits<float>::infinity();
  graph.AddInput("picture", {1, 3, 32, 32});
  graph.AddConstant("weights", {2, 3, 1, 1}, std::vector<float>(6, 1));
  graph.AddConstant("bias", {2}, std::vector<float>{0, infinite});
  graph.AddNode("Conv", {"picture", "weights", "bias"}, "maps", {{"kernel_shape", {1, 1}}});
  graph.AddOutput("maps", {1, 2, 32, 32});
  Write(graph.Model(), testing::kColorMapDescription);
  PoseNetwork network(file_);
  EXPECT_THAT(testing::SetupErrorOf([&] { RequireGoodAnswers(network, file_); }),
              HasSubstr("numbers that are not finite"));
}

TEST_F(TinyNetwork, LeavesOutPointsThatAreFarOutside) {
  testing::OnnxGraph graph;
  graph.AddInput("picture", {1, 3, 32, 32});
  graph.AddConstant("weights", {4, 3, 32, 32}, std::vector<float>(4 * 3 * 32 * 32, 0));
  graph.AddConstant("bias", {4}, std::vector<float>{-31, 63, 1e30f, 0});
  graph.AddNode("Conv", {"picture", "weights", "bias"}, "maps", {{"kernel_shape", {32, 32}}});
  graph.AddOutput("maps", {1, 4, 1, 1});
  Write(graph.Model(), testing::kColorMapDescription);
  testing::ReplaceInFile(DescriptionBeside(file_), "heatmaps\"",
                         "coordinates\"\ncolumns = [\"x\", \"y\"]");
  PoseNetwork network(file_);
  const Image<Bgr> picture(32, 32);
  const std::vector<Keypoint> points =
      network.Find(picture.view(), {.middle_px = {15.5, 15.5}, .width_px = 32, .height_px = 32});
  ASSERT_EQ(points.size(), 1u);
  EXPECT_EQ(points[0].landmark, Landmark::kNose);
  EXPECT_LT((points[0].px - Eigen::Vector2f(-31.5f, 62.5f)).norm(), 1e-3);
}

TEST(BlazePose, FindsThePersonOfTheSelfTest) {
  if (!std::filesystem::exists(kBlazePoseFile)) GTEST_SKIP() << "needs " << kBlazePoseFile;
  PoseNetwork network(kBlazePoseFile);
  EXPECT_EQ(network.description().landmarks.size(), 39u);
  RequireGoodAnswers(network, kBlazePoseFile);
  const KnownPicture known = PaintKnownPicture();
  ASSERT_EQ(known.joints.size(), 12u);
  const PictureRegion region = RegionAround(known.box, 1);
  const std::vector<Keypoint> points = network.Find(known.picture.view(), region);
  for (const Keypoint& joint : known.joints) {
    const auto found = std::ranges::find(points, joint.landmark, &Keypoint::landmark);
    ASSERT_NE(found, points.end());
    EXPECT_LT((found->px - joint.px).norm(), 0.05 * region.height_px) << NameOf(joint.landmark);
    EXPECT_GT(found->score, 0.3) << NameOf(joint.landmark);
  }
}

}  // namespace
}  // namespace mocap
