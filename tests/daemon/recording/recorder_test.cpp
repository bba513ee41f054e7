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
  status.cameras = 2;
  status.frames = 149;
  status.sets = 75;
  EXPECT_EQ(CompletedText(status), status.folder.string() +
                                       ": 2.5 s, 3 MB, 75 frame sets of 2 "
                                       "cameras, 0 frames dropped");
  status.problem = "ended because the disk has 480 MB left";
  EXPECT_EQ(CompletedText(status), status.folder.string() +
                                       ": 2.5 s, 3 MB, 75 frame sets of 2 cameras, 0 frames "
                                       "dropped; it ended because the disk has 480 MB left");
}

TEST(Recorder, SaysWhyATakeHasNoFrames) {
  RecordingStatus status;
  EXPECT_EQ(ContentText(status), "no frames, as mocapd has no cameras on this computer");
  status.cameras = 6;
  status.dropped = 1;
  EXPECT_EQ(ContentText(status), "no frames of 6 cameras, 1 frame dropped");
}

TEST(Recorder, WhatCannotBeginDoesNotHideWhatWasRecorded) {
  const testing::TemporaryFolder folder;
  RecordingConfig config;
  config.folder = folder.path();
  Recorder recorder(RecordedStudio{});
  recorder.Start("walk", config, {});
  EXPECT_EQ(recorder.Stop().cameras, 0u);
  ASSERT_EQ(recorder.Status().state, RecordingStatus::State::kComplete);
  EXPECT_THROW(recorder.Start("walk", config, {}), std::exception);
  EXPECT_EQ(recorder.Status().state, RecordingStatus::State::kComplete);
  EXPECT_EQ(recorder.Status().folder, folder.path() / "walk");
}

}  // namespace
}  // namespace mocap
