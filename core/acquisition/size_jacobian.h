// Beyond the paper: what the surface of a posed body tells of the sizes of its parts.
#pragma once

#include <span>
#include <vector>

#include "core/body/body_model.h"
#include "core/tracking/surface_fit.h"

namespace mocap {

/// Differentiates the flesh of a posed body by some of its sizes. Reuses its memory.
class SizeJacobian {
 public:
  /// @param sizes  what to differentiate by.
  SizeJacobian(const BodyModel& body, std::span<const SizeMember> sizes);

  /// Takes a body of the same table and a pose.
  void Update(const BodyModel& body, const PoseState& pose);
  /// How far the surface comes out along a residual's normal as a size grows [mm/mm].
  /// @param size  its index among those given to the constructor.
  double OutwardBySize(const SurfaceResidual& residual, int size) const;

 private:
  struct Size {
    SizeMember member;
    std::vector<PosedCapsule> larger;  ///< The flesh when it is a millimetre larger.
  };

  BodyModel varied_;
  std::vector<PosedCapsule> shape_;
  std::vector<Size> sizes_;
};

}  // namespace mocap
