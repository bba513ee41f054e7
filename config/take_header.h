// What a take says of itself: take.toml.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace mocap {

/// The part of take.toml that every take has; it may contain more.
struct TakeHeader {
  std::string name;
  double fps_nominal = 0;
  std::vector<std::string> cameras;
  /// Earlier pictures are left out, because not all cameras film yet; empty: none are.
  std::optional<std::int64_t> begin_ns;
};

/// Reads take.toml of a take.
/// @throws SetupError  when the folder is no take, also saying so when it is a result of tracking;
/// otherwise naming file and line.
TakeHeader ReadTakeHeader(const std::filesystem::path& take);

}  // namespace mocap
