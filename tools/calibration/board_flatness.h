// Whether corners seen in one view can lie on the plane of their board.
#pragma once

#include <optional>
#include <string>

#include "tools/calibration/detections.h"

namespace mocap {

/// How far corners lie from where their neighbours expect them on a plane. Only near neighbours are
/// compared, between which no lens bends much.
struct Unevenness {
  double rms_px = 0;
  double share = 0;  ///< Of the distance of neighbours.
};

/// Empty if too few corners have neighbours, or these are too far apart in the picture.
std::optional<Unevenness> UnevennessOf(const Board& board, const BoardCorners& corners,
                                       int width_px);

/// Refuses a camera in most of whose views, from detection `first` on, the corners lie on no plane:
/// the board is not as described, however it was held.
/// @throws SetupError  naming camera and frame.
void RefuseUneven(const std::string& where, const BoardDetections& detections, std::size_t first);

}  // namespace mocap
