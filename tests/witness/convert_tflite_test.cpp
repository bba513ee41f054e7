#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>

#include "daemon/base/other_program.h"
#include "tests/support/temporary_folder.h"
#include "tests/witness/onnx_bytes.h"
#include "tests/witness/tflite_bytes.h"
#include "tools/witness/fetch_model.h"
#include "tools/witness/pose_network.h"

namespace mocap {
namespace {

using ::testing::HasSubstr;

constexpr ProgramLimits kConverterLimits{.patience = std::chrono::seconds(60),
                                         .longest_output = 1000};
constexpr const char* kDebianPython = "/usr/bin/python3";

class TfliteConverter : public ::testing::Test {
 protected:
  void SetUp() override {
    const ProgramRun run =
        RunOtherProgram({kDebianPython, "-c", "import numpy"}, "", kConverterLimits);
    if (run.number != 0 || run.end != ProgramRun::End::kExited)
      GTEST_SKIP() << "needs python3-numpy";
    testing::WriteText(folder_.path() / "convert.py", kTfliteConverter);
  }
  ProgramRun Convert(const std::string& network, const std::string& size) {
    testing::WriteText(folder_.path() / "in.tflite", network);
    return RunOtherProgram({kDebianPython, (folder_.path() / "convert.py").string(),
                            (folder_.path() / "in.tflite").string(), model_.string(), size},
                           "", kConverterLimits);
  }

  testing::TemporaryFolder folder_;
  const std::filesystem::path model_ = folder_.path() / "out.onnx";
};

TEST_F(TfliteConverter, KeepsWhatAConvolutionComputes) {
  const ProgramRun run = Convert(testing::ConvolutionAsTflite(), "512");
  ASSERT_EQ(run.number, 0) << run.last_words;
  testing::WriteText(DescriptionBeside(model_), testing::kColorMapDescription);
  testing::ReplaceInFile(DescriptionBeside(model_), "\"maps\"", "\"t3\"");
  PoseNetwork network(model_);
  Image<Bgr> picture(32, 32);
  picture(11, 5) = {0, 0, 255};
  picture(31, 31) = {0, 204, 0};
  const std::vector<Keypoint> points =
      network.Find(picture.view(), {.middle_px = {15.5, 15.5}, .width_px = 32, .height_px = 32});
  ASSERT_EQ(points.size(), 2u);
  // Cells stand for the pixels at their left upper corner.
  EXPECT_EQ(points[0].px, Eigen::Vector2f(10, 4));
  EXPECT_NEAR(points[0].score, 0.75, 1e-6);
  EXPECT_EQ(points[1].px, Eigen::Vector2f(30, 30));
  EXPECT_NEAR(points[1].score, 0.55, 1e-6);
}

TEST_F(TfliteConverter, RefusesWhatItDoesNotKnow) {
  constexpr int kFullyConnected = 9;
  EXPECT_THAT(Convert(testing::ConvolutionAsTflite(kFullyConnected), "512").last_words,
              HasSubstr("in.tflite: has the operator number 9, which is not known here"));
  EXPECT_THAT(Convert(testing::ConvolutionAsTflite(), "195").last_words,
              HasSubstr("has not one output for each of the sizes [195]"));
  const std::string whole = testing::ConvolutionAsTflite();
  EXPECT_THAT(Convert(whole.substr(0, whole.size() / 3), "512").last_words,
              HasSubstr("is damaged; expected a TFLite network"));
  EXPECT_FALSE(std::filesystem::exists(model_));
}

}  // namespace
}  // namespace mocap
