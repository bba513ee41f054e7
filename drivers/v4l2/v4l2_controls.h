// Camera controls, such as exposure: set and read back.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "drivers/v4l2/v4l2_settings.h"
#include "drivers/v4l2/video_kernel.h"

namespace mocap {

/// Applies the settings, and makes the camera keep its frame rate in low light.
///
/// @param remarks  gets a line for each deviation and each automatic control: silhouettes need
///                 pictures that stay as they were learned.
/// @return  the exposure time [ns]; 0: unknown or not constant.
std::int64_t SetControls(VideoKernel& kernel, int handle, const V4l2Settings& settings,
                         std::vector<std::string>& remarks);

}  // namespace mocap
