#include "tools/witness/network_description.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/setup_error.h"
#include "tests/support/temporary_folder.h"

namespace mocap {
namespace {

using ::testing::HasSubstr;

constexpr const char* kHeatmapNetwork = R"(width_px = 192
height_px = 256
colors = "bgr"
mean = [1, 2.5, 3]
std = [4, 5, 6]
kind = "heatmaps"
outputs = ["maps"]
landmarks = ["nose", "-", "LShoulder"]
score = "probability"
)";

class NetworkFile : public ::testing::Test {
 protected:
  NetworkDescription Read(const std::string& from = "", const std::string& to = "") {
    testing::WriteText(file_, kHeatmapNetwork);
    testing::ReplaceInFile(file_, from, to);
    return ReadNetworkDescription(file_);
  }
  std::string Error(const std::string& from, const std::string& to) {
    return testing::SetupErrorOf([&] { Read(from, to); });
  }

  testing::TemporaryFolder folder_;
  std::filesystem::path file_ = DescriptionBeside(folder_.path() / "network.onnx");
};

TEST_F(NetworkFile, DescribesANetwork) {
  EXPECT_EQ(file_.filename(), "network.toml");
  const NetworkDescription network = Read();
  EXPECT_EQ(network.width_px, 192);
  EXPECT_EQ(network.aspect(), 0.75);
  EXPECT_FALSE(network.takes_rgb);
  EXPECT_EQ(network.mean[1], 2.5);
  EXPECT_EQ(network.std[2], 6);
  EXPECT_EQ(network.kind, AnswerKind::kHeatmaps);
  ASSERT_EQ(network.landmarks.size(), 3u);
  EXPECT_EQ(network.landmarks[0], Landmark::kNose);
  EXPECT_EQ(network.landmarks[1], std::nullopt);
  EXPECT_EQ(network.landmarks[2], Landmark::kShoulderL);
  EXPECT_FALSE(network.scores_are_logits);
  const NetworkDescription coordinates = Read(
      R"(kind = "heatmaps")", "kind = \"coordinates\"\ncolumns = [\"x\", \"y\", \"score\", \"-\"]");
  EXPECT_EQ(coordinates.columns.size(), 4u);
}

TEST_F(NetworkFile, SaysWhatIsWrong) {
  EXPECT_THAT(Error("\"-\"", "\"left_thmb\""), HasSubstr("network.toml:8: landmarks has"));
  EXPECT_THAT(Error("\"-\"", "\"left_shoulder\""), HasSubstr("shoulder_l a second time"));
  EXPECT_THAT(Error("[4, 5, 6]", "[4, 0, 6]"), HasSubstr("std is not positive"));
  EXPECT_THAT(Error("[\"maps\"]", "[]"), HasSubstr("one output"));
  EXPECT_THAT(Error("heatmaps", "simcc"), HasSubstr("two outputs"));
  EXPECT_THAT(Error("heatmaps", "coordinates"), HasSubstr("columns"));
  EXPECT_THAT(Error("score", "scores"), HasSubstr("score"));
  EXPECT_THAT(Error("score =", "colour = 1\nscore ="), HasSubstr("colour"));
  EXPECT_THAT(Error("192", "1"), HasSubstr("width_px"));
  EXPECT_THAT(Error("score =", "columns = [\"x\", \"y\"]\nscore ="), HasSubstr("columns"));
}

TEST(NetworkDescription, KnowsTheLandmarksOfWellKnownNetworks) {
  const NetworkDescription blazepose = BlazePoseDescription("points", "presence");
  ASSERT_EQ(blazepose.landmarks.size(), 39u);
  EXPECT_EQ(std::ranges::count(blazepose.landmarks, std::optional<Landmark>()), 6 + 6);
  EXPECT_EQ(blazepose.landmarks[11], Landmark::kShoulderL);
  EXPECT_EQ(blazepose.landmarks[21], std::nullopt) << "a thumb";
  EXPECT_EQ(blazepose.landmarks[32], Landmark::kBigToeR);
  EXPECT_EQ(RtmPoseDescription(17, 192, 256).landmarks.back(), Landmark::kAnkleR);
  const NetworkDescription halpe = RtmPoseDescription(26, 192, 256);
  ASSERT_EQ(halpe.landmarks.size(), 26u);
  EXPECT_EQ(std::ranges::count(halpe.landmarks, std::optional<Landmark>()), 0);
  EXPECT_EQ(halpe.landmarks[19], Landmark::kHipMiddle);
  EXPECT_EQ(halpe.landmarks.back(), Landmark::kHeelR);
  const NetworkDescription whole = RtmPoseDescription(133, 288, 384);
  ASSERT_EQ(whole.landmarks.size(), 133u);
  EXPECT_EQ(whole.landmarks[19], Landmark::kHeelL);
  EXPECT_EQ(whole.landmarks[96], Landmark::kIndexL);
  EXPECT_EQ(whole.landmarks[60], std::nullopt) << "a point of the face";
}

}  // namespace
}  // namespace mocap
