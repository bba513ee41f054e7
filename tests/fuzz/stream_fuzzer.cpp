#include "core/errors.h"
#include "tests/fuzz/fuzz_file.h"
#include "tools/stream/log_player.h"
#include "tools/stream/pose_json.h"
#include "tools/stream/streamed_bones.h"

/// A log of anything, as lines of JSON and as an avatar's bones.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const mocap::testing::FuzzFile file(data, size);
  static mocap::StreamedBones bones;
  const auto take = [](const mocap::StreamedPose& pose) {
    mocap::PoseJson(pose);
    if (pose.is_tracked) bones.Of(pose);
  };
  for (const bool everybody : {false, true}) {
    mocap::LogPlayer player(file.path(), 0);
    mocap::PoseFeed feed(player.lcm(), {.everybody = everybody}, take);
    try {
      while (player.Play(std::chrono::nanoseconds(0))) {
      }
    } catch (const mocap::SetupError&) {
      // The one way to say that a log cannot be used.
    }
  }
  return 0;
}
