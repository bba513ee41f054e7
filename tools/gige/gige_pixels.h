// Encodes pictures in the pixel formats of served cameras.
#pragma once

#include <arv.h>

#include <cstdint>
#include <span>

#include "core/image.h"

namespace mocap {

/// Encodes a picture in a camera's format; black if the format is not supported.
void EncodePicture(ImageView<const Bgr> picture, ArvPixelFormat format,
                   std::span<std::uint8_t> out);

}  // namespace mocap
