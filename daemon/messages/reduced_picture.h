// Reduces pictures and silhouettes by an integer factor, for viewers.
#pragma once

#include <cstdint>
#include <vector>

#include "core/image.h"
#include "core/reconstruction/silhouette/silhouette.h"

namespace mocap {

/// The smallest factor by which a picture becomes no wider than `widest_px`.
int ReductionFor(int width_px, int widest_px);

/// Averages squares of `factor` pixels. Incomplete squares at the right and lower border are
/// omitted.
/// @param reduced  overwritten; its memory is reused.
void ReducePicture(ImageView<const Bgr> picture, int factor, Image<Bgr>& reduced);

/// Writes a silhouette, reduced likewise, as run lengths, row after row: empty and covered runs
/// alternate, empty first. A square counts as covered if at least half of it is.
void ReduceSilhouette(const Silhouette& silhouette, int factor, std::vector<std::int32_t>& runs);

/// Reads such runs. Runs beyond the picture are ignored.
Silhouette SilhouetteFromRuns(const std::vector<std::int32_t>& runs, int width, int height);

}  // namespace mocap
