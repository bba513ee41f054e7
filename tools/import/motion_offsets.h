// Offsets between recordings, from the silhouettes of people who move.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "tools/import/pair_offsets.h"
#include "tools/import/silhouette_hull.h"

namespace mocap {

/// Finds the clocks of cameras whose silhouettes show the same people.
///
/// At the right offsets, the planes through two lenses that touch a person are the same for both
/// cameras (TangentTrack). The search tries all offsets in steps of half a frame, for all pairs,
/// and places one camera after the other where it agrees most with those before it. Then the offset
/// of each pair is refined between frames, with a constant error of the silhouettes taken out, and
/// all pairs are balanced.
/// @param known  clocks that stay as they are; without any, camera 0 is the reference.
/// @param check  called again and again; may throw to end.
/// @return  clearness: agreement, over that of the best other offset. A camera that agrees nowhere
/// is not known.
std::vector<ClockFit> ClocksByMotion(std::span<const CameraHulls> cameras,
                                     const std::vector<ClockFit>& known,
                                     const std::function<void()>& check);

}  // namespace mocap
