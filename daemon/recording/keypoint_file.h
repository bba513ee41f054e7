// The keypoints of a take that is being recorded.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "core/evidence/keypoint_view.h"

namespace mocap {

/// Writes keypoints as they come, as ReadKeypoints expects them. The file is made with the first.
/// Thread-bound.
class KeypointFile {
 public:
  explicit KeypointFile(std::filesystem::path file) : file_(std::move(file)) {}

  /// Appends a view. If the picture already has a person of its number, as from another sender, it
  /// gets a free one.
  /// @throws std::runtime_error  here and below, if it cannot be written.
  void Write(KeypointView view);
  /// Passes written data to the operating system.
  void Flush();

 private:
  using Picture = std::pair<std::int64_t, std::string>;  ///< Time and camera.

  int FreeNumber(const KeypointView& view);
  void RequireGood() const;

  const std::filesystem::path file_;
  std::ofstream out_;
  std::map<Picture, std::set<int>> numbers_;  ///< Of people in late pictures.
};

}  // namespace mocap
