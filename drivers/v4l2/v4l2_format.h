// Choice of a camera's format.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "drivers/camera_request.h"
#include "drivers/pixels/pixel_format.h"
#include "drivers/v4l2/video_kernel.h"

namespace mocap {

/// The format that the camera was set to.
struct V4l2Format {
  std::string name;  ///< Its FourCC.
  PixelFormat pixels = PixelFormat::kGrey;
  int width_px = 0, height_px = 0;
  std::size_t stride_bytes = 0;
  double fps = 0;  ///< 0: not reported by the camera.
};

/// Returns one line for each format of the camera: sizes, and the highest frame rate.
std::vector<std::string> DescribeFormats(VideoKernel& kernel, int handle);

/// Sets format, size and rate.
///
/// Uses the first supported format that has the size and keeps the rate; compressed formats come
/// last.
/// @param wanted   a FourCC; empty: any.
/// @param where    the camera's name in messages.
/// @param remarks  gets a line if the rate differs.
/// @throws SetupError  when the camera has no such format or size.
V4l2Format SetFormat(VideoKernel& kernel, int handle, const std::string& where,
                     const CameraRequest& request, const std::string& wanted,
                     std::vector<std::string>& remarks);

}  // namespace mocap
