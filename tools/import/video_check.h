// Checks of videos before any work that takes long.
#pragma once

#include "tools/import/import_take.h"

namespace mocap {

/// Opens each video and reads its times.
/// @throws SetupError  in one line, what is wrong with each camera: missing, no video, another size
/// than the calibration's, too short, on a pan-tilt head.
std::vector<ImportedCamera> CheckVideos(const ImportRequest& request,
                                        std::vector<std::string>& remarks);

/// A stretch of the take's clock.
struct CommonTime {
  std::int64_t begin_ns = 0, end_ns = 0;

  double length_s() const { return static_cast<double>(end_ns - begin_ns) / 1e9; }
};

/// The time in which all cameras film. A remark names a camera that shortens it much.
/// @throws SetupError  if there is none, naming the two that are farthest apart.
CommonTime RequireCommonTime(const std::vector<ImportedCamera>& cameras,
                             std::vector<std::string>& remarks);

/// Measures how far the pictures of each camera are from those of the fastest one at the same time.
void MeasureApart(std::vector<ImportedCamera>& cameras);

}  // namespace mocap
