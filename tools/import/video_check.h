// Checks of videos before any work that takes long.
#pragma once

#include "tools/import/import_take.h"

namespace mocap {

/// Opens each video and reads its times.
/// @throws SetupError  in one line, what is wrong with each camera: missing, no video, another size
/// than the calibration's, too short, on a pan-tilt head.
std::vector<ImportedCamera> CheckVideos(const ImportRequest& request,
                                        std::vector<std::string>& remarks);

/// The part that all recordings have in common [s].
/// @throws SetupError  if there is none, naming the two that are farthest apart.
double RequireCommonTime(const std::vector<ImportedCamera>& cameras);

/// Measures how far the pictures of each camera are from those of the fastest one at the same time.
void MeasureApart(std::vector<ImportedCamera>& cameras);

}  // namespace mocap
