#include "tools/accuracy/disturbed_camera.h"

#include <gtest/gtest.h>

#include <memory>
#include <utility>

#include "drivers/simulation/simulated_studio.h"

namespace mocap {
namespace {

constexpr std::chrono::milliseconds kAtOnce{0};

class DisturbedCameraTest : public ::testing::Test {
 protected:
  DisturbedCameraTest() {
    options_.width_px = 160;
    options_.height_px = 120;
    options_.seconds = 1;
  }
  std::unique_ptr<CameraDriver> Open(const PictureDisturbance& disturbance) const {
    const SimulatedStudio studio(options_);
    auto camera = std::make_unique<DisturbedCamera>(
        studio.OpenCamera(0), studio.Background(0).front().image, disturbance);
    camera->Start();
    return camera;
  }
  double ShareThatDiffers(CameraDriver& a, CameraDriver& b) const {
    Frame of_a, of_b;
    EXPECT_EQ(a.Grab(of_a, kAtOnce), GrabStatus::kFrame);
    EXPECT_EQ(b.Grab(of_b, kAtOnce), GrabStatus::kFrame);
    double differing = 0;
    for (int y = 0; y < options_.height_px; ++y) {
      for (int x = 0; x < options_.width_px; ++x) differing += of_a.image(x, y) != of_b.image(x, y);
    }
    return differing / (options_.width_px * options_.height_px);
  }

  SimulatedStudioOptions options_ = RecordedSimulation();
};

TEST_F(DisturbedCameraTest, CoversAboutAsMuchAsIsAskedForAndTheSameEachTime) {
  const auto plain = Open({}), one = Open({.covered_share = 0.1}),
             other = Open({.covered_share = 0.1});
  EXPECT_NEAR(ShareThatDiffers(*plain, *one), 0.1, 0.04);
  Frame skipped;
  other->Grab(skipped, kAtOnce);
  EXPECT_EQ(ShareThatDiffers(*one, *other), 0);
}

TEST_F(DisturbedCameraTest, FallsSilentForGood) {
  const auto camera = Open({.mishap = Mishap::kLost, .mishap_ns = options_.start_ns + 500'000'000});
  Frame frame;
  int frames = 0;
  while (camera->Grab(frame, kAtOnce) == GrabStatus::kFrame) ++frames;
  EXPECT_EQ(frames, 15);
  EXPECT_EQ(camera->Grab(frame, kAtOnce), GrabStatus::kEnd);
}

TEST_F(DisturbedCameraTest, ShiftsThePictureOfACameraThatWasTurned) {
  const auto plain = Open({}), turned = Open({.mishap = Mishap::kTurned});
  Frame before, after;
  plain->Grab(before, kAtOnce);
  turned->Grab(after, kAtOnce);
  for (int x = 0; x < 100; ++x) EXPECT_EQ(after.image(x + 20, 60), before.image(x, 60));
}

TEST_F(DisturbedCameraTest, ShowsABlindedCameraNothing) {
  const auto camera = Open({.mishap = Mishap::kBlinded});
  Frame frame;
  camera->Grab(frame, kAtOnce);
  EXPECT_EQ(frame.image(80, 60), (Bgr{255, 255, 255}));
}

}  // namespace
}  // namespace mocap
