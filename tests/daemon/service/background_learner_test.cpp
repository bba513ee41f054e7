#include "daemon/service/background_learner.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "config/camera_files.h"
#include "config/load_config.h"
#include "core/errors.h"
#include "daemon/pipeline/pipeline.h"
#include "tests/daemon/painted_camera.h"
#include "tests/support/temporary_folder.h"

namespace mocap {
namespace {

using ::testing::HasSubstr;
using ::testing::Throws;
using ::testing::ThrowsMessage;

constexpr double kBrighter = 1.2;

/// Paints a room whose lamps burn brighter than when its background was learned.
auto BrighterWhile(const std::atomic<bool>& somebody_moves) {
  return [&somebody_moves](Image<Bgr>& picture, std::int64_t frame) {
    for (Bgr& pixel : picture.pixels()) {
      const auto value = static_cast<std::uint8_t>(kBrighter * pixel.g);
      pixel = {value, value, value};
    }
    const bool is_dark = somebody_moves.load() && frame % 3 == 1;
    for (int y = 10; y < 30; ++y)
      for (int x = 10; is_dark && x < 30; ++x) picture(x, y).r = 0;
  };
}

class BackgroundLearnerTest : public ::testing::Test {
 protected:
  BackgroundLearnerTest() {
    Studio studio = testing::FakeStudio({testing::SteadyFrames(1), testing::SteadyFrames(1)});
    std::vector<BackgroundSource> sources;
    for (StudioCamera& camera : studio.cameras) {
      camera.driver = std::make_unique<testing::PaintedCamera>(BrighterWhile(somebody_moves_));
      place_.cameras.push_back(camera.calibration);
      sources.push_back(camera.background);
    }
    known_.emplace(std::move(sources));
    taps_.resize(studio.cameras.size());
    place_.folder = folder_.path() / "background";
    pipeline_.emplace(std::move(studio), PipelineOptions{.taps = {&taps_}}, LoadBodyTable("full"),
                      sink_);
    pipeline_->Start();
  }
  ~BackgroundLearnerTest() override {
    pipeline_->RequestStop();
    pipeline_->Join();
  }

  /// Waits until a camera says that its light is as given.
  bool ComesToLight(double light) {
    for (int i = 0; i < 5000; ++i) {
      if (std::abs(pipeline_->Status().cameras[1].light - light) < 0.02) return true;
      std::this_thread::yield();
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return false;
  }

  testing::TemporaryFolder folder_;
  std::atomic<bool> somebody_moves_{false};
  testing::NoPoses sink_;
  LearningPlace place_;
  std::deque<FrameTap> taps_;
  std::optional<KnownBackgrounds> known_;
  std::optional<Pipeline> pipeline_;
};

TEST_F(BackgroundLearnerTest, GivesUpWhenTheDaemonEnds) {
  BackgroundLearner learner(*pipeline_, taps_, *known_, place_);
  learner.RequestStop();
  EXPECT_THAT([&] { learner.Learn(true, 1e6); },
              ::testing::ThrowsMessage<std::runtime_error>(HasSubstr("mocapd is stopping")));
  EXPECT_FALSE(std::filesystem::exists(place_.folder));
}

TEST_F(BackgroundLearnerTest, WhatWasLearnedIsUsedAndKept) {
  ASSERT_TRUE(ComesToLight(kBrighter));
  BackgroundLearner learner(*pipeline_, taps_, *known_, place_);
  EXPECT_THAT(learner.Learn(false), HasSubstr("cam1: "));
  EXPECT_TRUE(ComesToLight(1)) << "frames are compared with the new pictures";
  const auto kept = known_->Of(1)();
  ASSERT_GE(kept.size(), 10u);
  EXPECT_GT(kept[7].image(3, 3).g, 130);
  const std::string base = (place_.folder / "cam2").string();
  EXPECT_EQ(OpenCameraBackground(base + ".mkv", base + ".csv", place_.cameras[1])().size(),
            kept.size())
      << "as at the next start";
  EXPECT_FALSE(std::filesystem::exists(place_.folder.string() + ".partial"));
}

TEST_F(BackgroundLearnerTest, LearnsAgainInPlaceOfWhatWasThere) {
  BackgroundLearner learner(*pipeline_, taps_, *known_, place_);
  learner.Learn(false);
  learner.Learn(false);
  EXPECT_GE(known_->Of(0)().size(), 10u);
}

TEST_F(BackgroundLearnerTest, SomebodyWhoMovesIsNoticedAndNothingChanges) {
  somebody_moves_ = true;
  BackgroundLearner learner(*pipeline_, taps_, *known_, place_);
  EXPECT_THAT([&] { learner.Learn(false); },
              ThrowsMessage<std::runtime_error>(HasSubstr("that nobody is in the room")));
  EXPECT_FALSE(std::filesystem::exists(place_.folder));
  EXPECT_LT(known_->Of(0)()[0].image(3, 3).g, 130);
}

TEST_F(BackgroundLearnerTest, WhereNothingCanBeLearnedItSaysWhy) {
  place_.refusal = "cam1 turns";
  BackgroundLearner learner(*pipeline_, taps_, *known_, place_);
  EXPECT_THAT([&] { learner.Learn(true); }, ThrowsMessage<SetupError>("cam1 turns"));
}

TEST_F(BackgroundLearnerTest, AFolderThatCannotBeMadeIsNamed) {
  testing::WriteText(folder_.path() / "file", "");
  place_.folder = folder_.path() / "file" / "background";
  BackgroundLearner learner(*pipeline_, taps_, *known_, place_);
  EXPECT_THAT([&] { learner.Learn(false); },
              ThrowsMessage<SetupError>(HasSubstr("file/background.partial: cannot be created")));
}

}  // namespace
}  // namespace mocap
