// Offsets between recordings, from the sounds that all of them heard.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "drivers/take/sound_reader.h"
#include "tools/import/pair_offsets.h"

namespace mocap {

/// Finds how far one recording of the same sounds is ahead of another one, whatever the loudness
/// and the echoes of each.
///
/// Onsets of sounds, correlated over the whole recordings, give candidates. At each of these, short
/// stretches about the clearest onsets are compared by generalised cross-correlation with phase
/// transform (Knapp and Carter 1976), which is sharp where echoes are long. The candidate with the
/// most stretches in agreement wins. Stretches minutes apart also tell how the clocks drift.
/// Sound needs 3 ms for a metre, which is not corrected here.
/// @return  empty if no offset is clearly better than chance.
std::optional<PairOffset> SoundOffset(const SoundTrack& first, const SoundTrack& second);

/// Compares all pairs of recordings that have sound.
/// @param tracks  empty where there is none.
/// @param check   called again and again; may throw to end.
std::vector<PairOffset> SoundOffsets(std::span<const std::optional<SoundTrack>> tracks,
                                     const std::function<void()>& check);

}  // namespace mocap
