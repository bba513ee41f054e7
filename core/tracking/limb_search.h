// §6.2: fits one limb to the evidence that the rest of the body leaves open.
#pragma once

#include <vector>

#include "core/body/body_model.h"
#include "core/tracking/carried_things.h"
#include "core/tracking/contact_matcher.h"
#include "core/tracking/evidence.h"

namespace mocap {

/// The evidence that a limb explains in one stance.
struct LimbClaim {
  std::vector<double> distances_mm;  ///< Of each open contact to the limb or the rest of the body.
  double own_cost_mm = 0;            ///< For lying in the void and intersecting other parts.
};

/// Fits the joints of one limb while the rest of the body keeps its pose. Reuses its memory.
class LimbSearch {
 public:
  /// Selects a limb; to be called first.
  /// @param body, evidence, contacts  borrowed until the next Begin.
  /// @param limb_end  the segment at the limb's end: a hand or a foot.
  /// @param absent    the end of another limb to ignore, or the same.
  /// @param pose      of the whole body; the limb's own angles do not matter.
  /// @param things    what the body may wear or carry.
  void Begin(const BodyModel& body, const Evidence& evidence, ContactMatcher& contacts,
             Segment limb_end, Segment absent, const PoseState& pose, Things things);

  /// Returns the cost of the limb with its angles in `pose` [mm]. Costs are comparable between
  /// poses that differ only in this limb.
  double CostAt(const PoseState& pose);
  /// Returns the same in parts: distances of all open contacts, and the limb's own cost.
  /// @return  valid until the next call.
  const LimbClaim& ClaimAt(const PoseState& pose);
  /// Returns the cost of two limbs together. @pre each was searched with the other absent.
  double JointCost(const LimbClaim& limb, const LimbClaim& other) const;
  /// Improves the limb's angles, starting from those in `pose`.
  void Refine(PoseState& pose, int iterations);
  /// Returns the end of the limb with its angles in `pose`: p_WQ.
  Vector3 TipAt(const PoseState& pose);
  /// Rows of the joints that move the limb but not the trunk; the limb's end is last.
  const std::vector<int>& rows() const { return rows_; }

 private:
  struct OpenContact {
    double other_mm;  ///< Distance from the rest of the body.
    double weight;
  };
  struct Pair {
    int capsule, other;
  };
  void ListRows(Segment limb_end, std::vector<int>& rows) const;
  void TakeBodyApart(const PoseState& pose);
  void OpenContacts(ContactMatcher& contacts, Things things);
  void PoseLimb(const PoseState& pose);
  double OverlapCost() const;

  const BodyModel* body_ = nullptr;
  const VoxelCloud* cloud_ = nullptr;
  double hollow_weight_ = 1;
  const PlaceColumns* surface_W_ = nullptr;
  std::vector<int> rows_;
  std::vector<int> absent_rows_;
  std::vector<int> capsules_;         ///< The limb's, as indices into the body's shape().
  std::vector<int> other_capsules_;   ///< The rest's, likewise.
  std::vector<PosedCapsule> others_;  ///< The rest of the body.
  std::vector<Pair> overlapping_;   ///< Indices into posed_ and others_, where they may intersect.
  ContactMatcher open_;             ///< The contacts that the rest of the body does not explain.
  std::vector<OpenContact> terms_;  ///< For each of them.
  Posture posture_;
  std::vector<PosedCapsule> posed_;  ///< The limb.
  LimbClaim claim_;
  // Only while a search begins.
  std::vector<PosedCapsule> all_;
  std::vector<Contact> contacts_;
};

}  // namespace mocap
