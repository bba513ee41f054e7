#include "core/body/size_jacobian.h"

namespace mocap {

SizeJacobian::SizeJacobian(const BodyModel& body, std::span<const SizeMember> sizes)
    : varied_(body) {
  for (const SizeMember member : sizes) sizes_.push_back({member, {}});
}

void SizeJacobian::Update(const BodyModel& body, const PoseState& pose) {
  body.PoseShape(body.PostureAt(pose), shape_);
  for (Size& size : sizes_) {
    BodySizes larger = body.sizes();
    larger.*size.member += 1;
    varied_.Resize(larger);
    varied_.PoseShape(varied_.PostureAt(pose), size.larger);
  }
}

double SizeJacobian::OutwardBySize(int capsule, double share, const Vector3& normal_W,
                                   int size) const {
  const PosedCapsule& from = shape_[capsule];
  const PosedCapsule& to = sizes_[size].larger[capsule];
  const Vector3 moved = (1 - share) * (to.a_W - from.a_W) + share * (to.b_W - from.b_W);
  const double thicker = (1 - share) * (to.radius_a_mm - from.radius_a_mm) +
                         share * (to.radius_b_mm - from.radius_b_mm);
  return normal_W.dot(moved) + thicker;
}

}  // namespace mocap
