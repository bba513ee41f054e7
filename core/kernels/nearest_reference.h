// What nearest.h means, point by point and ray by ray.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>

#include "core/kernels/nearest.h"

namespace mocap::kernels::reference {

inline int FindNearestPoint(const double* xs, const double* ys, const double* zs, int count,
                            const std::array<double, 3>& place) {
  int nearest = 0;
  double least_sq = std::numeric_limits<double>::infinity();
  for (int i = 0; i < count; ++i) {
    const double x = xs[i] - place[0], y = ys[i] - place[1], z = zs[i] - place[2];
    const double distance_sq = x * x + y * y + z * z;
    if (distance_sq < least_sq) least_sq = distance_sq, nearest = i;
  }
  return nearest;
}

/// Among equally far rays, those at the first even place of eight win, and there the first.
inline int FindFarthestRay(const RayBlock* blocks, int count, const std::array<float, 3>& sight) {
  constexpr std::array<int, 8> kPlaces = {0, 4, 2, 6, 1, 5, 3, 7};
  int farthest = -1;
  float most = 0;
  for (const int place : kPlaces) {
    for (const int half : {0, 8}) {
      for (int block = 0; block < count; ++block) {
        const RayBlock& rays = blocks[block];
        const int i = half + place;
        const float along = rays.x[i] * sight[0] + rays.y[i] * sight[1] + rays.z[i] * sight[2];
        if (along > most) most = along, farthest = block * RayBlock::kRays + i;
      }
    }
  }
  return farthest;
}

}  // namespace mocap::kernels::reference
