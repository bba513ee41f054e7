// Copies the coded pictures of a video, without decoding them.
#pragma once

#include <filesystem>
#include <functional>

#include "drivers/take/picture_turn.h"

namespace mocap {

/// Copies a video's coded pictures, without its sound, into a Matroska file.
///
/// The rotation for display becomes a tag, which VideoReader knows.
/// @param check  called for each picture; may throw to end.
/// @return  false if Matroska holds neither this codec nor this rotation; nothing is left then.
/// @throws SetupError  naming the file that is no video; std::runtime_error  when the other cannot
/// be written.
bool CopyVideo(
    const std::filesystem::path& from, const std::filesystem::path& to, const PictureTurn& turn,
    const std::function<void()>& check = [] {});

}  // namespace mocap
