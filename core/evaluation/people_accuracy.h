// §8 for several people: who was followed by whom, how well, and who was followed though nobody was
// there.
#pragma once

#include <map>
#include <span>
#include <vector>

#include "core/evaluation/accuracy.h"

namespace mocap {

/// Somebody who truly was there in a set.
struct TruePresence {
  ScoredPoints points_W = ScoredPoints::Zero();
  bool whole = false;    ///< All of the body was in the room.
  bool covered = false;  ///< And within the borders of four pictures or more.
};

/// Of one person, by the number of the set: those in which any part of the body was in the room.
using PresenceBySet = std::map<int, TruePresence>;
/// Of one person, by the number of the set: those in which he was called tracked.
using PosesBySet = std::map<int, ScoredPoints>;

/// How well one true person was followed, over the sets in which he was whole in the room, and had
/// been for a while.
struct PersonAccuracy {
  int followed_by = -1;              ///< Who follows him best over all; -1: nobody does.
  DistanceSummary distance_mm = {};  ///< Of that one, where near; the mean is the MPJPE.
  double mean_angle_rad = 0;         ///< Likewise.
  int covered_sets = 0;              ///< In which he was covered, too.
  double covered_share = 0;          ///< Of those: followed by that one,
  double covered_found_share = 0;    ///< and by anybody.
  int sets_to_first = -1;            ///< From the first covered set until anybody follows him.
  int longest_lost_sets = 0;         ///< Covered ones on end, after that, in which nobody did.
  int switches = 0;                  ///< How often it became somebody else who follows him.
};

struct PeopleAccuracy {
  std::vector<PersonAccuracy> people = {};  ///< As many as true ones.
  double mpjpe_mm = 0;                      ///< Over all points of all of them.
  int phantom_sets = 0;    ///< Sets in which somebody was followed where nobody was, for each.
  int duplicate_sets = 0;  ///< The same where somebody was whom another one followed.
};

/// Compares those who were followed with those who were there.
///
/// Of each set, who follows whom is decided one to one, nearest trunks first; farther than
/// kNearMm nobody follows anybody.
///
/// @param settle_sets  errors count from so many sets after somebody had come in.
PeopleAccuracy MeasurePeople(std::span<const PresenceBySet> truth,
                             std::span<const PosesBySet> followed, int settle_sets);

/// A trunk farther than this from the true one is somebody else's, or nobody's.
inline constexpr double kNearMm = 500;

}  // namespace mocap
