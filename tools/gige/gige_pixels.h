// Pictures in the formats that served cameras send.
#pragma once

#include <arv.h>

#include <cstdint>
#include <span>

#include "core/image.h"

namespace mocap {

/// Writes a picture as a camera of that format would send it; black where the format is none that
/// is served.
void EncodePicture(ImageView<const Bgr> picture, ArvPixelFormat format,
                   std::span<std::uint8_t> out);

}  // namespace mocap
