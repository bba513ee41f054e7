// Beyond the paper: division of the outlines' rays among people.
#pragma once

#include <span>
#include <vector>

#include "core/people/flesh_division.h"
#include "core/people/posed_person.h"
#include "core/reconstruction/silhouette/line_range.h"
#include "core/reconstruction/silhouette/outline.h"

namespace mocap {

/// One person's rays in a set.
struct OutlineShare {
  std::vector<Outline> own;   ///< Those that graze the person; one outline per camera.
  std::vector<Outline> near;  ///< Those that pass near, whomever they graze.
  /// Cameras that show the person where nobody else is.
  int cameras = 0;
};

/// Divides the rays that graze the people in a room. Reuses its memory.
///
/// A ray belongs to the person whose flesh it touches. If it touches several people's flesh or
/// none, it belongs to the one whose predicted body it grazes best: it passes near and faces the
/// same way. Rays that no body explains go to strangers whose flesh they touch, and to all people
/// whose flesh they touch, because a lost limb may be anybody's.
class OutlineDivision {
 public:
  /// @param flesh  of the same set, divided among the same people.
  void Divide(std::span<const Outline> outlines, std::span<const PosedPerson> people,
              const FleshDivision& flesh);

  /// One for each person, then one for each stranger, in the same order.
  const std::vector<OutlineShare>& shares() const { return shares_; }

 private:
  struct Passed {
    std::size_t share;
    LineRange range;
    double mismatch_mm = kExplainsMm;  // Of a body that is unknown, too.
    bool touches = true;
  };
  void DivideRay(const GrazingRay& ray, std::size_t camera, std::span<const PosedPerson> people,
                 const FleshDivision& flesh);
  void Assign(const GrazingRay& ray, std::size_t camera, std::size_t people);

  std::vector<OutlineShare> shares_;
  std::vector<Eigen::AlignedBox3d> boxes_W_;  // Of the shares.
  std::vector<int> sole_;                     // Per share: rays of a camera that are nobody else's.
  std::vector<Passed> passed_;                // Shares whose boxes a ray passes through.
};

}  // namespace mocap
