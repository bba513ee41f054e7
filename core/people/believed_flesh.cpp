#include "core/people/believed_flesh.h"

namespace mocap {

const VoxelGrid& BelievedFlesh::Of(const Sighting& room, std::span<const PosedPerson> people) {
  if (room.doubtful.empty() || people.empty()) return room.flesh;
  flesh_ = room.flesh;
  for (const PosedPerson& person : people)
    if (person.handicap_mm == 0) AddCellsWithin(person, room.doubtful, flesh_);
  return flesh_;
}

}  // namespace mocap
