// Packs trimaps for sending into few bytes.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/reconstruction/silhouette/shading.h"
#include "core/reconstruction/silhouette/trimap.h"

namespace mocap {

/// Packs a trimap and its shading losslessly: runs of pixels by row, tiles by runs of one shade.
/// All numbers are LEB128.
/// @pre  trimap and shading belong to the same picture.
/// @param bytes  overwritten; its memory is reused.
void PackPicture(const Trimap& trimap, const Shading& shading, std::vector<std::uint8_t>& bytes);

/// Unpacks the output of PackPicture. The memory of trimap and shading is reused.
/// @param bytes  may contain anything.
/// @param width_px, height_px  of the expected picture.
/// @return  false if the bytes do not encode such a picture; trimap and shading are then invalid.
bool UnpackPicture(std::span<const std::uint8_t> bytes, int width_px, int height_px, Trimap& trimap,
                   Shading& shading);

}  // namespace mocap
