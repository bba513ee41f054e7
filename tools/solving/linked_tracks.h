// One track for each person, however often he was lost, or left and came back.
#pragma once

#include <map>

#include "core/solving/person_track.h"
#include "core/solving/recorded_set.h"

namespace mocap {

/// Joins the tracks of live tracking that are of one person: one who is found where another was
/// lost a moment before, or whose sizes are those of one who has gone. A person keeps the first
/// number.
/// @param sets  of the tracks.
std::map<int, PersonTrack> LinkTracks(const std::map<int, PersonTrack>& tracks,
                                      const RecordedSets& sets);

}  // namespace mocap
