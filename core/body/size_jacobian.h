// Beyond the paper: effect of the sizes on the surface of a posed body.
#pragma once

#include <span>
#include <vector>

#include "core/body/body_model.h"

namespace mocap {

/// Differentiates the capsules of a posed body by some of its sizes. Reuses its memory.
class SizeJacobian {
 public:
  /// @param sizes  the sizes to differentiate by.
  SizeJacobian(const BodyModel& body, std::span<const SizeMember> sizes);

  /// Sets a body of the same table, and a pose.
  void Update(const BodyModel& body, const PoseState& pose);
  /// Returns how far the surface of a capsule moves outward along a normal as a size grows [mm/mm].
  /// @param share  position along the capsule's core.
  /// @param size   index among the sizes given to the constructor.
  double OutwardBySize(int capsule, double share, const Vector3& normal_W, int size) const;

 private:
  struct Size {
    SizeMember member;
    std::vector<PosedCapsule> larger;  ///< The capsules with a size that is a millimetre larger.
  };

  BodyModel varied_;
  std::vector<PosedCapsule> shape_;
  std::vector<Size> sizes_;
};

}  // namespace mocap
