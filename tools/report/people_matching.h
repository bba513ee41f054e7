// Matches several tracked people with true people, frame by frame.
#pragma once

#include <span>
#include <vector>

#include "core/evaluation/accuracy.h"

namespace mocap {

/// At a larger mean distance over the scored points, people do not match.
inline constexpr double kSamePersonMm = 500;

/// A match of a tracked person with a true one in a frame.
struct PersonMatch {
  int pose = 0;    ///< Index among the tracked person's frames.
  int person = 0;  ///< Index of the true person.
  int frame = 0;   ///< Index among the true person's frames.
  double mean_mm = 0;
};

/// Matches of a tracked person.
struct MatchedPerson {
  std::vector<PersonMatch> matches;  ///< In order of time.
  int duplicates = 0;                ///< Frames near a true person who is matched with another one.
};

/// Matches people one to one in each true frame. A match from the frame before is kept while it is
/// near enough; then the nearest pairs are matched first.
///
/// @param truth    frames of each true person in which the person is present, in order of time.
/// @param tracked  frames of each tracked person; frames that are not `tracked` match nobody.
/// @return  one per tracked person.
std::vector<MatchedPerson> MatchPeople(std::span<const std::vector<ScoredFrame>> truth,
                                       std::span<const std::vector<ScoredFrame>> tracked);

}  // namespace mocap
