// The nearest of many points, and of many rays.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace mocap::kernels {

/// Arrays of points are padded to a multiple of this, at infinity.
inline constexpr int kPointStep = 8;

/// Finds the point nearest to a place; the first of equally near ones.
/// @return  its index; 0 if all are infinitely far away.
int FindNearestPoint(const double* x, const double* y, const double* z, int count,
                     const std::array<double, 3>& place);

/// Points in columns, among which the nearest is searched for. Reuses its memory.
class NearestPoint {
 public:
  void Clear() { count_ = 0; }
  void Add(const std::array<double, 3>& point);
  bool empty() const { return count_ == 0; }
  /// The point nearest to a place; the first of several. @pre not empty
  std::array<double, 3> To(const std::array<double, 3>& place) const;

 private:
  std::size_t count_ = 0;
  std::array<std::vector<double>, 3> axes_;
};

/// Directions of neighbouring rays; zero beyond the last.
struct RayBlock {
  static constexpr int kRays = 16;
  alignas(64) std::array<float, kRays> x{}, y{}, z{};
};

/// Finds the ray that goes farthest along a line of sight from the same eye, and so passes nearest
/// to its end.
/// @return  its index; -1 if all point away.
int FindFarthestRay(const RayBlock* blocks, int count, const std::array<float, 3>& sight);

}  // namespace mocap::kernels
