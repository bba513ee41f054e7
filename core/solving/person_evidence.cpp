#include "core/solving/person_evidence.h"

#include "core/hypotheses/pose_filter.h"
#include "core/reconstruction/carving/voxel_block.h"

namespace mocap {
void PersonEvidence::PoseOthers(int set) {
  posed_.clear();
  for (std::size_t i = 0; i < everybody_.size(); ++i) {
    const PoseState* const pose = i == person_ ? nullptr : everybody_[i].At(set);
    if (pose) PosePerson(everybody_[i].body, *pose, kReachMm, posed_.emplace_back());
  }
}

const Evidence& PersonEvidence::In(const RecordedSet& recorded, int set, const PoseState* pose) {
  PoseOthers(set);
  const bool is_alone = posed_.empty();
  if (pose) PosePerson(track().body, *pose, kReachMm, posed_.emplace_back());
  thinned_.resize(recorded.outlines.size());
  for (std::size_t i = 0; i < thinned_.size(); ++i)
    ThinOutline(recorded.outlines[i], is_alone ? fineness_ : 1, thinned_[i]);
  if (is_alone) {
    GatherAlone(recorded, set, pose);
  } else {
    GatherShare(recorded, set, pose);
  }
  return evidence_;
}

std::optional<PoseStep> PersonEvidence::RateAt(int set) const {
  const int before = track().At(set - 1) ? set - 1 : set,
            after = track().At(set + 1) ? set + 1 : set;
  if (before == after || !track().At(before) || !track().At(after)) return std::nullopt;
  const double between_s = TimeBetween_s(sets_, before, after);
  // Over a longer time, poses do not show how somebody moved between them.
  if (between_s <= 0 || between_s > MotionNoise{}.velocity_decay_s) return std::nullopt;
  return track().At(after)->Minus(*track().At(before)) / between_s;
}

void PersonEvidence::Gather(const Observation& observation, int set, const PoseState* pose) {
  const auto rate = pose ? RateAt(set) : std::nullopt;
  if (!rate) {
    evidence_.Gather(observation);
    return;
  }
  const PersonMotion motion{track().body, [&](double after_s) {
                              PoseState then = *pose;
                              then.Add(*rate * after_s);
                              return then;
                            }};
  evidence_.Gather(observation, &motion);
}

void PersonEvidence::GatherAlone(const RecordedSet& recorded, int set, const PoseState* pose) {
  Observation room(recorded.grid, thinned_, recorded.person_box_W);
  room.doubtful = recorded.doubtful;
  const VoxelGrid& believed = pose ? BelieveWithin(posed_, room, believed_) : recorded.grid;
  Gather({VoxelsWithin(believed, room.box_W, flesh_of_one_), thinned_, recorded.person_box_W}, set,
         pose);
}

void PersonEvidence::GatherShare(const RecordedSet& recorded, int set, const PoseState* pose) {
  const bool is_known = pose != nullptr;
  Observation room(recorded.grid, thinned_, recorded.person_box_W);
  room.doubtful = recorded.doubtful;
  flesh_.Divide(BelieveWithin(posed_, room, believed_), posed_);
  outlines_.Divide(thinned_, posed_, flesh_);
  // The person comes after all others, and so does the largest stranger.
  const std::size_t place = is_known ? posed_.size() - 1 : posed_.size();
  if (place >= flesh_.shares().size()) {
    evidence_.Gather({VoxelGrid(), {}});
    return;
  }
  const FleshShare& flesh = flesh_.shares()[place];
  const OutlineShare& outlines = outlines_.shares()[place];
  const Eigen::AlignedBox3d box_W =
      is_known ? DownToFloor(posed_.back().box_W, kAsideMm - kReachMm).merged(flesh.box_W)
               : AroundStranger(flesh.box_W);
  Gather({flesh.flesh, outlines.own, box_W, flesh.room, outlines.near}, set, pose);
}

}  // namespace mocap
