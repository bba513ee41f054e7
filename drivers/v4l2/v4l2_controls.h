// Exposure and the like: set, and read back.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "drivers/v4l2/v4l2_settings.h"
#include "drivers/v4l2/video_kernel.h"

namespace mocap {

/// Sets what is to be set, and that a camera keeps its frame rate in the dark.
/// @param remarks  gets a line for all that the camera did otherwise, and for what it adjusts by
///                 itself, since silhouettes need pictures that stay as they were learned.
/// @return  the exposure time [ns]; 0: unknown or not constant.
std::int64_t SetControls(VideoKernel& kernel, int handle, const V4l2Settings& settings,
                         std::vector<std::string>& remarks);

}  // namespace mocap
