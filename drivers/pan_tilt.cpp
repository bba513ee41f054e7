#include "drivers/pan_tilt.h"

#include <iomanip>
#include <sstream>

namespace mocap {

std::string OutOfReach(const PanTiltAngles& angles, const PanTiltLimits& limits) {
  const auto& [least, most] = limits;
  std::ostringstream line;
  line << std::fixed << std::setprecision(3);
  line << "pan " << angles.pan_rad << ", tilt " << angles.tilt_rad
       << " rad is out of range; expected pan " << least.pan_rad << " to " << most.pan_rad
       << ", tilt " << least.tilt_rad << " to " << most.tilt_rad << " rad";
  return line.str();
}

}  // namespace mocap
