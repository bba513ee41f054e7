// The truth of a take of several people.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/results/take_truth.h"

namespace mocap {

struct TruePerson {
  std::string name;  ///< Of the folder, as person-1; "truth" where the take has one person's.
  TakeTruth truth;
  /// Whether enough pictures show him as a whole, in each frame of the truth. Where take.toml does
  /// not tell, in all.
  std::vector<bool> covered;
};

/// Reads TAKE/person-K, or the truth of the take itself; `covered` of [[person]] in take.toml. Who
/// never came into the room is left out.
/// @return  none for a take without truth.
/// @throws SetupError  as ReadTakeTruth, and for stretches of frames that are none.
std::vector<TruePerson> ReadTruePeople(const std::filesystem::path& take);

}  // namespace mocap
