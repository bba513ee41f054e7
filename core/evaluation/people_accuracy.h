// §8 for several people: who was tracked by whom, how well, and who was tracked though nobody was
// there.
#pragma once

#include <map>
#include <span>
#include <vector>

#include "core/evaluation/accuracy.h"

namespace mocap {

/// A person who was really present in a set.
struct TruePresence {
  ScoredPoints points_W = ScoredPoints::Zero();
  bool whole = false;    ///< All of the body was in the room.
  bool covered = false;  ///< And within the borders of four pictures or more.
};

/// One person, by number of the set: the sets in which any part of the body was in the room.
using PresenceBySet = std::map<int, TruePresence>;
/// One person, by number of the set: the sets in which the state was tracked.
using PosesBySet = std::map<int, ScoredPoints>;

/// Tracking quality for one true person, over the sets in which the whole person had been in the
/// room for a while.
struct PersonAccuracy {
  int followed_by = -1;              ///< Who tracks this person best over all sets; -1: nobody.
  DistanceSummary distance_mm = {};  ///< For that one, where near; the mean is the MPJPE.
  double mean_angle_rad = 0;         ///< Likewise.
  int covered_sets = 0;              ///< In which the person was also covered.
  double covered_share = 0;          ///< Share of these with tracking by that one,
  double covered_found_share = 0;    ///< and by anybody.
  int sets_to_first = -1;            ///< From the first covered set until anybody tracks.
  int longest_lost_sets = 0;  ///< Longest run of covered sets, after that, without tracking; all
                              ///< covered sets if nobody ever tracked.
  int switches = 0;           ///< How often the one who tracks changed.
};

struct PeopleAccuracy {
  std::vector<PersonAccuracy> people = {};  ///< One for each true person.
  double mpjpe_mm = 0;                      ///< Over all points of all of them.
  int phantom_sets = 0;                     ///< Tracked people where nobody was, summed over sets.
  int duplicate_sets = 0;  ///< The same where another one already tracked the person.
};

/// Compares tracked people with people who were present.
///
/// In each set, people are assigned one to one, nearest trunks first. No pair is farther apart than
/// kNearMm.
///
/// @param settle_sets  number of sets after a person's entry before errors count.
PeopleAccuracy MeasurePeople(std::span<const PresenceBySet> truth,
                             std::span<const PosesBySet> followed, int settle_sets);

/// A trunk farther than this from the true one belongs to somebody else or to nobody.
inline constexpr double kNearMm = 500;

}  // namespace mocap
