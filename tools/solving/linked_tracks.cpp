#include "tools/solving/linked_tracks.h"

#include <string>
#include <vector>

#include "core/body/recognition.h"

namespace mocap {
namespace {

// Somebody who is found so soon after somebody was lost, and so near, is the same person: as far as
// one walks meanwhile.
struct Nearby {
  double within_s = 1, stride_mm = 600, walk_mm_s = 1000;
};
constexpr Nearby kNearby{};

double ApartMm(const PersonTrack& before, const PersonTrack& after) {
  return (after.poses.front()->X_WT.p - before.poses.back()->X_WT.p).norm();
}

bool GoesOn(const PersonTrack& before, const PersonTrack& after, const RecordedSets& sets) {
  const double apart_s = TimeBetween_s(sets, before.end() - 1, after.first);
  return apart_s <= kNearby.within_s &&
         ApartMm(before, after) < kNearby.stride_mm + kNearby.walk_mm_s * apart_s;
}

// The number of the person who goes on in a track; 0: nobody who is known.
int NumberOf(const PersonTrack& track, const std::map<int, PersonTrack>& people,
             const RecordedSets& sets) {
  std::vector<KnownPerson> absent;
  int nearest = 0;
  for (const auto& [number, person] : people) {
    if (person.end() > track.first) continue;
    absent.push_back({std::to_string(number), person.body.sizes()});
    if (!GoesOn(person, track, sets)) continue;
    if (nearest == 0 || ApartMm(person, track) < ApartMm(people.at(nearest), track))
      nearest = number;
  }
  if (nearest > 0) return nearest;
  const Likeness likeness = WhoIs(track.body.sizes(), absent);
  const bool is_sure = likeness.person && likeness.certainty >= kSureOfName;
  return is_sure ? std::stoi(likeness.person->name) : 0;
}

void Append(const PersonTrack& track, PersonTrack& person) {
  // The sizes of whom was seen for longer are better known.
  if (track.poses.size() > person.poses.size()) person.body = track.body;
  person.poses.resize(static_cast<std::size_t>(track.first - person.first));
  person.poses.insert(person.poses.end(), track.poses.begin(), track.poses.end());
}

}  // namespace

std::map<int, PersonTrack> LinkTracks(const std::map<int, PersonTrack>& tracks,
                                      const RecordedSets& sets) {
  std::map<int, PersonTrack> people;
  for (const auto& [number, track] : tracks) {
    if (track.poses.empty()) continue;
    const int known = NumberOf(track, people, sets);
    if (known > 0) {
      Append(track, people.at(known));
    } else {
      people.emplace(number, track);
    }
  }
  return people;
}

}  // namespace mocap
