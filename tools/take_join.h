// One take of those that several computers recorded of one studio.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

namespace mocap {

struct JoinedTake {
  std::size_t cameras = 0;
  std::int64_t common_ns = 0;  ///< How long every take recorded,
  std::int64_t all_ns = 0;     ///< and any of them did.
};

/// Joins takes of different cameras that were recorded at the same time in the same world.
///
/// Videos get a second name where the disk allows it and are copied elsewhere; nothing is coded
/// anew. Cameras come in the order of the takes. All frames are kept, also of moments when some
/// take did not record: frames of a take are matched by time, and a camera may miss some. Of
/// take.toml stays what no other take contradicts; a daemon's configuration and messages stay where
/// they are.
/// @param out  a folder that does not exist yet; it has its name once all is in it.
/// @throws SetupError  naming takes and cameras: a camera that is in two, or is calibrated
/// differently; rates that differ; times that do not overlap; truth that differs.
/// @throws std::runtime_error  when something cannot be written; nothing is left then.
JoinedTake JoinTakes(std::span<const std::filesystem::path> takes,
                     const std::filesystem::path& out);

}  // namespace mocap
