#include "daemon/service/furniture_looks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>

#include "config/load_config.h"
#include "daemon/pipeline/pipeline.h"
#include "tests/daemon/fake_studio.h"

namespace mocap {
namespace {

using ::testing::HasSubstr;

/// A camera before which a box is put; frames come faster than their times say.
class BoxCamera : public CameraDriver {
 public:
  explicit BoxCamera(const std::atomic<bool>& has_box) : has_box_(has_box) {}
  void Start() override {}
  GrabStatus Grab(Frame& frame, std::chrono::milliseconds) override {
    // Otherwise threads of low priority would hardly run.
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    picture_ = testing::FakeRoom(99);
    for (int y = 8; has_box_.load() && y < 24; ++y)
      for (int x = 40; x < 56; ++x) picture_(x, y) = {40, 50, 210};
    frame.image = std::as_const(picture_).view();
    frame.capture_ns = frames_ * testing::kFakePeriodNs;
    frame.sequence = static_cast<std::uint64_t>(frames_++);
    return GrabStatus::kFrame;
  }
  void Stop() override {}

 private:
  const std::atomic<bool>& has_box_;
  Image<Bgr> picture_;
  std::int64_t frames_ = 0;
};

class IgnoredPoses : public PoseSink {
  void OnSet(const TrackedSet&) override {}
};

class FurnitureLooksTest : public ::testing::Test {
 protected:
  FurnitureLooksTest() {
    Studio studio = testing::FakeStudio({testing::SteadyFrames(1), testing::SteadyFrames(1)});
    std::vector<BackgroundSource> sources;
    std::vector<CameraCalibration> cameras;
    for (std::size_t i = 0; i < studio.cameras.size(); ++i) {
      studio.cameras[i].driver = std::make_unique<BoxCamera>(i == 1 ? has_box_ : never_);
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
  IgnoredPoses sink_;
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
