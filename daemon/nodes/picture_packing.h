// What a camera's thread hands on, as few bytes.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/reconstruction/silhouette/shading.h"
#include "core/reconstruction/silhouette/silhouette.h"

namespace mocap {

/// Packs a silhouette and its shading: runs of pixels by row, tiles by runs of one shade. All
/// numbers are LEB128. Nothing is lost: unpacked, they are the same bit for bit.
/// @pre  silhouette and shading are of one picture.
/// @param bytes  overwritten; its memory is reused.
void PackPicture(const Silhouette& silhouette, const Shading& shading,
                 std::vector<std::uint8_t>& bytes);

/// Takes what PackPicture made; the memory of silhouette and shading is reused.
/// @param bytes  may be anything.
/// @param width_px, height_px  of the picture that is expected.
/// @return  false when the bytes are not those of such a picture; silhouette and shading are then
///          of no use.
bool UnpackPicture(std::span<const std::uint8_t> bytes, int width_px, int height_px,
                   Silhouette& silhouette, Shading& shading);

}  // namespace mocap
