// Pictures and silhouettes made smaller by a whole factor, for people who look.
#pragma once

#include <cstdint>
#include <vector>

#include "core/image.h"
#include "core/reconstruction/silhouette/silhouette.h"

namespace mocap {

/// The least factor by which a picture becomes no wider than `widest_px`.
int ReductionFor(int width_px, int widest_px);

/// Averages squares of `factor` pixels; what is left at the right and lower border is left out.
/// @param reduced  overwritten; its memory is used again.
void ReducePicture(ImageView<const Bgr> picture, int factor, Image<Bgr>& reduced);

/// Writes a silhouette, reduced likewise, as lengths of runs, row after row: empty first, then
/// covered and empty in turns. A square is covered where at least half of it is.
void ReduceSilhouette(const Silhouette& silhouette, int factor, std::vector<std::int32_t>& runs);

/// Reads such runs. Runs beyond the picture are left out.
Silhouette SilhouetteFromRuns(const std::vector<std::int32_t>& runs, int width, int height);

}  // namespace mocap
