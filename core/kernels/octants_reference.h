// What octants.h means, octant by octant.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/kernels/octants.h"

namespace mocap::kernels::reference {

/// An upright rectangle in a picture: its middle, and how far it reaches from there.
struct Rectangle {
  float x, y, reach_x, reach_y;
};

/// A bit of a window whose top left pixel is (x, y), moved into the region.
inline bool IsSet(const WindowPlanes& planes, int plane, int x, int y, int bit) {
  const int u = std::clamp(x, planes.left, planes.right) - planes.left;
  const int v = std::clamp(y, planes.top, planes.bottom) - planes.top;
  const std::uint32_t word =
      planes.words[plane * planes.words_per_plane + (u >> 4) * planes.words_per_column + v];
  return (word >> (bit + (u & 15)) & 1) != 0;
}

/// Decides about a rectangle, in the bits of octant 0.
inline OctantBits Judge(const Rectangle& r, const WindowPlanes& planes) {
  const auto rounded_down = [](float place_px) {
    const float biased = place_px + (kPlaceBias_px + 0.5f);
    return static_cast<int>(std::clamp(biased, 0.0f, kFarthestPlace_px)) - kPlaceBias_px;
  };
  const int x0 = rounded_down(r.x - r.reach_x), x1 = rounded_down(r.x + r.reach_x);
  const int y0 = rounded_down(r.y - r.reach_y), y1 = rounded_down(r.y + r.reach_y);
  const int side = std::max(x1 - x0, y1 - y0) + 1;
  // One window in each corner covers the rectangle if its side is half the longer side or more.
  const int plane =
      std::bit_width(static_cast<unsigned>(std::clamp(side - 1, 1, kWidestOctant_px - 1))) - 1;
  const int last = 1 - (1 << plane);
  const auto all_corners = [&](int bit) {
    return IsSet(planes, plane, x0, y0, bit) && IsSet(planes, plane, x1 + last, y0, bit) &&
           IsSet(planes, plane, x0, y1 + last, bit) &&
           IsSet(planes, plane, x1 + last, y1 + last, bit);
  };
  const bool in_picture = x0 >= 0 && y0 >= 0 && x1 < planes.width_px && y1 < planes.height_px;
  const bool touches_picture = x1 >= 0 && y1 >= 0 && x0 < planes.width_px && y0 < planes.height_px;
  const bool in_region =
      x0 >= planes.left && y0 >= planes.top && x1 <= planes.right && y1 <= planes.bottom;
  const bool touches_region =
      x1 >= planes.left && y1 >= planes.top && x0 <= planes.right && y0 <= planes.bottom;
  const bool is_covered = side <= kWidestOctant_px;
  const bool inside = in_region && in_picture && is_covered && all_corners(0);
  const bool outside = in_picture && (!touches_region || (is_covered && all_corners(16)));
  const bool unknown = in_picture && side < 2 && !inside && !outside;
  return OctantBits{inside} | OctantBits{outside} << 8 | OctantBits{!touches_picture} << 16 |
         OctantBits{unknown} << 24;
}

/// A linear function of position.
inline float Along(const std::array<float, 3>& gradient, float constant,
                   const std::array<float, 3>& offset) {
  return constant + gradient[0] * offset[0] + gradient[1] * offset[1] + gradient[2] * offset[2];
}
inline std::array<float, 3> GradientAt(const std::array<OctantFrames::Lanes, 3>& lanes,
                                       int octant) {
  return {lanes[0][octant], lanes[1][octant], lanes[2][octant]};
}
inline float ToOctant(const std::array<float, 3>& gradient, int octant, float spread) {
  return spread * (kOctantX[octant] * gradient[0] + kOctantY[octant] * gradient[1] +
                   kOctantZ[octant] * gradient[2]);
}

/// A value and its change along the table's columns and rows.
struct Interpolated {
  float value, right, down;
};
inline Interpolated Interpolate(float v00, float v01, float v10, float v11, float a, float b) {
  const float top = v00 + a * (v01 - v00);
  const float down = v10 + a * (v11 - v10) - top;
  return {top + b * down, (v01 - v00) + b * (v11 - v10 - v01 + v00), down};
}

/// Projects one octant.
inline OctantBits ProjectOctant(const OctantCamera& camera, int octant,
                                const std::array<float, 3>& middle, float spread, float half,
                                OctantFrames& frames) {
  const auto size_of = [](const std::array<float, 3>& v) {
    return std::abs(v[0]) + std::abs(v[1]) + std::abs(v[2]);
  };
  const SensorPlaneNodes& t = camera.table;
  const std::array<float, 3> w = {middle[0] + spread * kOctantX[octant],
                                  middle[1] + spread * kOctantY[octant],
                                  middle[2] + spread * kOctantZ[octant]};
  std::array<float, 3> c;
  for (int row = 0; row < 3; ++row) {
    const auto& R = camera.R[row];
    c[row] = R[0] * w[0] + R[1] * w[1] + R[2] * w[2] + camera.p[row];
  }
  const float nearest = kNearestOctant * half + 1;
  const bool is_ahead = c[2] > nearest;
  const float per_z = 1 / (is_ahead ? c[2] : nearest);
  const float nx = c[0] * per_z, ny = c[1] * per_z;
  // Derivatives of (Xu/f, Yu/f) [1/mm], and the cube's reach there.
  std::array<float, 3> depth, by_u, by_v;
  for (int axis = 0; axis < 3; ++axis) {
    depth[axis] = camera.R[2][axis] * per_z;
    by_u[axis] = camera.R[0][axis] * per_z - nx * depth[axis];
    by_v[axis] = camera.R[1][axis] * per_z - ny * depth[axis];
  }
  const float slant = size_of(depth);
  const float grown = 1 / (1 - std::min(half * slant, 0.5f));
  const float reach_u = half * size_of(by_u) * grown, reach_v = half * size_of(by_v) * grown;
  const float rim = reach_u + reach_v + 1e-3f;
  const float field = t.field_radius + rim, inner = std::max(t.field_radius - rim, 0.0f);
  const float off_axis = nx * nx + ny * ny;
  const bool misses = off_axis - field * field > 0 || t.low_x - (nx + reach_u + 1e-3f) > 0 ||
                      t.low_y - (ny + reach_v + 1e-3f) > 0 || nx - reach_u - 1e-3f - t.high_x > 0 ||
                      ny - reach_v - 1e-3f - t.high_y > 0;
  const bool is_behind = c[2] < -nearest;

  const float u = (nx - t.origin_x) * t.cells_per_unit, v = (ny - t.origin_y) * t.cells_per_unit;
  const float du = reach_u * t.cells_per_unit, dv = reach_v * t.cells_per_unit;
  const float room = std::min({u - du, t.last_column - (u + du), v - dv, t.last_row - (v + dv),
                               kBendReach_cells - du, kBendReach_cells - dv});
  const bool is_valid = is_ahead && inner * inner > off_axis && room > 0;
  const float near_u = std::clamp(u, 0.0f, t.last_column - 1);
  const float near_v = std::clamp(v, 0.0f, t.last_row - 1);
  const int column = static_cast<int>(near_u), row = static_cast<int>(near_v);
  const float a = near_u - static_cast<float>(column), b = near_v - static_cast<float>(row);
  const int node = row * t.columns + column;
  const PicturePlace *const top = t.nodes + node, *const bottom = top + t.columns;
  const Interpolated x =
      Interpolate(top[0].x_px, top[1].x_px, bottom[0].x_px, bottom[1].x_px, a, b);
  const Interpolated y =
      Interpolate(top[0].y_px, top[1].y_px, bottom[0].y_px, bottom[1].y_px, a, b);
  std::array<float, 3> along_x, along_y;
  for (int axis = 0; axis < 3; ++axis) {
    along_x[axis] =
        x.right * t.cells_per_unit * by_u[axis] + x.down * t.cells_per_unit * by_v[axis];
    along_y[axis] =
        y.right * t.cells_per_unit * by_u[axis] + y.down * t.cells_per_unit * by_v[axis];
  }
  const float growth = grown + half * slant * grown * grown;
  const float reach_x = size_of(along_x) * growth, reach_y = size_of(along_y) * growth;
  const float error =
      t.bends_px[node] * (std::max(du, 2 * du - 1) + std::max(dv, 2 * dv - 1) + du * dv) +
      kOctantRounding_px;
  for (int axis = 0; axis < 3; ++axis) {
    frames.middle[axis][octant] = w[axis], frames.depth[axis][octant] = depth[axis];
    frames.along_x[axis][octant] = along_x[axis], frames.along_y[axis][octant] = along_y[axis];
  }
  frames.x[octant] = x.value, frames.y[octant] = y.value;
  frames.reach_x[octant] = reach_x, frames.reach_y[octant] = reach_y;
  frames.error[octant] = is_valid ? error : error + kNoFrame_px;
  OctantBits bits = is_behind || (is_ahead && misses) ? 1 << 16 : 0;
  if (is_valid)
    bits |=
        Judge({x.value, y.value, half * reach_x + error, half * reach_y + error}, camera.planes);
  return bits << octant;
}

inline OctantBits ProjectOctants(const OctantCamera& camera, const std::array<float, 3>& middle,
                                 float spread, float half, OctantFrames& frames) {
  OctantBits bits = 0;
  for (int octant = 0; octant < OctantFrames::kLanes; ++octant)
    bits |= ProjectOctant(camera, octant, middle, spread, half, frames);
  return bits;
}

/// From the middle of a frame to a point.
inline std::array<float, 3> OffsetOf(const OctantFrames& f, int octant,
                                     const std::array<float, 3>& point) {
  const std::array<float, 3> middle = GradientAt(f.middle, octant);
  return {point[0] - middle[0], point[1] - middle[1], point[2] - middle[2]};
}

inline OctantBits JudgeOctants(const WindowPlanes& planes, const OctantFrames& f, int octant,
                               const std::array<float, 3>& middle, float spread, float half) {
  const std::array<float, 3> offset = OffsetOf(f, octant, middle);
  OctantBits bits = 0;
  for (int i = 0; i < OctantFrames::kLanes; ++i) {
    const auto at = [&](const std::array<float, 3>& gradient, float constant) {
      return Along(gradient, constant, offset) + ToOctant(gradient, i, spread);
    };
    const float per_z = 1 / at(GradientAt(f.depth, octant), 1);
    const float error = f.error[octant];
    bits |= Judge({f.x[octant] + at(GradientAt(f.along_x, octant), 0) * per_z,
                   f.y[octant] + at(GradientAt(f.along_y, octant), 0) * per_z,
                   half * f.reach_x[octant] + error, half * f.reach_y[octant] + error},
                  planes)
            << i;
  }
  return bits;
}

/// Tests a sample of a voxel; the error of its position decides between windows of one and two
/// pixels. May read only samples in the region.
inline void JudgeSample(const WindowPlanes& planes, const OctantFrames& f, int octant,
                        const std::array<float, 3>& offset, int voxel, float voxel_spread,
                        int sample, float sample_spread, SampleDecisions& decisions) {
  const auto at = [&](const std::array<float, 3>& gradient, float constant) {
    return Along(gradient, constant, offset) + ToOctant(gradient, voxel, voxel_spread) +
           ToOctant(gradient, sample, sample_spread);
  };
  const float error = f.error[octant];
  const float per_z = 1 / at(GradientAt(f.depth, octant), 1);
  const float left = f.x[octant] + 0.5f - error - static_cast<float>(planes.left) +
                     at(GradientAt(f.along_x, octant), 0) * per_z;
  const float top = f.y[octant] + 0.5f - error - static_cast<float>(planes.top) +
                    at(GradientAt(f.along_y, octant), 0) * per_z;
  const int column = static_cast<int>(left), row = static_cast<int>(top);
  const bool is_wide =
      static_cast<int>(left + 2 * error) != column || static_cast<int>(top + 2 * error) != row;
  const int x = planes.left + column, y = planes.top + row;
  const std::uint64_t bit = std::uint64_t{1} << (8 * sample + voxel);
  const bool inside = IsSet(planes, is_wide, x, y, 0), outside = IsSet(planes, is_wide, x, y, 16);
  if (inside) decisions.inside |= bit;
  if (outside) decisions.outside |= bit;
  if (!inside && !outside && !is_wide) decisions.unknown |= bit;
}

inline bool JudgeSamples(const WindowPlanes& planes, const OctantFrames& f, int octant,
                         const std::array<float, 3>& middle, float voxel_spread,
                         float sample_spread, unsigned asked, SampleDecisions& decisions) {
  const std::array<float, 3> offset = OffsetOf(f, octant, middle);
  const float z = Along(GradientAt(f.depth, octant), 1, offset);
  const float x = f.x[octant] + Along(GradientAt(f.along_x, octant), 0, offset) / z;
  const float y = f.y[octant] + Along(GradientAt(f.along_y, octant), 0, offset) / z;
  const float half = voxel_spread + sample_spread;
  const float reach_x = half * f.reach_x[octant] + f.error[octant] + 1;
  const float reach_y = half * f.reach_y[octant] + f.error[octant] + 1;
  if (!(x - reach_x > static_cast<float>(planes.left) &&
        y - reach_y > static_cast<float>(planes.top) &&
        x + reach_x < static_cast<float>(planes.right) &&
        y + reach_y < static_cast<float>(planes.bottom)))
    return false;
  decisions = {};
  for (int voxel = 0; voxel < OctantFrames::kLanes; ++voxel) {
    for (int sample = 0; sample < OctantFrames::kLanes && (asked >> voxel & 1) != 0; ++sample)
      JudgeSample(planes, f, octant, offset, voxel, voxel_spread, sample, sample_spread, decisions);
  }
  return true;
}

}  // namespace mocap::kernels::reference
