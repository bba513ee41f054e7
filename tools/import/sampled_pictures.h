// Some pictures of a video, evenly spread over it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <vector>

#include "core/image.h"

namespace mocap {

/// Chooses frames, as evenly as their times allow. @return  ascending indices: `most`, or all.
std::vector<std::size_t> SpreadFrames(std::span<const std::int64_t> times_ns, std::size_t most);

/// Decodes the chosen frames of a video. Long stretches between them are skipped, not decoded.
/// @param times_ns  of all frames of the file.
/// @param visit     gets the index of each frame that could be decoded; true: go on.
/// @throws SetupError  as VideoReader.
void VisitFrames(const std::filesystem::path& file, std::span<const std::int64_t> times_ns,
                 std::span<const std::size_t> chosen,
                 const std::function<bool(std::size_t frame, ImageView<const Bgr>)>& visit);

}  // namespace mocap
