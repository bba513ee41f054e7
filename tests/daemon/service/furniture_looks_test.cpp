#include "daemon/service/furniture_looks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>

#include "config/load_config.h"
#include "daemon/pipeline/pipeline.h"
#include "tests/daemon/painted_camera.h"

namespace mocap {
namespace {

using ::testing::HasSubstr;

/// Paints a box while there is one.
auto BoxIf(const std::atomic<bool>& has_box) {
  return [&has_box](Image<Bgr>& picture, std::int64_t) {
    for (int y = 8; has_box.load() && y < 24; ++y)
      for (int x = 40; x < 56; ++x) picture(x, y) = {40, 50, 210};
  };
}

class FurnitureLooksTest : public ::testing::Test {
 protected:
  FurnitureLooksTest() {
    Studio studio = testing::FakeStudio({testing::SteadyFrames(1), testing::SteadyFrames(1)});
    std::vector<BackgroundSource> sources;
    std::vector<CameraCalibration> cameras;
    for (std::size_t i = 0; i < studio.cameras.size(); ++i) {
      studio.cameras[i].driver =
          std::make_unique<testing::PaintedCamera>(BoxIf(i == 1 ? has_box_ : never_));
      cameras.push_back(studio.cameras[i].calibration);
      sources.push_back(studio.cameras[i].background);
    }
    known_.emplace(std::move(sources));
    taps_.resize(cameras.size());
    pipeline_.emplace(std::move(studio), PipelineOptions{.taps = {&taps_}}, LoadBodyTable("full"),
                      sink_);
    pipeline_->Start();
    looks_.emplace(*pipeline_, taps_, *known_, cameras, std::chrono::milliseconds(1));
  }
  ~FurnitureLooksTest() override {
    looks_.reset();
    pipeline_->RequestStop();
    pipeline_->Join();
  }

  /// Waits until this number of things is named.
  std::vector<MovedFurniture> ComesTo(std::size_t count) {
    for (int i = 0; i < 20000 && looks_->Moved().size() != count; ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return looks_->Moved();
  }

  std::atomic<bool> has_box_{false}, never_{false};
  testing::NoPoses sink_;
  std::deque<FrameTap> taps_;
  std::optional<KnownBackgrounds> known_;
  std::optional<Pipeline> pipeline_;
  std::optional<FurnitureLooks> looks_;
};

TEST_F(FurnitureLooksTest, NameWhatStandsThereByCameraUntilItIsTakenAway) {
  has_box_ = true;
  const std::vector<MovedFurniture> moved = ComesTo(1);
  ASSERT_EQ(moved.size(), 1u);
  EXPECT_EQ(moved[0].camera, "cam2");
  EXPECT_THAT(moved[0].place, HasSubstr("right, x "));
  EXPECT_NEAR(moved[0].share, 16.0 * 16 / (64 * 48), 0.05);
  EXPECT_GE(moved[0].age_ns, FurnitureWatch::kStill_ns);
  has_box_ = false;
  EXPECT_TRUE(ComesTo(0).empty());
}

TEST_F(FurnitureLooksTest, ForgetWhatBecamePartOfTheBackground) {
  has_box_ = true;
  ASSERT_EQ(ComesTo(1).size(), 1u);
  std::vector<BackgroundFrame> learned = known_->Of(1)();
  for (BackgroundFrame& frame : learned) {
    for (int y = 8; y < 24; ++y)
      for (int x = 40; x < 56; ++x) frame.image(x, y) = {40, 50, 210};
  }
  known_->Set(1, [learned] { return learned; });
  pipeline_->ReplaceBackground(1, learned);
  EXPECT_TRUE(ComesTo(0).empty());
}

}  // namespace
}  // namespace mocap
