// Joins takes of one studio, recorded by several computers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

namespace mocap {

struct JoinedTake {
  std::size_t cameras = 0;
  std::int64_t common_ns = 0;  ///< Time that all takes cover.
  std::int64_t all_ns = 0;     ///< Time from the first start to the last end.
};

/// Joins takes of different cameras that were recorded at the same time in the same world frame.
///
/// Videos are hard-linked if the disk allows it, else copied; nothing is encoded again. Cameras
/// come in the order of the takes. All frames are kept, even from times that some take does not
/// cover: frames of a take are matched by time, and a camera may miss some. Keys of take.toml on
/// which the takes agree are kept. A daemon's configuration and messages are not copied.
/// @param out  a folder that does not exist yet; it gets its name when complete.
/// @throws SetupError  naming takes and cameras: a camera that is in two, or is calibrated
/// differently; rates that differ; times that do not overlap; truth that differs.
/// @throws std::runtime_error  when something cannot be written; then nothing is left behind.
JoinedTake JoinTakes(std::span<const std::filesystem::path> takes,
                     const std::filesystem::path& out);

}  // namespace mocap
