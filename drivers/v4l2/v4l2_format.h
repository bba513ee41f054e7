// Which of a camera's formats is taken.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "drivers/camera_request.h"
#include "drivers/pixels/pixel_format.h"
#include "drivers/v4l2/video_kernel.h"

namespace mocap {

/// What the camera was set to.
struct V4l2Format {
  std::string name;  ///< Its fourcc.
  PixelFormat pixels = PixelFormat::kGrey;
  int width_px = 0, height_px = 0;
  std::size_t stride_bytes = 0;
  double fps = 0;  ///< 0: the camera does not tell.
};

/// Gives one line for each format that the camera offers: sizes, and the most frames a second.
std::vector<std::string> DescribeFormats(VideoKernel& kernel, int handle);

/// Sets format, size and rate.
///
/// Of the formats that this program reads the first is taken that has the size and keeps the rate;
/// what is compressed comes last.
/// @param wanted   a fourcc; empty: any.
/// @param where    the camera's name in messages.
/// @param remarks  gets a line when the rate is another one.
/// @throws SetupError  when the camera has no such format or size.
V4l2Format SetFormat(VideoKernel& kernel, int handle, const std::string& where,
                     const CameraRequest& request, const std::string& wanted,
                     std::vector<std::string>& remarks);

}  // namespace mocap
