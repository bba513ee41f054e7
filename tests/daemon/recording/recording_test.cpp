// Takes that are recorded while frames go on, and what is left of them when something goes wrong.
#include "daemon/recording/recording.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <thread>

#include "config/open_studio.h"
#include "config/subject_file.h"
#include "core/errors.h"
#include "daemon/recording/cut_off_takes.h"
#include "daemon/recording/recorder.h"
#include "drivers/take/mask_video.h"
#include "drivers/take/take_layout.h"
#include "drivers/take/take_table.h"
#include "tests/daemon/fake_studio.h"
#include "tests/support/file_size_limit.h"
#include "tests/support/heap_bytes.h"
#include "tests/support/temporary_folder.h"

namespace mocap {
namespace {

using testing::FakeRoom;
using testing::FileSizeLimit;
using ::testing::HasSubstr;

constexpr double kFrame_mb = 3e-6 * testing::kFakeWidth * testing::kFakeHeight;

class RecordingTest : public ::testing::Test {
 protected:
  static RecordedStudio TwoCameras() {
    Studio fake = testing::FakeStudio({testing::SteadyFrames(1), testing::SteadyFrames(1)});
    RecordedStudio studio{.name = "fake", .fps_nominal = 25, .cameras = {}, .config_text = "# x\n"};
    for (const StudioCamera& camera : fake.cameras) {
      studio.cameras.push_back({camera.calibration, camera.background});
    }
    return studio;
  }

  RecordingTest() {
    recorder_.emplace(TwoCameras());
    config_.folder = folder_.path() / "takes";
    config_.keep_free_mb = 0;
  }

  /// What a camera's thread does with a frame. @return whether it was taken.
  bool Offer(int camera, std::uint64_t sequence, std::int64_t offered_ns = 0) {
    bool is_taken = false;
    const Image<Bgr> picture = FakeRoom(static_cast<int>(sequence));
    Frame frame;
    frame.image = picture.view();
    frame.capture_ns = static_cast<std::int64_t>(1 + sequence) * testing::kFakePeriodNs;
    frame.sequence = sequence;
    recorder_->taps().frames[static_cast<std::size_t>(camera)].Offer([&](TappedFrame& copy) {
      is_taken = CopyFrame(frame, copy);
      copy.offered_ns = offered_ns;
      return is_taken;
    });
    return is_taken;
  }

  /// Files of takes that this process has open.
  int OpenFiles() const {
    int open = 0;
    for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd")) {
      std::error_code gone;
      const std::string file = std::filesystem::read_symlink(entry.path(), gone);
      open += file.starts_with(config_.folder.string());
    }
    return open;
  }

  testing::TemporaryFolder folder_;
  RecordingConfig config_;
  std::optional<Recorder> recorder_;
};

TEST_F(RecordingTest, OfSeveralPeopleEachKeepsHisSizes) {
  const std::array people = {RecordedPerson{2, "anna", AverageSizes(1700)},
                             RecordedPerson{5, "", AverageSizes(1500)}};
  const std::filesystem::path take = recorder_->Start("one", config_, people);
  Offer(0, 0);
  Offer(1, 0);
  recorder_->Stop();
  EXPECT_FALSE(std::filesystem::exists(take / "subject.toml")) << "whose would they be?";
  EXPECT_THAT(testing::ReadText(take / "person-2/subject.toml"), HasSubstr("name = \"anna\""));
  EXPECT_DOUBLE_EQ(LoadSubject(take / "person-2/subject.toml").thigh, AverageSizes(1700).thigh);
  EXPECT_DOUBLE_EQ(LoadSubject(take / "person-5/subject.toml").thigh, AverageSizes(1500).thigh);
}

TEST_F(RecordingTest, WhatClientsSentIsKeptBesideWhatWasPublished) {
  const std::filesystem::path take = recorder_->Start("one", config_, {});
  Offer(0, 0);
  RecordingTaps& taps = recorder_->taps();
  const auto offer = [](MessageTap& tap, const std::string& channel) {
    tap.Offer([&](TappedMessage& copy) {
      copy.channel = channel;
      copy.bytes = {1, 2, 3};
      return true;
    });
  };
  offer(taps.messages, "MOCAP_POSE");
  offer(taps.received, "MOCAP_KEYPOINTS");
  taps.keypoints.Offer([](KeypointView& copy) {
    copy = {.camera = "cam1", .capture_ns = 5, .points = {Keypoint()}};
    return true;
  });
  recorder_->Stop();
  const std::string log = testing::ReadText(TakeLayout{take}.Poses());
  EXPECT_THAT(log, HasSubstr(std::string("MOCAP_KEYPOINTS\1\2\3", 18)));
  EXPECT_THAT(log, HasSubstr("MOCAP_POSE"));
  EXPECT_THAT(testing::ReadText(take / "keypoints.csv"), HasSubstr("\ncam1,"));
}

TEST_F(RecordingTest, ACanceledTakeLeavesNothingBehind) {
  recorder_->Start("one", config_, {});
  Offer(0, 0);
  EXPECT_THROW(recorder_->Cancel("other"), std::runtime_error) << "that one is not being recorded";
  recorder_->Cancel("one");
  EXPECT_TRUE(std::filesystem::is_empty(config_.folder));
  EXPECT_EQ(recorder_->Status().state, RecordingStatus::State::kNone);
  EXPECT_EQ(OpenFiles(), 0);
}

TEST_F(RecordingTest, ATakeThatIsCompleteIsNotCanceled) {
  const std::filesystem::path take = recorder_->Start("one", config_, {});
  Offer(0, 0);
  recorder_->Stop();
  EXPECT_THROW(recorder_->Cancel("one"), std::runtime_error);
  EXPECT_TRUE(std::filesystem::exists(take / "take.toml"));
}

TEST_F(RecordingTest, WithoutRoomNoFolderIsMade) {
  config_.keep_free_mb = 1e12;
  EXPECT_THROW(recorder_->Start("one", config_, {}), SetupError);
  EXPECT_FALSE(std::filesystem::exists(config_.folder));
}

TEST_F(RecordingTest, ManyTakesLeaveNoMemoryBehind) {
  const auto record = [this](int takes) {
    for (int i = 0; i < takes; ++i) {
      const std::filesystem::path take = recorder_->Start("one", config_, {});
      for (std::uint64_t frame = 0; frame < 3; ++frame) Offer(0, frame), Offer(1, frame);
      recorder_->Stop();
      std::filesystem::remove_all(take);
    }
  };
  record(2);
  const std::int64_t before = HeapBytes();
  record(8);
  EXPECT_LT(HeapBytes() - before, 20'000);
}

TEST_F(RecordingTest, WhatItsQueuesTookGoesBackToTheSystem) {
  if (!kCountsAllocations) GTEST_SKIP() << "the sanitizer keeps what is freed";
  config_.buffer_mb = 60;
  const std::int64_t before = ResidentBytes();
  recorder_->Start("one", config_, {});
  // Lies above the queues in the heap.
  const std::vector<char> pin(1000);
  EXPECT_GT(ResidentBytes(), before + 40'000'000);
  recorder_->Stop();
  EXPECT_LT(ResidentBytes(), before + 20'000'000);
}

TEST_F(RecordingTest, TheTakeHoldsEveryFrameAndOpens) {
  const std::filesystem::path take =
      recorder_->Start("one", config_, std::array{RecordedPerson{3, "anna", AverageSizes(1700)}});
  for (std::uint64_t i = 0; i < 5; ++i) {
    Offer(0, i);
    if (i != 2) Offer(1, i);
  }
  const RecordingStatus status = recorder_->Stop();
  EXPECT_EQ(status.state, RecordingStatus::State::kComplete);
  EXPECT_EQ(status.frames, 9);
  EXPECT_EQ(status.dropped, 0);
  const TakeLayout layout{take};
  EXPECT_EQ(ReadTakeTable(layout.Table("cam1")).rows.size(), 5u);
  const auto rows = ReadTakeTable(layout.Table("cam2")).rows;
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(rows[2].frame, 3u) << "the gap shows in the numbers";
  EXPECT_THAT(testing::ReadText(layout.Description()), HasSubstr("missing_frames_cam2 = \"1\""));
  EXPECT_EQ(testing::ReadText(take / "mocapd.toml"), "# x\n");
  EXPECT_DOUBLE_EQ(LoadSubject(take / "subject.toml").thigh, AverageSizes(1700).thigh);
  Studio studio = OpenTake(take, {});
  ASSERT_EQ(studio.cameras.size(), 2u);
  EXPECT_FALSE(studio.cameras[0].background().empty());
}

TEST_F(RecordingTest, FramesThatWaitForPosesAreKept) {
  recorder_->Start("one", config_, {});
  recorder_->taps().frames[0].Hold(true);
  for (std::uint64_t i = 0; i < 3; ++i) EXPECT_TRUE(Offer(0, i));
  Offer(1, 0);
  const RecordingStatus status = recorder_->Stop();
  EXPECT_EQ(status.frames, 4);
  EXPECT_EQ(status.dropped, 0);
}

TEST_F(RecordingTest, FramesThatWaitForPosesAreWrittenBeforeTheyAreLost) {
  config_.buffer_mb = 10 * kFrame_mb * 2;
  recorder_->Start("one", config_, {});
  recorder_->taps().frames[0].Hold(true);
  std::uint64_t next = 0;
  while (recorder_->Status().frames == 0) {
    if (recorder_->Status().waiting < 8) Offer(0, next++);
    std::this_thread::yield();
  }
  EXPECT_EQ(recorder_->Status().dropped, 0);
}

TEST_F(RecordingTest, AFolderThatIsTakenAwayEndsItAndIsNamed) {
  recorder_->Start("walk", config_, {});
  EXPECT_TRUE(Offer(0, 0));
  std::filesystem::remove_all(config_.folder);
  while (recorder_->Status().state == RecordingStatus::State::kRunning) std::this_thread::yield();
  const RecordingStatus status = recorder_->Status();
  EXPECT_EQ(status.state, RecordingStatus::State::kFailed);
  EXPECT_THAT(status.problem,
              HasSubstr((config_.folder / "walk.partial").string() +
                        " was removed or unmounted; the nearest folder that still exists is " +
                        folder_.path().string()));
  EXPECT_EQ(OpenFiles(), 0);
}

TEST_F(RecordingTest, WhileItRunsTheTakeOpensAsPartial) {
  recorder_->Start("one", config_, {});
  const RecordingStatus status = recorder_->Status();
  EXPECT_EQ(status.state, RecordingStatus::State::kRunning);
  EXPECT_TRUE(status.folder.string().ends_with("one.partial"));
  EXPECT_TRUE(std::filesystem::exists(status.folder / "background" / "cam2.mkv"));
}

TEST_F(RecordingTest, WhatARunThatWasKilledLeftIsFound) {
  recorder_->Start("one", config_, {});
  for (std::uint64_t i = 0; i < 5; ++i) Offer(0, i);
  while (recorder_->Status().frames < 5) std::this_thread::yield();
  const std::vector<CutOffTake> found = FindCutOffTakes(config_.folder);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].folder, recorder_->Status().folder);
  EXPECT_EQ(found[0].duration_ns, 4 * testing::kFakePeriodNs);
  EXPECT_EQ(found[0].last_ns, 5 * testing::kFakePeriodNs);
  Offer(1, 0);
  recorder_->Stop();
  EXPECT_TRUE(FindCutOffTakes(config_.folder).empty());
  EXPECT_TRUE(FindCutOffTakes(folder_.path() / "nowhere").empty());
}

TEST_F(RecordingTest, OnlyOneAtATimeAndNoneTwice) {
  recorder_->Start("one", config_, {});
  EXPECT_THROW(recorder_->Start("two", config_, {}), std::runtime_error);
  Offer(0, 0);
  Offer(1, 0);
  recorder_->Stop();
  EXPECT_THROW(recorder_->Stop(), std::runtime_error);
  EXPECT_THROW(recorder_->Start("one", config_, {}), SetupError) << "there is a take of that name";
  recorder_->Start("two", config_, {});
}

TEST_F(RecordingTest, WhatHasEndedKeepsNoFileOpen) {
  recorder_->Start("one", config_, {});
  EXPECT_GT(OpenFiles(), 0);
  Offer(0, 0);
  recorder_->Stop();
  EXPECT_EQ(OpenFiles(), 0) << "removing the take would free nothing";
}

TEST_F(RecordingTest, WithoutRoomItDoesNotBegin) {
  config_.keep_free_mb = 1e12;
  EXPECT_THROW(recorder_->Start("one", config_, {}), SetupError);
  EXPECT_EQ(recorder_->Status().state, RecordingStatus::State::kNone);
}

TEST_F(RecordingTest, AFullQueueLosesTheOldestAndSaysSo) {
  FrameTap tap;
  Doorbell bell;
  TappedFrame item;
  item.image = Image<Bgr>(testing::kFakeWidth, testing::kFakeHeight);
  tap.Open(4, item, bell);
  const Image<Bgr> picture = FakeRoom(1);
  for (std::uint64_t i = 0; i < 10; ++i) {
    tap.Offer([&](TappedFrame& copy) {
      copy.sequence = i;
      return true;
    });
  }
  tap.Close();
  EXPECT_EQ(tap.queue().dropped(), 6);
  ASSERT_TRUE(tap.queue().TryPop());
  EXPECT_EQ(tap.queue().front().sequence, 6u);
  tap.Offer([](TappedFrame&) {
    ADD_FAILURE() << "closed";
    return true;
  });
}

TEST_F(RecordingTest, NoFrameIsTooOldToBeWritten) {
  const std::filesystem::path take = recorder_->Start("one", config_, {});
  constexpr std::int64_t kLongAgoNs = 1;
  for (std::uint64_t i = 0; i < 3; ++i) Offer(0, i, kLongAgoNs);
  Offer(1, 0, kLongAgoNs);
  const RecordingStatus status = recorder_->Stop();
  EXPECT_EQ(status.frames, 4);
  EXPECT_EQ(status.dropped, 0);
  EXPECT_EQ(ReadTakeTable(TakeLayout{take}.Table("cam1")).rows.size(), 3u);
}

TEST_F(RecordingTest, WaitingFramesLeaveHalfOfTheMemory) {
  config_.buffer_mb = 256;
  EXPECT_EQ(BufferFor(config_, 8000), 256);
  config_.buffer_mb = 65'536;
  EXPECT_EQ(BufferFor(config_, 8000), 4000);
}

TEST_F(RecordingTest, MemoryHoldsAsManyFramesAsTheBufferIsLarge) {
  config_.buffer_mb = 50 * kFrame_mb * 2;
  recorder_->Start("one", config_, {});
  EXPECT_GE(recorder_->taps().frames[0].queue().capacity(), 49u);
  EXPECT_LE(recorder_->taps().frames[0].queue().capacity(), 50u);
}

TEST_F(RecordingTest, ACameraThatCannotBeWrittenLeavesTheOthersTheirLastFrames) {
  recorder_->Start("one", config_, {});
  std::size_t taken = 0;
  {
    const FileSizeLimit limit(65'536);
    for (std::uint64_t i = 0; recorder_->Status().problem.empty(); ++i) Offer(0, i);
    for (std::uint64_t i = 0; i < 5; ++i) taken += Offer(1, i) ? 1 : 0;
    recorder_->Stop();
  }
  const RecordingStatus status = recorder_->Stop();
  EXPECT_EQ(status.state, RecordingStatus::State::kFailed);
  EXPECT_THAT(status.problem, HasSubstr("cam1.mkv: cannot be written"));
  EXPECT_EQ(OpenFiles(), 0);
  if (taken == 0) return;
  EXPECT_EQ(ReadTakeTable(TakeLayout{status.folder}.Table("cam2")).rows.size(), taken);
}

TEST_F(RecordingTest, EachPictureOfTheEmptyStudioIsWrittenBeforeTheNextIsRead) {
  RecordedStudio studio = TwoCameras();
  std::vector<std::uintmax_t> sizes;
  const std::filesystem::path partial = config_.folder / "one.partial";
  studio.cameras[1].background =
      BackgroundSource::OneByOne([&](const BackgroundSource::Visit& visit) {
        for (int i = 0; i < 3; ++i) {
          visit({FakeRoom(i), {}});
          sizes.push_back(std::filesystem::file_size(TakeLayout{partial}.BackgroundVideo("cam2")));
        }
      });
  recorder_.emplace(std::move(studio));
  recorder_->Start("one", config_, {});
  EXPECT_THAT(sizes, ::testing::SizeIs(3));
  EXPECT_LT(sizes[0], sizes[1]);
  EXPECT_LT(sizes[1], sizes[2]);
}

TEST_F(RecordingTest, WhatWasNeverSeenEmptyGoesIntoTheTake) {
  RecordedStudio studio = TwoCameras();
  const Image<Bgr> room = FakeRoom(0);
  Silhouette unseen(room.width(), room.height());
  unseen.Set(5, 4);
  studio.cameras[1].background = [&] {
    return std::vector<BackgroundFrame>(2, BackgroundFrame{room, {}, unseen});
  };
  recorder_.emplace(std::move(studio));
  const TakeLayout layout{recorder_->Start("one", config_, {})};
  recorder_->Stop();
  EXPECT_EQ(ReadMask(layout.BackgroundUnseen("cam2")).words(), unseen.words());
  EXPECT_FALSE(std::filesystem::exists(layout.BackgroundUnseen("cam1")));
}

TEST_F(RecordingTest, AStartThatFailsLeavesNothing) {
  RecordedStudio studio = TwoCameras();
  studio.cameras[1].background = []() -> std::vector<BackgroundFrame> {
    throw std::runtime_error("cam2.mkv: cannot be read");
  };
  recorder_.emplace(std::move(studio));
  EXPECT_THROW(recorder_->Start("one", config_, {}), std::runtime_error);
  EXPECT_TRUE(std::filesystem::is_empty(config_.folder));
}

TEST_F(RecordingTest, TimesThatGoBackAreLeftOut) {
  const std::filesystem::path take = recorder_->Start("one", config_, {});
  for (const std::uint64_t sequence : {5, 3, 6}) {
    Offer(0, sequence);
    Offer(1, sequence);
  }
  recorder_->Stop();
  EXPECT_EQ(ReadTakeTable(TakeLayout{take}.Table("cam1")).rows.size(), 2u);
  OpenTake(take, {});
}

}  // namespace
}  // namespace mocap
