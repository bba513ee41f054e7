// What is drawn over a camera's picture.
#pragma once

#include <vector>

#include "core/geometry.h"
#include "core/reconstruction/silhouette/silhouette.h"

namespace mocap {

/// The borders of a silhouette that was reduced by a factor, in pixels of the whole picture, closed
/// and made simple.
std::vector<std::vector<Vector2>> SilhouetteLines(const Silhouette& silhouette, int factor);

}  // namespace mocap
