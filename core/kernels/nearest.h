// The nearest of many points, and of many rays.
#pragma once

#include <array>

namespace mocap::kernels {

/// Arrays of points are padded to a multiple of this, at infinity.
inline constexpr int kPointStep = 8;

/// Finds the point nearest to a place; the first of equally near ones.
/// @return  its index; 0 if all are infinitely far away.
int FindNearestPoint(const double* x, const double* y, const double* z, int count,
                     const std::array<double, 3>& place);

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
