// §4: the lookup table from the undistorted sensor plane to pixels.
#pragma once

#include <cstdint>
#include <vector>

#include "core/reconstruction/camera_model.h"

namespace mocap {

/// Maps quantised (Xu/f, Yu/f) to the nearest pixel, within half a pixel of the exact formula.
///
/// Depends on the lens alone: built once, it serves every pan and tilt. Run time never evaluates a
/// lens. Mikić et al. 2003, §4.
class SensorPlaneTable {
 public:
  struct Pixel {
    std::int16_t x = -1;  ///< Negative: outside the picture.
    std::int16_t y = -1;
  };

  explicit SensorPlaneTable(const CameraCalibration& camera);

  /// Finds the pixel of a direction; outside the picture both coordinates are negative.
  Pixel Lookup(double xu_over_f, double yu_over_f) const;

 private:
  double origin_x_ = 0, origin_y_ = 0;
  double cells_per_unit_x_ = 0, cells_per_unit_y_ = 0;
  int columns_ = 0, rows_ = 0;
  std::vector<Pixel> cells_;
};

}  // namespace mocap
