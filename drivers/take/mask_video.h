// Masks as gray video: 0 and 255.
#pragma once

#include <filesystem>

#include "core/image.h"
#include "core/reconstruction/silhouette/silhouette.h"

namespace mocap {

/// Sets the pixels of a mask's white parts. Overwrites `silhouette`, whose memory is reused.
void TakeWhite(ImageView<const Bgr> mask, Silhouette& silhouette);

/// Writes one mask. @throws SetupError, std::runtime_error  as VideoWriter.
void WriteMask(const std::filesystem::path& file, const Silhouette& silhouette);

/// Reads the first mask of a file. @throws SetupError  as VideoReader.
Silhouette ReadMask(const std::filesystem::path& file);

}  // namespace mocap
