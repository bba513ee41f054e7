#include "tools/witness/witness_take.h"

#include <gtest/gtest.h>

#include <set>
#include <sstream>

#include "drivers/take/keypoint_table.h"
#include "tests/support/run_command.h"
#include "tests/support/temporary_folder.h"
#include "tests/witness/onnx_bytes.h"
#include "tools/simulate.h"

namespace mocap {
namespace {

TEST(WitnessTake, LooksAtAPersonThroughOneCameraAfterTheOtherAndFindsTheSameTwice) {
  const testing::TemporaryFolder folder;
  const std::filesystem::path take = folder.path() / "take", model = folder.path() / "tiny.onnx";
  testing::RunCommand(AddSimulateCommand,
                      "simulate --motion stand --seconds 1 --fps 15 --cameras 4 "
                      "--width 320 --height 240 --out " +
                          take.string());
  testing::WriteText(model, testing::ColorMapNetwork());
  testing::WriteText(DescriptionBeside(model), testing::kColorMapDescription);
  std::string written[2];
  for (std::string& text : written) {
    PoseNetwork network(model);
    const Witnessed witnessed = WitnessTake({.take = take, .rate_hz = 5}, network);
    EXPECT_EQ(witnessed.failed, 0u);
    ASSERT_GE(witnessed.views.size(), 4u);
    EXPECT_LE(witnessed.views.size(), 5u);
    std::set<std::string> cameras;
    std::int64_t last_ns = 0;
    for (const KeypointView& view : witnessed.views) {
      cameras.insert(view.camera);
      EXPECT_GE(view.capture_ns - last_ns, 190'000'000);
      last_ns = view.capture_ns;
      EXPECT_EQ(view.person, 1);
      ASSERT_EQ(view.points.size(), 2u);
      EXPECT_GE(view.points[0].px.x(), 0);
      EXPECT_LT(view.points[0].px.x(), 320);
    }
    EXPECT_EQ(cameras.size(), 4u);
    std::ostringstream out;
    WriteKeypoints(out, witnessed.views);
    text = out.str();
  }
  EXPECT_EQ(written[0], written[1]);
}

}  // namespace
}  // namespace mocap
