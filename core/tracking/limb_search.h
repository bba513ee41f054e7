// §6.2: one limb against the evidence that the rest of the body leaves open.
#pragma once

#include <vector>

#include "core/body/body_model.h"
#include "core/tracking/contact_matcher.h"
#include "core/tracking/evidence.h"

namespace mocap {

/// The evidence that a limb explains in a certain stance.
struct LimbClaim {
  std::vector<double> distances_mm;  ///< Of each open contact to the limb or the rest of the body.
  double own_cost_mm = 0;            ///< For lying in the void, and running into other parts.
};

/// Fits the joints of one limb while the rest of the body keeps its pose. Reuses its memory.
class LimbSearch {
 public:
  /// Turns to a limb; before all else.
  /// @param body, evidence, contacts  borrowed until the next Begin.
  /// @param limb_end  the segment at the limb's end: a hand or a foot.
  /// @param absent    the end of another limb that is to be ignored, or the same.
  /// @param pose      of the whole body; the limb's angles in it do not matter.
  void Begin(const BodyModel& body, const Evidence& evidence, ContactMatcher& contacts,
             Segment limb_end, Segment absent, const PoseState& pose);

  /// Cost of the limb with the angles that it has in `pose` [mm]; comparable between poses that
  /// differ in this limb alone.
  double CostAt(const PoseState& pose);
  /// The same in parts: what it explains of each contact that is open, and what it costs by itself.
  /// @return  valid until the next call.
  const LimbClaim& ClaimAt(const PoseState& pose);
  /// Cost of two limbs together. @pre each was searched with the other absent.
  double JointCost(const LimbClaim& limb, const LimbClaim& other) const;
  /// Improves the limb's angles from those in `pose`.
  void Refine(PoseState& pose, int iterations);
  /// Where the limb ends with the angles that it has in `pose`: p_WQ.
  Vector3 TipAt(const PoseState& pose);
  /// Rows of the joints that move the limb and nothing of the trunk, the limb's end last.
  const std::vector<int>& rows() const { return rows_; }

 private:
  struct OpenContact {
    double other_mm;  ///< How far the rest of the body is from it.
    double weight;
  };
  struct Pair {
    int capsule, other;
  };
  void ListRows(Segment limb_end, std::vector<int>& rows) const;
  void TakeBodyApart(const PoseState& pose);
  void OpenContacts(ContactMatcher& contacts);
  void PoseLimb(const PoseState& pose);
  double OverlapCost() const;

  const BodyModel* body_ = nullptr;
  const VoxelCloud* cloud_ = nullptr;
  const PlaceColumns* surface_W_ = nullptr;
  std::vector<int> rows_;
  std::vector<int> absent_rows_;
  std::vector<int> capsules_;         ///< Of the limb, in the body's shape().
  std::vector<int> other_capsules_;   ///< Of the rest, likewise.
  std::vector<PosedCapsule> others_;  ///< The rest of the body.
  std::vector<Pair> overlapping_;   ///< Of posed_ and others_, where they may run into each other.
  ContactMatcher open_;             ///< The contacts that the rest of the body does not explain.
  std::vector<OpenContact> terms_;  ///< Of each of them.
  Posture posture_;
  std::vector<PosedCapsule> posed_;  ///< The limb.
  LimbClaim claim_;
  // While a search begins.
  std::vector<PosedCapsule> all_;
  std::vector<Contact> contacts_;
};

}  // namespace mocap
