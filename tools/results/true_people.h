// Truth of a take of several people.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/results/take_truth.h"

namespace mocap {

struct TruePerson {
  std::string name;  ///< Folder name, such as person-1; "truth" if the take has one person's.
  TakeTruth truth;
  /// Whether enough pictures show the whole person, in each frame of the truth. True for all frames
  /// if take.toml does not say.
  std::vector<bool> covered;
};

/// Reads TAKE/person-K, or the take's own truth, and `covered` of [[person]] in take.toml. Skips
/// people who never entered the room.
/// @return  empty for a take without truth.
/// @throws SetupError  as ReadTakeTruth, and for invalid ranges of frames.
std::vector<TruePerson> ReadTruePeople(const std::filesystem::path& take);

}  // namespace mocap
