#include "core/reconstruction/convex_volume.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace mocap {
namespace {

// Puts the points of a cut into an order around their middle.
void SortAround(const Vector3& normal, std::vector<Vector3>& points) {
  Vector3 middle = Vector3::Zero();
  for (const Vector3& p : points) middle += p / static_cast<double>(points.size());
  const Vector3 u = normal.unitOrthogonal();
  const Vector3 v = normal.cross(u);
  const auto angle = [&](const Vector3& p) {
    return std::atan2(v.dot(p - middle), u.dot(p - middle));
  };
  std::sort(points.begin(), points.end(),
            [&](const Vector3& a, const Vector3& b) { return angle(a) < angle(b); });
}

}  // namespace

ConvexVolume::ConvexVolume(const Eigen::AlignedBox3d& box) {
  const auto corner = [&](int index) {
    return Vector3(index & 1 ? box.max().x() : box.min().x(),
                   index & 2 ? box.max().y() : box.min().y(),
                   index & 4 ? box.max().z() : box.min().z());
  };
  constexpr std::array<std::array<int, 4>, 6> kFaces = {
      {{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}}};
  for (const auto& [a, b, c, d] : kFaces)
    faces_.push_back({corner(a), corner(b), corner(c), corner(d)});
}

void ConvexVolume::Clip(const Vector3& normal, double offset) {
  std::vector<Face> kept;
  Face cut;
  for (const Face& face : faces_) {
    Face part;
    for (std::size_t i = 0; i < face.size(); ++i) {
      const Vector3& a = face[i];
      const Vector3& b = face[(i + 1) % face.size()];
      const double beyond_a = normal.dot(a) - offset;
      const double beyond_b = normal.dot(b) - offset;
      if (beyond_a <= 0) part.push_back(a);
      if ((beyond_a <= 0) == (beyond_b <= 0)) continue;
      part.push_back(a + beyond_a / (beyond_a - beyond_b) * (b - a));
      cut.push_back(part.back());
    }
    if (part.size() >= 3) kept.push_back(std::move(part));
  }
  if (cut.size() >= 3) {
    SortAround(normal.normalized(), cut);
    kept.push_back(std::move(cut));
  }
  faces_ = std::move(kept);
}

Eigen::AlignedBox3d ConvexVolume::Extent() const {
  Eigen::AlignedBox3d extent;
  for (const Face& face : faces_)
    for (const Vector3& p : face) extent.extend(p);
  return extent;
}

}  // namespace mocap
