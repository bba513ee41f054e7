#include "tools/calibration/same_calibration.h"

#include <algorithm>

#include "drivers/quoted.h"
#include "drivers/take/calibration_file.h"

namespace mocap {

std::string DifferenceFrom(std::span<const CameraCalibration> other,
                           std::span<const CameraCalibration> cameras) {
  for (const CameraCalibration& wanted : other) {
    const auto found = std::ranges::find(cameras, wanted.name, &CameraCalibration::name);
    if (found == cameras.end()) return "has no camera " + Quoted(wanted.name);
    const auto text_of = [](const CameraCalibration& camera) {
      return CalibrationText("calibration", std::span(&camera, 1));
    };
    if (text_of(*found) != text_of(wanted))
      return "has camera " + Quoted(wanted.name) + " with other extrinsics or intrinsics";
  }
  return "";
}

}  // namespace mocap
