// A folder with a configuration for the daemon as a program.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <lcm/lcm-cpp.hpp>
#include <memory>
#include <string>

#include "core/errors.h"
#include "daemon/messages/pose_publisher.h"
#include "tests/support/small_take.h"
#include "tests/support/temporary_folder.h"

namespace mocap::testing {

/// Nobody comes: there is next to nothing to compute, so that even a slow machine keeps up.
inline void WriteEmptyTake(const std::filesystem::path& folder, const SmallTake& take = {}) {
  constexpr int kBackgroundFrames = 10;
  const Image<Bgr> room = SmallPicture(take, 0, 0);
  TakeWriter writer(folder, SmallDescription(take));
  for (int camera = 0; camera < take.cameras; ++camera) {
    for (int frame = 0; frame < kBackgroundFrames; ++frame) {
      writer.WriteBackground(camera, room.view(), take.TimeNs(camera, frame), {});
    }
    for (int frame = 0; frame < take.frames; ++frame) {
      writer.WriteFrame(camera, room.view(), take.TimeNs(camera, frame), {});
    }
  }
  writer.Finish();
}

class MocapdTest : public ::testing::Test {
 protected:
  /// A port of this process's own, so that tests at the same time do not hear each other.
  const std::string url_ =
      "udpm://239.255.76.67:" + std::to_string(20000 + getpid() % 40000) + "?ttl=0";
  TemporaryFolder folder_;
  const std::filesystem::path log_ = folder_.path() / "errors";

  std::string WriteConfig(const std::string& source, const std::string& more = "",
                          const std::string& top = "") {
    const std::filesystem::path file = folder_.path() / "mocapd.toml";
    WriteText(file, top + "[source]\n" + source + "[lcm]\nurl = \"" + url_ +
                        "\"\nprefix = \"T_\"\n" + more);
    return file;
  }
  /// Null, with the reason, where LCM has no way out.
  std::unique_ptr<lcm::LCM> Open(std::string& reason) {
    try {
      return OpenLcm(url_);
    } catch (const SetupError& error) {
      reason = error.what();
      return nullptr;
    }
  }
};

}  // namespace mocap::testing
