// How unequally late cameras hear the same sound.
#pragma once

#include <span>
#include <vector>

#include "core/reconstruction/camera/camera_model.h"

namespace mocap {

/// How long sound needs to a camera: 3 ms for a metre.
struct SoundTravel {
  double from_middle_s = 0;  ///< From the middle of the room, where people clap.
  /// Standard deviation, against the mean of all cameras, because nobody knows where in the room it
  /// came from: somewhere within 1 m of the middle.
  double sigma_s = 0;
};

/// @return  in the order of the cameras.
std::vector<SoundTravel> SoundTravels(std::span<const CameraCalibration> cameras);

}  // namespace mocap
