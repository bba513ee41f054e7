#include "daemon/recording/recorder.h"

#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"

namespace mocap {
namespace {

TEST(Recorder, SaysWhatACompleteTakeNeedsOfTheDiskAndLacks) {
  const testing::TemporaryFolder folder;
  std::filesystem::create_directories(folder.path() / "walk" / "background");
  testing::WriteText(folder.path() / "walk" / "cam1.mkv", std::string(1'500'000, 'a'));
  testing::WriteText(folder.path() / "walk" / "background" / "cam1.mkv",
                     std::string(1'700'000, 'b'));
  RecordingStatus status;
  status.folder = folder.path() / "walk";
  status.duration_ns = 2'500'000'000;
  status.frames = 75;
  EXPECT_EQ(CompletedText(status),
            status.folder.string() + ": 2.5 s, 75 frames, 3 MB, 0 dropped while recording");
  status.problem = "ended because the disk has 480 MB left";
  EXPECT_EQ(CompletedText(status), status.folder.string() +
                                       ": 2.5 s, 75 frames, 3 MB, 0 dropped while recording; it "
                                       "ended because the disk has 480 MB left");
}

TEST(Recorder, WhatCannotBeginDoesNotHideWhatWasRecorded) {
  const testing::TemporaryFolder folder;
  RecordingConfig config;
  config.folder = folder.path();
  Recorder recorder(RecordedStudio{});
  recorder.Start("walk", config, {});
  recorder.Stop();
  ASSERT_EQ(recorder.Status().state, RecordingStatus::State::kComplete);
  EXPECT_THROW(recorder.Start("walk", config, {}), std::exception);
  EXPECT_EQ(recorder.Status().state, RecordingStatus::State::kComplete);
  EXPECT_EQ(recorder.Status().folder, folder.path() / "walk");
}

}  // namespace
}  // namespace mocap
