// keypoints.csv as a source of keypoints for a take.
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "daemon/pipeline/keypoint_source.h"

namespace mocap {

/// Gives each set of a take the keypoints of its pictures.
class RecordedKeypoints : public KeypointSource {
 public:
  /// @throws SetupError  for a file that cannot be read, or that names none of the cameras.
  RecordedKeypoints(const std::filesystem::path& file, std::span<const std::string> cameras);

  void TakeFor(std::int64_t capture_ns, std::vector<KeypointView>& views) override;

 private:
  std::vector<KeypointView> views_;  ///< In order of time.
  std::size_t next_ = 0;
};

}  // namespace mocap
