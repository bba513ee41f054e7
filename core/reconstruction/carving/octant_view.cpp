#include "core/reconstruction/carving/octant_view.h"

#include <bit>
#include <cmath>

#include "core/vectorized.h"

namespace mocap {
namespace {

constexpr int kLanes = OctantFrames::kLanes;
using Lanes = OctantFrames::Lanes;
using Eye = OctantView::Eye;

// More than the rounding of floats moves a place.
constexpr float kRounding_px = 0.01f;
// Nearer to the camera than so many times half the side of a cube nothing is told of it.
constexpr float kNearest = 4;
// Makes places positive before they are rounded down, and what lies far away not too large.
constexpr int kBias_px = 8192;
constexpr float kFarthest_px = 32768;
// Four of the largest windows cover so much.
constexpr int kWidest_px = 2 * WindowMap::kLargest_px;

constexpr Lanes kSignX = {-1, 1, -1, 1, -1, 1, -1, 1};
constexpr Lanes kSignY = {-1, -1, 1, 1, -1, -1, 1, 1};
constexpr Lanes kSignZ = {-1, -1, -1, -1, 1, 1, 1, 1};

// Four bytes of bits: inside, outside, unseen, gap.
OctantVerdicts Unpack(std::uint32_t bits) {
  return {static_cast<std::uint8_t>(bits), static_cast<std::uint8_t>(bits >> 8),
          static_cast<std::uint8_t>(bits >> 16), static_cast<std::uint8_t>(bits >> 24)};
}

// The error of a frame that tells nothing.
constexpr float kNoFrame_px = 1e6f;

// By value: loops with references are not vectorized.
template <typename T>
inline T Least(T a, T b) {
  return a < b ? a : b;
}
template <typename T>
inline T Most(T a, T b) {
  return a < b ? b : a;
}

// All bits of a negative number's sign.
inline std::uint32_t Sign(int number) { return static_cast<std::uint32_t>(number >> 31); }

// By a float's exponent: loops with std::bit_width are not vectorized.
inline int FloorLog2(int number) {
  return (std::bit_cast<int>(static_cast<float>(number)) >> 23) - 127;
}

struct Rectangles {
  alignas(32) Lanes x, y, reach_x, reach_y;
  // Bits that all lanes start with, and those that are asked for.
  alignas(32) std::array<std::uint32_t, kLanes> known, asked;
};

inline __attribute__((always_inline)) std::uint32_t RoundedDown(float place_px) {
  return static_cast<std::uint32_t>(
      static_cast<int>(Least(Most(place_px + (kBias_px + 0.5f), 0.0f), kFarthest_px)));
}

// What rectangles hold of the silhouette.
inline __attribute__((always_inline)) std::uint32_t JudgeAll(const Rectangles& r,
                                                             const WindowMap::Planes& planes) {
  const std::uint32_t* const words = planes.words;
  const int left = planes.left, top = planes.top, right = planes.right, bottom = planes.bottom;
  const int width = planes.width_px, height = planes.height_px, stride = planes.words_per_row;
  std::uint32_t bits = 0;
#pragma GCC ivdep
  for (int i = 0; i < kLanes; ++i) {
    const int x0 = static_cast<int>(RoundedDown(r.x[i] - r.reach_x[i])) - kBias_px;
    const int x1 = static_cast<int>(RoundedDown(r.x[i] + r.reach_x[i])) - kBias_px;
    const int y0 = static_cast<int>(RoundedDown(r.y[i] - r.reach_y[i])) - kBias_px;
    const int y1 = static_cast<int>(RoundedDown(r.y[i] + r.reach_y[i])) - kBias_px;
    const int side = Most(x1 - x0, y1 - y0) + 1;
    // Windows of half a rectangle's longer side or more, one in each corner, cover it.
    const int plane = FloorLog2(Least(Most(side - 1, 1), kWidest_px - 1));
    const int beyond = 1 - (1 << plane);
    const std::int32_t begin = plane * planes.words_per_plane;
    const int first_row = begin + (Least(Most(y0, top), bottom) - top) * stride;
    const int last_row = begin + (Least(Most(y1 + beyond, top), bottom) - top) * stride;
    const int first = Least(Most(x0, left), right) - left;
    const int last = Least(Most(x1 + beyond, left), right) - left;
    const std::uint32_t firsts = words[first_row + (first >> 4)] & words[last_row + (first >> 4)];
    const std::uint32_t lasts = words[first_row + (last >> 4)] & words[last_row + (last >> 4)];
    const std::uint32_t word = firsts >> (first & 15) & lasts >> (last & 15);
    // Negative where something is not so.
    const int in_picture = x0 | y0 | (width - 1 - x1) | (height - 1 - y1);
    const int touches_picture = x1 | y1 | (width - 1 - x0) | (height - 1 - y0);
    const int in_region =
        (x0 - left) | (y0 - top) | (right - x1) | (bottom - y1) | (kWidest_px - side);
    const int touches_region = (x1 - left) | (y1 - top) | (right - x0) | (bottom - y0);
    const std::uint32_t inside = word & ~Sign(in_region | in_picture) & 1;
    const std::uint32_t outside =
        ((word >> 16 & ~Sign(kWidest_px - side)) | Sign(touches_region)) & ~Sign(in_picture) & 1;
    const std::uint32_t unseen = Sign(touches_picture) & 1;
    const std::uint32_t gap = Sign(side - 2) & ~Sign(in_picture) & ~inside & ~outside & 1;
    const std::uint32_t lane = inside | outside << 8 | unseen << 16 | gap << 24;
    bits |= ((lane & r.asked[i]) | r.known[i]) << i;
  }
  return bits;
}

MOCAP_VECTORIZED
std::uint32_t ProjectAll(const Eye& eye, const std::array<float, 3>& middle, float spread,
                         float half, OctantFrames& f) {
  const auto [r0, r1, r2] = eye.R;
  const auto [r00, r01, r02] = r0;
  const auto [r10, r11, r12] = r1;
  const auto [r20, r21, r22] = r2;
  const auto [p0, p1, p2] = eye.p;
  const auto [m0, m1, m2] = middle;
  const SensorPlaneTable::Nodes t = eye.table;
  const SensorPlaneTable::Place* const nodes = t.nodes;
  constexpr float kReach = SensorPlaneTable::kBendReach_cells;
  const float nearest = kNearest * half + 1;
  Rectangles r;
#pragma GCC ivdep
  for (int i = 0; i < kLanes; ++i) {
    const float wx = m0 + spread * kSignX[i];
    const float wy = m1 + spread * kSignY[i];
    const float wz = m2 + spread * kSignZ[i];
    const float cx = r00 * wx + r01 * wy + r02 * wz + p0;
    const float cy = r10 * wx + r11 * wy + r12 * wz + p1;
    const float cz = r20 * wx + r21 * wy + r22 * wz + p2;
    const int is_ahead = cz > nearest ? 1 : 0;
    const float per_z = 1 / (is_ahead ? cz : nearest);
    const float nx = cx * per_z, ny = cy * per_z;
    // How (Xu/f, Yu/f) changes [1/mm], and how far the cube reaches there.
    const float d0 = r20 * per_z, d1 = r21 * per_z, d2 = r22 * per_z;
    const float u0 = r00 * per_z - nx * d0, u1 = r01 * per_z - nx * d1;
    const float u2 = r02 * per_z - nx * d2;
    const float v0 = r10 * per_z - ny * d0, v1 = r11 * per_z - ny * d1;
    const float v2 = r12 * per_z - ny * d2;
    const float slant = std::abs(d0) + std::abs(d1) + std::abs(d2);
    const float grown = 1 / (1 - Least(half * slant, 0.5f));
    const float reach_u = half * (std::abs(u0) + std::abs(u1) + std::abs(u2)) * grown;
    const float reach_v = half * (std::abs(v0) + std::abs(v1) + std::abs(v2)) * grown;
    const float field = t.field_radius + (reach_u + reach_v + 1e-3f);
    const float inner = Most(t.field_radius - (reach_u + reach_v + 1e-3f), 0.0f);
    const float off_axis = nx * nx + ny * ny;
    const float beyond = Most(Most(off_axis - field * field, t.low_x - (nx + reach_u + 1e-3f)),
                              t.low_y - (ny + reach_v + 1e-3f));
    const float beside = Most(nx - reach_u - 1e-3f - t.high_x, ny - reach_v - 1e-3f - t.high_y);
    const int misses = Most(beyond, beside) > 0 ? 1 : 0;
    const int is_behind = cz < -nearest ? 1 : 0;

    const float u = (nx - t.origin_x) * t.cells_per_unit;
    const float v = (ny - t.origin_y) * t.cells_per_unit;
    const float du = reach_u * t.cells_per_unit, dv = reach_v * t.cells_per_unit;
    const float room =
        Least(Least(Least(u - du, t.last_column - (u + du)), Least(v - dv, t.last_row - (v + dv))),
              Least(kReach - du, kReach - dv));
    const int is_valid = is_ahead & (inner * inner > off_axis ? 1 : 0) & (room > 0 ? 1 : 0);
    const float near_u = Least(Most(u, 0.0f), t.last_column - 1);
    const float near_v = Least(Most(v, 0.0f), t.last_row - 1);
    const int column = static_cast<int>(near_u);
    const int row = static_cast<int>(near_v);
    const float a = near_u - static_cast<float>(column);
    const float b = near_v - static_cast<float>(row);
    const int node = row * t.columns + column;
    const int below = node + t.columns;
    const float x00 = nodes[node].x_px, y00 = nodes[node].y_px;
    const float x01 = nodes[node + 1].x_px, y01 = nodes[node + 1].y_px;
    const float x10 = nodes[below].x_px, y10 = nodes[below].y_px;
    const float x11 = nodes[below + 1].x_px, y11 = nodes[below + 1].y_px;
    const float bend = t.bends_px[node];
    const float top_x = x00 + a * (x01 - x00), top_y = y00 + a * (y01 - y00);
    const float down_x = x10 + a * (x11 - x10) - top_x, down_y = y10 + a * (y11 - y10) - top_y;
    const float right_x = (x01 - x00) + b * (x11 - x10 - x01 + x00);
    const float right_y = (y01 - y00) + b * (y11 - y10 - y01 + y00);
    const float x = top_x + b * down_x, y = top_y + b * down_y;
    const float xu = right_x * t.cells_per_unit, xv = down_x * t.cells_per_unit;
    const float yu = right_y * t.cells_per_unit, yv = down_y * t.cells_per_unit;
    const float ax0 = xu * u0 + xv * v0, ax1 = xu * u1 + xv * v1, ax2 = xu * u2 + xv * v2;
    const float ay0 = yu * u0 + yv * v0, ay1 = yu * u1 + yv * v1, ay2 = yu * u2 + yv * v2;
    // Within the cube, `grown` bounds 1 / (1 + depth · o), and grown² · slant its change.
    const float growth = grown + half * slant * grown * grown;
    const float reach_x = (std::abs(ax0) + std::abs(ax1) + std::abs(ax2)) * growth;
    const float reach_y = (std::abs(ay0) + std::abs(ay1) + std::abs(ay2)) * growth;
    // The slope changes at each side of a cell that lies between, at worst at once and then after
    // each whole cell, and along the cells.
    const float error =
        bend * (Most(du, 2 * du - 1) + Most(dv, 2 * dv - 1) + du * dv) + kRounding_px;
    f.middle[0][i] = wx, f.middle[1][i] = wy, f.middle[2][i] = wz;
    f.x[i] = x;
    f.y[i] = y;
    f.along_x[0][i] = ax0, f.along_x[1][i] = ax1, f.along_x[2][i] = ax2;
    f.along_y[0][i] = ay0, f.along_y[1][i] = ay1, f.along_y[2][i] = ay2;
    f.depth[0][i] = d0, f.depth[1][i] = d1, f.depth[2][i] = d2;
    f.reach_x[i] = reach_x;
    f.reach_y[i] = reach_y;
    f.error[i] = error + static_cast<float>(1 - is_valid) * kNoFrame_px;
    r.x[i] = x;
    r.y[i] = y;
    r.reach_x[i] = half * reach_x + error;
    r.reach_y[i] = half * reach_y + error;
    r.asked[i] = 0u - static_cast<std::uint32_t>(is_valid);
    r.known[i] = static_cast<std::uint32_t>(is_behind | (is_ahead & misses)) << 16;
  }
  return JudgeAll(r, eye.planes);
}

// One lane of frames, seen from another place.
struct Frame {
  float x, y;
  std::array<float, 3> along_x, along_y, depth;
  float reach_x, reach_y, error;
  std::array<float, 3> offset;  // Of that place from the middle.

  inline __attribute__((always_inline))
  Frame(const OctantFrames& f, int lane, const std::array<float, 3>& place)
      : x(f.x[lane]),
        y(f.y[lane]),
        along_x(At(f.along_x, lane)),
        along_y(At(f.along_y, lane)),
        depth(At(f.depth, lane)),
        reach_x(f.reach_x[lane]),
        reach_y(f.reach_y[lane]),
        error(f.error[lane]),
        offset{place[0] - f.middle[0][lane], place[1] - f.middle[1][lane],
               place[2] - f.middle[2][lane]} {}

 private:
  static inline __attribute__((always_inline)) std::array<float, 3> At(
      const std::array<Lanes, 3>& lanes, int lane) {
    return {lanes[0][lane], lanes[1][lane], lanes[2][lane]};
  }
};

// A linear function of a place, there and around it.
struct Slope {
  float middle, x, y, z;
  inline __attribute__((always_inline))
  Slope(const std::array<float, 3>& slope, float constant, const std::array<float, 3>& offset)
      : middle(constant + slope[0] * offset[0] + slope[1] * offset[1] + slope[2] * offset[2]),
        x(slope[0]),
        y(slope[1]),
        z(slope[2]) {}
  // How much more it is in an octant.
  inline __attribute__((always_inline)) float Beside(int octant, float spread) const {
    return spread * (kSignX[octant] * x + kSignY[octant] * y + kSignZ[octant] * z);
  }
};

MOCAP_VECTORIZED
std::uint32_t GlanceAll(const Eye& eye, const OctantFrames& frames, int lane,
                        const std::array<float, 3>& middle, float spread, float half) {
  const Frame f(frames, lane, middle);
  const Slope x(f.along_x, 0, f.offset), y(f.along_y, 0, f.offset), z(f.depth, 1, f.offset);
  const float reach_x = half * f.reach_x + f.error;
  const float reach_y = half * f.reach_y + f.error;
  Rectangles r;
#pragma GCC ivdep
  for (int i = 0; i < kLanes; ++i) {
    const float per_z = 1 / (z.middle + z.Beside(i, spread));
    r.x[i] = f.x + (x.middle + x.Beside(i, spread)) * per_z;
    r.y[i] = f.y + (y.middle + y.Beside(i, spread)) * per_z;
    r.reach_x[i] = reach_x;
    r.reach_y[i] = reach_y;
    r.asked[i] = ~0u;
    r.known[i] = 0;
  }
  return JudgeAll(r, eye.planes);
}

// Whether all within so far of a frame's place lies well within the planes' region.
inline __attribute__((always_inline)) bool IsInRegion(const WindowMap::Planes& planes,
                                                      const Frame& f, float x, float y,
                                                      float half) {
  const float reach_x = half * f.reach_x + f.error + 1, reach_y = half * f.reach_y + f.error + 1;
  return x - reach_x > static_cast<float>(planes.left) &&
         y - reach_y > static_cast<float>(planes.top) &&
         x + reach_x < static_cast<float>(planes.right) &&
         y + reach_y < static_cast<float>(planes.bottom);
}

// The samples of eight voxels, by windows of one pixel or two. Returns whether all of them lie in
// the region that the planes cover; otherwise nothing is told.
MOCAP_VECTORIZED
bool GlanceSamplesAll(const WindowMap::Planes& planes, const OctantFrames& frames, int lane,
                      const std::array<float, 3>& middle, float voxel_spread, float sample_spread,
                      unsigned asked, SampleVerdicts& verdicts) {
  const Frame f(frames, lane, middle);
  const Slope x(f.along_x, 0, f.offset), y(f.along_y, 0, f.offset), z(f.depth, 1, f.offset);
  if (!IsInRegion(planes, f, f.x + x.middle / z.middle, f.y + y.middle / z.middle,
                  voxel_spread + sample_spread))
    return false;
  const std::uint32_t* const words = planes.words;
  const int wider = planes.words_per_plane;
  const int stride = planes.words_per_row;
  const float error = f.error;
  const float low_x = f.x + 0.5f - error - static_cast<float>(planes.left);
  const float low_y = f.y + 0.5f - error - static_cast<float>(planes.top);
  alignas(32) Lanes voxel_x, voxel_y, voxel_z, sample_x, sample_y, sample_z;
  for (int i = 0; i < kLanes; ++i) {
    voxel_x[i] = x.middle + x.Beside(i, voxel_spread);
    voxel_y[i] = y.middle + y.Beside(i, voxel_spread);
    voxel_z[i] = z.middle + z.Beside(i, voxel_spread);
    sample_x[i] = x.Beside(i, sample_spread);
    sample_y[i] = y.Beside(i, sample_spread);
    sample_z[i] = z.Beside(i, sample_spread);
  }
  // A word a sample; in its bytes inside, gap and outside, a bit a voxel.
  alignas(32) std::array<std::uint32_t, kLanes> bits{};
  for (; asked != 0; asked &= asked - 1) {
    const int voxel = std::countr_zero(asked);
#pragma GCC ivdep
    for (int i = 0; i < kLanes; ++i) {
      const float per_z = 1 / (voxel_z[voxel] + sample_z[i]);
      const float left = low_x + (voxel_x[voxel] + sample_x[i]) * per_z;
      const float top = low_y + (voxel_y[voxel] + sample_y[i]) * per_z;
      const int column = static_cast<int>(left), row = static_cast<int>(top);
      const int is_wide =
          (static_cast<int>(left + 2 * error) - column) | (static_cast<int>(top + 2 * error) - row);
      const auto place =
          static_cast<std::uint32_t>((-is_wide & wider) + row * stride + (column >> 4));
      const std::uint32_t word = words[place] >> (column & 15);
      const std::uint32_t known = word & 0x10001;
      const std::uint32_t gap = ~(known | known >> 16 | static_cast<std::uint32_t>(is_wide)) & 1;
      bits[i] |= (known | gap << 8) << voxel;
    }
  }
  std::array<std::uint8_t, kLanes> inside, gap, outside;
  for (int i = 0; i < kLanes; ++i) {
    inside[i] = static_cast<std::uint8_t>(bits[i]);
    gap[i] = static_cast<std::uint8_t>(bits[i] >> 8);
    outside[i] = static_cast<std::uint8_t>(bits[i] >> 16);
  }
  static_assert(std::endian::native == std::endian::little);
  verdicts = {std::bit_cast<std::uint64_t>(inside), std::bit_cast<std::uint64_t>(outside), 0,
              std::bit_cast<std::uint64_t>(gap)};
  return true;
}

}  // namespace

void OctantView::Set(const CarvingView& view, const Vector3& origin_W, const WindowMap& windows) {
  const Vector3 p = view.X_CW * origin_W;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column)
      eye_.R[row][column] = static_cast<float>(view.X_CW.R(row, column));
    eye_.p[row] = static_cast<float>(p[row]);
  }
  eye_.table = view.table->nodes();
  eye_.planes = windows.planes();
}

OctantVerdicts OctantView::Project(const Eigen::Vector3f& middle, float spread, float half,
                                   OctantFrames& frames, std::uint8_t& framed) const {
  const std::uint32_t bits =
      ProjectAll(eye_, {middle.x(), middle.y(), middle.z()}, spread, half, frames);
  framed = 0;
  for (int i = 0; i < kLanes; ++i)
    if (frames.error[i] < kGoodFrame_px) framed |= static_cast<std::uint8_t>(1 << i);
  return Unpack(bits);
}

OctantVerdicts OctantView::Glance(const OctantFrames& frames, int lane,
                                  const Eigen::Vector3f& middle, float spread, float half) const {
  return Unpack(GlanceAll(eye_, frames, lane, {middle.x(), middle.y(), middle.z()}, spread, half));
}

SampleVerdicts OctantView::GlanceSamples(const OctantFrames& frames, int lane,
                                         const Eigen::Vector3f& middle, float voxel_spread,
                                         float sample_spread, std::uint8_t asked) const {
  const std::array<float, 3> p = {middle.x(), middle.y(), middle.z()};
  SampleVerdicts verdicts;
  if (GlanceSamplesAll(eye_.planes, frames, lane, p, voxel_spread, sample_spread, asked, verdicts))
    return verdicts;
  constexpr std::uint64_t kAll = 0x0101010101010101;
  const OctantVerdicts voxels =
      Unpack(GlanceAll(eye_, frames, lane, p, voxel_spread, sample_spread));
  verdicts = {kAll * voxels.inside, kAll * voxels.outside, kAll * voxels.unseen, 0};
  unsigned open = asked & ~(voxels.inside | voxels.outside | voxels.unseen);
  for (; open != 0; open &= open - 1) {
    const int voxel = std::countr_zero(open);
    const OctantVerdicts samples =
        Unpack(GlanceAll(eye_, frames, lane,
                         {p[0] + kSignX[voxel] * voxel_spread, p[1] + kSignY[voxel] * voxel_spread,
                          p[2] + kSignZ[voxel] * voxel_spread},
                         sample_spread, 0));
    verdicts.inside |= SpreadBits(samples.inside) << voxel;
    verdicts.outside |= SpreadBits(samples.outside) << voxel;
    verdicts.unseen |= SpreadBits(samples.unseen) << voxel;
    verdicts.gap |= SpreadBits(samples.gap) << voxel;
  }
  return verdicts;
}

}  // namespace mocap
