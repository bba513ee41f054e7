// §6.2: one limb against the evidence that the rest of the body leaves open.
#pragma once

#include <vector>

#include "core/objective/objective.h"

namespace mocap {

/// The objective of a limb while the rest of the body keeps its pose. Costs microseconds, because
/// only what the rest does not explain is matched. Reuses its memory.
class LimbObjective {
 public:
  /// Selects a limb; to be called first.
  /// @param whole, body  borrowed until the next Begin.
  /// @param limb_end     the segment at the limb's end: a hand or a foot.
  /// @param absent       the end of another limb to leave out, or the same.
  /// @param pose         of the whole body; the limb's own angles do not matter.
  /// @param things       what the body may wear or carry.
  void Begin(Objective& whole, const BodyModel& body, const PoseState& pose, Segment limb_end,
             Segment absent, const Things& things);

  /// -log p of the limb with its angles in `pose` [nats]. Comparable between poses that differ only
  /// in this limb.
  double At(const PoseState& pose);
  /// -log p of the limb's bones alone, which is a quick first look.
  double FleshAt(const PoseState& pose);
  /// Improves the limb's angles, starting from those in `pose`.
  void Refine(PoseState& pose);
  /// Returns the end of the limb with its angles in `pose`: p_WQ.
  Vector3 TipAt(const PoseState& pose);
  /// Rows of the joints that move the limb but not the trunk; the limb's end is last.
  const std::vector<int>& rows() const { return rows_; }

 private:
  Objective* whole_ = nullptr;
  std::vector<int> rows_, absent_rows_;
  ComparedBody limb_;
};

}  // namespace mocap
