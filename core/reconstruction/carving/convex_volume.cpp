#include "core/reconstruction/carving/convex_volume.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace mocap {

void ConvexVolume::Reset(const Eigen::AlignedBox3d& box) {
  const auto corner = [&](int index) {
    return Vector3(index & 1 ? box.max().x() : box.min().x(),
                   index & 2 ? box.max().y() : box.min().y(),
                   index & 4 ? box.max().z() : box.min().z());
  };
  constexpr std::array<std::array<int, 4>, 6> kFaces = {
      {{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}}};
  faces_.Clear();
  for (const auto& face : kFaces) {
    for (const int index : face) faces_.corners.push_back(corner(index));
    faces_.ends.push_back(faces_.corners.size());
  }
}

void ConvexVolume::Clip(const Vector3& normal, double offset) {
  kept_.Clear();
  cut_.clear();
  std::size_t begin = 0;
  for (const std::size_t end : faces_.ends) {
    const std::size_t first_kept = kept_.corners.size();
    for (std::size_t i = begin; i < end; ++i) {
      const Vector3& a = faces_.corners[i];
      const Vector3& b = faces_.corners[i + 1 < end ? i + 1 : begin];
      const double beyond_a = normal.dot(a) - offset;
      const double beyond_b = normal.dot(b) - offset;
      if (beyond_a <= 0) kept_.corners.push_back(a);
      if ((beyond_a <= 0) == (beyond_b <= 0)) continue;
      kept_.corners.push_back(a + beyond_a / (beyond_a - beyond_b) * (b - a));
      cut_.push_back({kept_.corners.back()});
    }
    begin = end;
    if (kept_.corners.size() >= first_kept + 3)
      kept_.ends.push_back(kept_.corners.size());
    else
      kept_.corners.resize(first_kept);
  }
  if (cut_.size() >= 3) {
    SortCut(normal.normalized());
    for (const Cut& cut : cut_) kept_.corners.push_back(cut.point);
    kept_.ends.push_back(kept_.corners.size());
  }
  std::swap(faces_, kept_);
}

// Sorts the points of a cut by their angle around the centroid.
void ConvexVolume::SortCut(const Vector3& normal) {
  Vector3 middle = Vector3::Zero();
  for (const Cut& cut : cut_) middle += cut.point / static_cast<double>(cut_.size());
  const Vector3 u = normal.unitOrthogonal();
  const Vector3 v = normal.cross(u);
  for (Cut& cut : cut_)
    cut.angle = std::atan2(v.dot(cut.point - middle), u.dot(cut.point - middle));
  std::sort(cut_.begin(), cut_.end(), [](const Cut& a, const Cut& b) { return a.angle < b.angle; });
}

Eigen::AlignedBox3d ConvexVolume::Extent() const {
  Eigen::AlignedBox3d extent;
  for (const Vector3& corner : faces_.corners) extent.extend(corner);
  return extent;
}

}  // namespace mocap
