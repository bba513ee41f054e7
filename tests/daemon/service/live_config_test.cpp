#include "daemon/service/live_config.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/errors.h"
#include "tests/support/heap_bytes.h"
#include "tests/support/temporary_folder.h"

namespace mocap {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

class LiveConfigTest : public ::testing::Test {
 protected:
  testing::TemporaryFolder folder_;
  const std::filesystem::path file_ = folder_.path() / "mocapd.toml";
};

TEST_F(LiveConfigTest, TakesOverWhatCanChangeAndNamesTheRest) {
  testing::WriteText(file_, "[voxels]\nsize_mm = 25\n[lcm]\nvoxels_hz = 1\n");
  LiveConfig live(file_);
  testing::WriteText(file_,
                     "[voxels]\nsize_mm = 30\n[lcm]\nvoxels_hz = 2\n[recording]\ncodec = "
                     "\"raw\"\n");
  const ReloadResult result = live.Reload();
  EXPECT_THAT(result.applied, ElementsAre("lcm.voxels_hz", "recording.codec"));
  EXPECT_THAT(result.need_restart, ElementsAre("voxels.size_mm"));
  EXPECT_EQ(live.config().lcm.voxels_hz, 2);
  EXPECT_EQ(live.config().service.recording.codec, VideoCodec::kRaw);
  EXPECT_EQ(live.config().voxel_mm, 25);
}

TEST_F(LiveConfigTest, WhatNeedsARestartIsNamedUntilItIsAsItWas) {
  testing::WriteText(file_, "[voxels]\nsize_mm = 25\n");
  LiveConfig live(file_);
  testing::WriteText(file_, "[voxels]\nsize_mm = 30\n");
  live.Reload();
  EXPECT_THAT(live.Reload().need_restart, ElementsAre("voxels.size_mm"));
  testing::WriteText(file_, "[voxels]\nsize_mm = 25\n");
  EXPECT_THAT(live.Reload().need_restart, IsEmpty());
}

TEST_F(LiveConfigTest, HundredsOfReloadsLeaveNoMemoryBehind) {
  testing::WriteText(file_, "");
  LiveConfig live(file_);
  const auto reload = [&](int times) {
    for (int i = 0; i < times; ++i) {
      const char* end = i % 3 == 0 ? "\nnonsense = 1\n" : "\n";
      testing::WriteText(file_, "[voxels]\nsize_mm = " + std::to_string(20 + i % 5) +
                                    "\n[lcm]\nvoxels_hz = " + std::to_string(i % 7) + end);
      try {
        live.Reload();
      } catch (const SetupError&) {
      }
    }
  };
  reload(21);
  const std::int64_t before = HeapBytes();
  reload(315);
  EXPECT_LT(HeapBytes() - before, 3'000);
}

TEST_F(LiveConfigTest, AWrongFileChangesNothing) {
  testing::WriteText(file_, "[lcm]\nvoxels_hz = 1\n");
  LiveConfig live(file_);
  testing::WriteText(file_, "[lcm]\nvoxels_hz = 2\nnonsense = 1\n");
  EXPECT_THROW(live.Reload(), SetupError);
  EXPECT_EQ(live.config().lcm.voxels_hz, 1);
  testing::WriteText(file_, "[lcm]\nvoxels_hz = 3\n");
  EXPECT_THAT(live.Reload().applied, ElementsAre("lcm.voxels_hz"));
}

}  // namespace
}  // namespace mocap
