// What a set shows of one of the people of a take.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/evidence/evidence.h"
#include "core/people/flesh_division.h"
#include "core/people/outline_division.h"
#include "core/people/posed_person.h"
#include "core/solving/person_track.h"
#include "core/solving/recorded_set.h"

namespace mocap {

/// Divides sets as PeopleCapture does, but by where everybody else is known to have been. Reuses
/// its memory.
class PersonEvidence {
 public:
  /// @param everybody  tracks of all people of the take; borrowed.
  /// @param fineness   as in PeopleOptions.
  /// @param sets       of the take; borrowed likewise.
  PersonEvidence(const RecordedSets& sets, std::span<const PersonTrack> everybody,
                 std::size_t person, int fineness)
      : sets_(sets), everybody_(everybody), person_(person), fineness_(fineness) {}

  const PersonTrack& track() const { return everybody_[person_]; }
  /// Gathers what a set shows of the person; valid until the next call.
  /// @param pose  of the person; null: not known, and all that is nobody else's counts.
  const Evidence& In(const RecordedSet& recorded, int set, const PoseState* pose);

 private:
  void PoseOthers(int set);
  // How the pose changes about a set, by the track [mm/s, rad/s]; empty: not known.
  std::optional<PoseStep> RateAt(int set) const;
  void Gather(const Observation& observation, int set, const PoseState* pose);
  void GatherAlone(const RecordedSet& recorded, int set, const PoseState* pose);
  void GatherShare(const RecordedSet& recorded, int set, const PoseState* pose);

  const RecordedSets& sets_;
  std::span<const PersonTrack> everybody_;
  std::size_t person_;
  int fineness_;
  std::vector<PosedPerson> posed_;  ///< The others, then the person if the pose is known.
  VoxelGrid believed_, flesh_of_one_;
  std::vector<Outline> thinned_;
  FleshDivision flesh_;
  OutlineDivision outlines_;
  Evidence evidence_;
};

}  // namespace mocap
