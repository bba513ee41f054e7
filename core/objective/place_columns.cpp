#include "core/objective/place_columns.h"

#include <limits>

#include "core/kernels/nearest.h"

namespace mocap {

void PlaceColumns::Set(std::span<const Contact> contacts) {
  for (std::vector<double>& axis : axes_) axis.clear();
  for (const Contact& contact : contacts) {
    if (contact.is_edge) continue;
    for (int axis = 0; axis < 3; ++axis) axes_[axis].push_back(contact.from_W[axis]);
  }
  size_ = static_cast<int>(axes_[0].size());
  const auto whole = static_cast<std::size_t>((size_ + kernels::kPointStep - 1) /
                                              kernels::kPointStep * kernels::kPointStep);
  for (std::vector<double>& axis : axes_)
    axis.resize(whole, std::numeric_limits<double>::infinity());
}

Vector3 PlaceColumns::NearestTo(const Vector3& p_W) const {
  const int i = kernels::FindNearestPoint(axes_[0].data(), axes_[1].data(), axes_[2].data(), size_,
                                          {p_W.x(), p_W.y(), p_W.z()});
  return {axes_[0][i], axes_[1][i], axes_[2][i]};
}

}  // namespace mocap
