// Which of several tracked people is which of several true ones, frame by frame.
#pragma once

#include <span>
#include <vector>

#include "core/evaluation/accuracy.h"

namespace mocap {

/// Whoever is farther away, on average over the scored points, is somebody else or nobody.
inline constexpr double kSamePersonMm = 500;

/// A frame in which a tracked person is a true one.
struct PersonMatch {
  int pose = 0;    ///< Its place among the frames of the tracked person.
  int person = 0;  ///< The true one,
  int frame = 0;   ///< and the place among his frames.
  double mean_mm = 0;
};

/// Whom a tracked person was.
struct MatchedPerson {
  std::vector<PersonMatch> matches;  ///< In the order of time.
  int duplicates = 0;  ///< Frames in which he was near somebody whom another one is already.
};

/// Matches people one to one in each true frame: whoever was the same person in the frame before
/// stays so while he is near enough; of the others, the nearest first.
///
/// @param truth    frames of each true person, in the order of time; only those in which he is
///                 there.
/// @param tracked  of each tracked person; frames that are not `tracked` are nobody's.
/// @return  of each tracked person.
std::vector<MatchedPerson> MatchPeople(std::span<const std::vector<ScoredFrame>> truth,
                                       std::span<const std::vector<ScoredFrame>> tracked);

}  // namespace mocap
