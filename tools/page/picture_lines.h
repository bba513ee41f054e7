// Overlays of a camera's picture.
#pragma once

#include <vector>

#include "core/geometry.h"
#include "core/reconstruction/silhouette/silhouette.h"

namespace mocap {

/// Border lines of a reduced silhouette, in pixels of the whole picture; closed and simplified.
std::vector<std::vector<Vector2>> SilhouetteLines(const Silhouette& silhouette, int factor);

}  // namespace mocap
