#include "daemon/service/occupied_learner.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <optional>

#include "config/load_config.h"
#include "core/errors.h"
#include "daemon/pipeline/pipeline.h"
#include "drivers/take/take_layout.h"
#include "tests/daemon/painted_camera.h"
#include "tests/support/temporary_folder.h"

namespace mocap {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::ThrowsMessage;

enum class Furniture { kAsLearned, kMoved, kAnotherRoom };

/// Paints a room that somebody furnishes.
auto FurnishedAs(const std::atomic<Furniture>& known) {
  return [&known](Image<Bgr>& picture, std::int64_t) {
    const Furniture furniture = known.load();
    const bool is_other = furniture == Furniture::kAnotherRoom;
    for (int y = is_other ? 0 : 12; y < (is_other ? testing::kFakeHeight : 30); ++y) {
      for (int x = is_other ? 0 : 10; x < (is_other ? 40 : 30); ++x)
        if (furniture != Furniture::kAsLearned) picture(x, y) = {40, 50, 210};
    }
  };
}

class OccupiedLearnerTest : public ::testing::Test {
 protected:
  OccupiedLearnerTest() {
    Studio studio = testing::FakeStudio({testing::SteadyFrames(1), testing::SteadyFrames(1)});
    std::vector<BackgroundSource> sources;
    for (std::size_t i = 0; i < studio.cameras.size(); ++i) {
      studio.cameras[i].driver =
          std::make_unique<testing::PaintedCamera>(FurnishedAs(furniture_[i]));
      place_.cameras.push_back(studio.cameras[i].calibration);
      sources.push_back(studio.cameras[i].background);
    }
    known_.emplace(std::move(sources));
    taps_.resize(studio.cameras.size());
    place_.folder = folder_.path() / "background";
    std::filesystem::create_directory(place_.folder);
    for (const CameraCalibration& camera : place_.cameras)
      testing::WriteText(place_.folder / (camera.name + ".mkv"), "as stored");
    pipeline_.emplace(std::move(studio), PipelineOptions{.taps = {&taps_}}, LoadBodyTable("full"),
                      sink_);
    pipeline_->Start();
  }
  ~OccupiedLearnerTest() override {
    pipeline_->RequestStop();
    pipeline_->Join();
  }

  /// What was learned. @throws  why nothing was.
  static std::string ResultOf(OccupiedLearner& learner, const OccupiedErrand& errand) {
    learner.Begin(errand);
    while (learner.IsUnderWay()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return learner.Progress();
  }
  /// Red in the middle of the furniture, as it is known to a camera.
  int KnownRed(std::size_t camera) const { return known_->Of(camera)()[0].image(20, 20).r; }
  int Replacements(int camera) const {
    return pipeline_->Status().cameras[static_cast<std::size_t>(camera)].replacements;
  }

  testing::TemporaryFolder folder_;
  std::array<std::atomic<Furniture>, 2> furniture_{Furniture::kAsLearned, Furniture::kAsLearned};
  testing::NoPoses sink_;
  LearningPlace place_;
  std::deque<FrameTap> taps_;
  std::optional<KnownBackgrounds> known_;
  std::optional<Pipeline> pipeline_;
};

TEST_F(OccupiedLearnerTest, BeginsAtOnceAndWhatWasLearnedIsUsedAndKept) {
  OccupiedLearner learner(*pipeline_, taps_, *known_, place_);
  EXPECT_THAT([&] { learner.Progress(); },
              ThrowsMessage<std::runtime_error>(HasSubstr("no background was learned")));
  learner.Begin({20, {}});
  EXPECT_THAT(learner.Progress(), ::testing::StartsWith(OccupiedLearner::kUnderWay));
  EXPECT_THAT(
      [&] {
        learner.Begin({20, {}});
      },
      ThrowsMessage<std::runtime_error>(HasSubstr("is being learned already")));
  EXPECT_THAT(learner.Present(), ::testing::StartsWith(OccupiedLearner::kUnderWay));
  while (learner.IsUnderWay()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  EXPECT_EQ(learner.Present(), "");
  EXPECT_THAT(learner.Progress(), AllOf(HasSubstr("cam1: 40 pictures, 0 %"), HasSubstr("cam2: ")));
  EXPECT_EQ(known_->Of(1)().size(), 40u);
  EXPECT_EQ(Replacements(0), 1);
  EXPECT_EQ(Replacements(1), 1);
  EXPECT_FALSE(std::filesystem::exists(place_.folder.string() + ".partial"));
}

TEST_F(OccupiedLearnerTest, WhatWasMovedIsNamedAndHeldBackUntilItIsAccepted) {
  furniture_[1] = Furniture::kMoved;
  OccupiedLearner learner(*pipeline_, taps_, *known_, place_);
  EXPECT_THAT(ResultOf(learner, {20, {}}),
              AllOf(HasSubstr("cam2: something was moved at the "), HasSubstr("--accept cam2"),
                    Not(HasSubstr("cam1: something"))));
  EXPECT_LT(KnownRed(1), 140);
  EXPECT_THAT(ResultOf(learner, {20, {"cam2"}}), HasSubstr("it is part of the background now"));
  EXPECT_NEAR(KnownRed(1), 210, 2);
  EXPECT_LT(KnownRed(0), 140);
}

TEST_F(OccupiedLearnerTest, ACameraThatShowsAnotherRoomKeepsItsBackgroundAndOthersLearn) {
  OccupiedLearner learner(*pipeline_, taps_, *known_, place_);
  ResultOf(learner, {20, {}});
  const auto stored = testing::ReadText(place_.folder / "cam2.mkv");
  furniture_[1] = Furniture::kAnotherRoom;
  EXPECT_THAT(ResultOf(learner, {20, {}}),
              AllOf(HasSubstr("cam1: 40 pictures"),
                    HasSubstr("of its picture differs from the stored background"),
                    HasSubstr("use --accept cam2. Its background remains as it was")));
  EXPECT_EQ(testing::ReadText(place_.folder / "cam2.mkv"), stored);
  EXPECT_FALSE(std::filesystem::exists(place_.folder / "cam2.learned.mkv"));
}

TEST_F(OccupiedLearnerTest, WhereNothingCanBeLearnedItSaysWhyAndNothingChanges) {
  OccupiedLearner learner(*pipeline_, taps_, *known_, place_);
  EXPECT_THAT(
      [&] {
        learner.Begin({20, {"cam7"}});
      },
      ThrowsMessage<SetupError>(HasSubstr("--accept: there is no camera \"cam7\"")));
  EXPECT_THAT(
      [&] {
        ResultOf(learner, {5, {}});
      },
      ThrowsMessage<SetupError>(HasSubstr("cam1: has only 10 pictures")));
  learner.RequestStop();
  EXPECT_THAT(
      [&] {
        ResultOf(learner, {20, {}});
      },
      ThrowsMessage<std::runtime_error>(HasSubstr("mocapd is stopping")));
  EXPECT_EQ(testing::ReadText(place_.folder / "cam1.mkv"), "as stored");
  place_.refusal = "cam1 turns";
  OccupiedLearner refused(*pipeline_, taps_, *known_, place_);
  EXPECT_THAT([&] { refused.Begin({20, {}}); }, ThrowsMessage<SetupError>("cam1 turns"));
}

}  // namespace
}  // namespace mocap
