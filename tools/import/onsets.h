// Onsets of sounds, such as claps, steps and words.
#pragma once

#include <cstddef>
#include <vector>

#include "drivers/take/sound_reader.h"

namespace mocap {

/// Onsets are told this often.
inline constexpr int kOnsetRate_hz = 100;

/// How much louder each hundredth of a second is than the one before it [nepers of energy], as far
/// as it stands out of the recording's usual noise; never negative.
std::vector<float> OnsetsOf(const SoundTrack& track);

/// Shifts at which onsets of two recordings agree most, the best first.
struct OnsetShift {
  int shift = 0;  ///< Onset k of the second is k + shift of the first.
  double agreement = 0;
};
std::vector<OnsetShift> BestShifts(const std::vector<float>& first,
                                   const std::vector<float>& second, std::size_t most);

/// The largest onsets of a part, at least a second apart; ascending.
std::vector<int> ClearestOnsets(const std::vector<float>& onsets, int begin, int end,
                                std::size_t most);

}  // namespace mocap
