// Beyond the paper: whose the rays of the outlines are.
#pragma once

#include <span>
#include <vector>

#include "core/people/flesh_division.h"
#include "core/people/posed_person.h"
#include "core/reconstruction/silhouette/outline.h"

namespace mocap {

/// The rays of one set that somebody has.
struct OutlineShare {
  std::vector<Outline> own;   ///< That graze the person; one outline a camera.
  std::vector<Outline> near;  ///< That pass near, whomever they graze.
  /// Cameras that show the person where nobody else is.
  int witnesses = 0;
};

/// Divides the rays that graze the people in a room. Reuses its memory.
///
/// A ray is the person's whose flesh it touches; of several, and where it touches none, the one's
/// whose body, as predicted, it grazes best: it passes near, and faces the same way. Rays that no
/// body explains are for strangers whom they pass, and for all whose flesh they touch: a limb that
/// was lost may be anybody's.
class OutlineDivision {
 public:
  /// @param flesh  of the same set, divided among the same people.
  void Divide(std::span<const Outline> outlines, std::span<const PosedPerson> people,
              const FleshDivision& flesh);

  /// One for each person, then one for each stranger, in their order.
  const std::vector<OutlineShare>& shares() const { return shares_; }

 private:
  struct Passed {
    std::size_t share;
    double mismatch_mm;
    bool touches;
  };
  void DivideRay(const GrazingRay& ray, std::size_t camera, std::span<const PosedPerson> people,
                 const FleshDivision& flesh);
  void ShareAmongTouched(const GrazingRay& ray, std::size_t camera, const Passed& owner,
                         std::size_t people);
  const Passed* OwnerOf(const GrazingRay& ray, std::span<const PosedPerson> people,
                        const FleshDivision& flesh);
  void CountWitnesses();

  std::vector<OutlineShare> shares_;
  std::vector<std::vector<int>> sole_;  // Rays of each that are nobody else's, by camera.
  std::vector<Passed> passed_;          // Whose boxes a ray passes through.
};

}  // namespace mocap
