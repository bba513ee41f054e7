#include "core/reconstruction/carving/octant_view.h"

#include <bit>
#include <cstring>

#include "core/lanes.h"

namespace mocap {
namespace {

constexpr int kLanes = OctantFrames::kLanes;
using Lanes = OctantFrames::Lanes;
using Eye = OctantView::Eye;

// More than the rounding of floats moves a point.
constexpr float kRounding_px = 0.01f;
// Closer than this many half sides of a cube, a camera decides nothing about it.
constexpr float kNearest = 4;
// Keeps positions positive before they are rounded down, and distant ones from overflowing.
constexpr int kBias_px = 8192;
constexpr float kFarthest_px = 32768;
// Four of the largest windows cover this much.
constexpr int kWidest_px = 2 * WindowMap::kLargest_px;

constexpr Lanes kSignX = {-1, 1, -1, 1, -1, 1, -1, 1};
constexpr Lanes kSignY = {-1, -1, 1, 1, -1, -1, 1, 1};
constexpr Lanes kSignZ = {-1, -1, -1, -1, 1, 1, 1, 1};

// Unpacks four bytes of bits: inside, outside, unseen, gap.
OctantDecisions Unpack(std::uint32_t bits) {
  return {static_cast<std::uint8_t>(bits), static_cast<std::uint8_t>(bits >> 8),
          static_cast<std::uint8_t>(bits >> 16), static_cast<std::uint8_t>(bits >> 24)};
}

// The error of a frame that decides nothing.
constexpr float kNoFrame_px = 1e6f;

// All bits of the result equal the sign bit.
MOCAP_INLINE Ints Sign(Ints number) { return number >> 31; }

// Uses the exponent of the float.
MOCAP_INLINE Ints FloorLog2(Ints number) {
  return (reinterpret_cast<Ints>(ToFloats(number)) >> 23) - 127;
}

// Picture positions of table nodes, and of the nodes to their right.
struct NodePairs {
  MOCAP_INLINE NodePairs(const SensorPlaneTable::Place* nodes, const Places& places) {
    const Floats a = TwoOf(nodes, places, 0), b = TwoOf(nodes, places, 1);
    const Floats c = TwoOf(nodes, places, 2), d = TwoOf(nodes, places, 3);
    const Floats ab = __builtin_shufflevector(a, b, 0, 8, 1, 9, 4, 12, 5, 13);
    const Floats cd = __builtin_shufflevector(c, d, 0, 8, 1, 9, 4, 12, 5, 13);
    const Floats next_ab = __builtin_shufflevector(a, b, 2, 10, 3, 11, 6, 14, 7, 15);
    const Floats next_cd = __builtin_shufflevector(c, d, 2, 10, 3, 11, 6, 14, 7, 15);
    x = __builtin_shufflevector(ab, cd, 0, 1, 8, 9, 4, 5, 12, 13);
    y = __builtin_shufflevector(ab, cd, 2, 3, 10, 11, 6, 7, 14, 15);
    next_x = __builtin_shufflevector(next_ab, next_cd, 0, 1, 8, 9, 4, 5, 12, 13);
    next_y = __builtin_shufflevector(next_ab, next_cd, 2, 3, 10, 11, 6, 7, 14, 15);
  }
  Floats x, y, next_x, next_y;

 private:
  // A node and the next are four numbers. They are read at once, together with those of the lane
  // four further on, and then transposed.
  static MOCAP_INLINE Floats TwoOf(const SensorPlaneTable::Place* nodes, const Places& places,
                                   int lane) {
    float __attribute__((vector_size(16))) low, high;
    LoadLanes(&nodes[places.at[lane]].x_px, low);
    LoadLanes(&nodes[places.at[lane + 4]].x_px, high);
    return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
  }
};

struct Rectangles {
  Floats x, y, reach_x, reach_y;
  // Bits that all lanes start with, and lanes that are asked for.
  Ints known, asked;
};

MOCAP_INLINE Ints RoundedDown(Floats place_px) {
  const Floats biased = place_px + (kBias_px + 0.5f);
  return TowardsZero(Clamped(biased, 0.0f, kFarthest_px)) - kBias_px;
}

// Tests whether rectangles are inside or outside the silhouette.
MOCAP_INLINE std::uint32_t JudgeAll(const Rectangles& r, const WindowMap::Planes& planes) {
  const std::uint32_t* const words = planes.words;
  const int left = planes.left, top = planes.top, right = planes.right, bottom = planes.bottom;
  const int width = planes.width_px, height = planes.height_px, stride = planes.words_per_column;
  const Ints x0 = RoundedDown(r.x - r.reach_x), x1 = RoundedDown(r.x + r.reach_x);
  const Ints y0 = RoundedDown(r.y - r.reach_y), y1 = RoundedDown(r.y + r.reach_y);
  const Ints side = Most(x1 - x0, y1 - y0) + 1;
  // One window in each corner covers the rectangle if its side is half the longer side or more.
  const Ints plane = FloorLog2(Clamped(side - 1, 1, kWidest_px - 1));
  const Ints beyond = 1 - (AllOf(1) << plane);
  const Ints begin = plane * planes.words_per_plane;
  const Ints first_row = Clamped(y0, top, bottom) - top;
  const Ints last_row = Clamped(y1 + beyond, top, bottom) - top;
  const Ints first = Clamped(x0, left, right) - left,
             last = Clamped(x1 + beyond, left, right) - left;
  const Ints first_column = begin + (first >> 4) * stride;
  const Ints last_column = begin + (last >> 4) * stride;
  const Ints firsts = LookUp(words, Places(first_column + first_row)) &
                      LookUp(words, Places(first_column + last_row));
  const Ints lasts = LookUp(words, Places(last_column + first_row)) &
                     LookUp(words, Places(last_column + last_row));
  const Ints word = firsts >> (first & 15) & lasts >> (last & 15);
  // Negative where a condition is violated.
  const Ints in_picture = x0 | y0 | (width - 1 - x1) | (height - 1 - y1);
  const Ints touches_picture = x1 | y1 | (width - 1 - x0) | (height - 1 - y0);
  const Ints in_region =
      (x0 - left) | (y0 - top) | (right - x1) | (bottom - y1) | (kWidest_px - side);
  const Ints touches_region = (x1 - left) | (y1 - top) | (right - x0) | (bottom - y0);
  const Ints inside = word & ~Sign(in_region | in_picture) & 1;
  const Ints outside =
      ((word >> 16 & ~Sign(kWidest_px - side)) | Sign(touches_region)) & ~Sign(in_picture) & 1;
  const Ints unseen = Sign(touches_picture) & 1;
  const Ints gap = Sign(side - 2) & ~Sign(in_picture) & ~inside & ~outside & 1;
  const Ints lanes = inside | outside << 8 | unseen << 16 | gap << 24;
  alignas(32) std::array<std::uint32_t, kLanes> bits;
  StoreLanes(((lanes & r.asked) | r.known) << Ints{0, 1, 2, 3, 4, 5, 6, 7}, bits.data());
  return bits[0] | bits[1] | bits[2] | bits[3] | bits[4] | bits[5] | bits[6] | bits[7];
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
  const SensorPlaneTable::Nodes& t = eye.table;
  constexpr float kReach = SensorPlaneTable::kBendReach_cells;
  const float nearest = kNearest * half + 1;
  Floats sign_x, sign_y, sign_z;
  LoadLanes(kSignX.data(), sign_x), LoadLanes(kSignY.data(), sign_y);
  LoadLanes(kSignZ.data(), sign_z);
  const Floats wx = m0 + spread * sign_x;
  const Floats wy = m1 + spread * sign_y;
  const Floats wz = m2 + spread * sign_z;
  const Floats cx = r00 * wx + r01 * wy + r02 * wz + p0;
  const Floats cy = r10 * wx + r11 * wy + r12 * wz + p1;
  const Floats cz = r20 * wx + r21 * wy + r22 * wz + p2;
  const Ints is_ahead = cz > nearest;
  const Floats per_z = 1 / (is_ahead ? cz : AllOf(nearest));
  const Floats nx = cx * per_z, ny = cy * per_z;
  // Derivatives of (Xu/f, Yu/f) [1/mm], and the cube's reach there.
  const Floats d0 = r20 * per_z, d1 = r21 * per_z, d2 = r22 * per_z;
  const Floats u0 = r00 * per_z - nx * d0, u1 = r01 * per_z - nx * d1;
  const Floats u2 = r02 * per_z - nx * d2;
  const Floats v0 = r10 * per_z - ny * d0, v1 = r11 * per_z - ny * d1;
  const Floats v2 = r12 * per_z - ny * d2;
  const Floats slant = SizeOf(d0) + SizeOf(d1) + SizeOf(d2);
  const Floats grown = 1 / (1 - Least(half * slant, AllOf(0.5f)));
  const Floats reach_u = half * (SizeOf(u0) + SizeOf(u1) + SizeOf(u2)) * grown;
  const Floats reach_v = half * (SizeOf(v0) + SizeOf(v1) + SizeOf(v2)) * grown;
  const Floats field = t.field_radius + (reach_u + reach_v + 1e-3f);
  const Floats inner = Most(t.field_radius - (reach_u + reach_v + 1e-3f), Floats{});
  const Floats off_axis = nx * nx + ny * ny;
  const Floats beyond = Most(Most(off_axis - field * field, t.low_x - (nx + reach_u + 1e-3f)),
                             t.low_y - (ny + reach_v + 1e-3f));
  const Floats beside = Most(nx - reach_u - 1e-3f - t.high_x, ny - reach_v - 1e-3f - t.high_y);
  const Ints misses = Most(beyond, beside) > 0;
  const Ints is_behind = cz < -nearest;

  const Floats u = (nx - t.origin_x) * t.cells_per_unit;
  const Floats v = (ny - t.origin_y) * t.cells_per_unit;
  const Floats du = reach_u * t.cells_per_unit, dv = reach_v * t.cells_per_unit;
  const Floats room =
      Least(Least(Least(u - du, t.last_column - (u + du)), Least(v - dv, t.last_row - (v + dv))),
            Least(kReach - du, kReach - dv));
  const Ints is_valid = is_ahead & (inner * inner > off_axis) & (room > 0);
  const Floats near_u = Clamped(u, 0.0f, t.last_column - 1);
  const Floats near_v = Clamped(v, 0.0f, t.last_row - 1);
  const Ints column = TowardsZero(near_u), row = TowardsZero(near_v);
  const Floats a = near_u - ToFloats(column), b = near_v - ToFloats(row);
  const Places node(row * t.columns + column);
  const auto [x00, y00, x01, y01] = NodePairs(t.nodes, node);
  const auto [x10, y10, x11, y11] = NodePairs(t.nodes + t.columns, node);
  const Floats bend = LookUp(t.bends_px, node);
  const Floats top_x = x00 + a * (x01 - x00), top_y = y00 + a * (y01 - y00);
  const Floats down_x = x10 + a * (x11 - x10) - top_x, down_y = y10 + a * (y11 - y10) - top_y;
  const Floats right_x = (x01 - x00) + b * (x11 - x10 - x01 + x00);
  const Floats right_y = (y01 - y00) + b * (y11 - y10 - y01 + y00);
  const Floats x = top_x + b * down_x, y = top_y + b * down_y;
  const Floats xu = right_x * t.cells_per_unit, xv = down_x * t.cells_per_unit;
  const Floats yu = right_y * t.cells_per_unit, yv = down_y * t.cells_per_unit;
  const Floats ax0 = xu * u0 + xv * v0, ax1 = xu * u1 + xv * v1, ax2 = xu * u2 + xv * v2;
  const Floats ay0 = yu * u0 + yv * v0, ay1 = yu * u1 + yv * v1, ay2 = yu * u2 + yv * v2;
  // Within the cube, `grown` bounds 1 / (1 + depth · o), and grown² · slant its change.
  const Floats growth = grown + half * slant * grown * grown;
  const Floats reach_x = (SizeOf(ax0) + SizeOf(ax1) + SizeOf(ax2)) * growth;
  const Floats reach_y = (SizeOf(ay0) + SizeOf(ay1) + SizeOf(ay2)) * growth;
  // The slope changes at each cell boundary in between: at worst immediately and then after each
  // whole cell, and along the cells.
  const Floats error =
      bend * (Most(du, 2 * du - 1) + Most(dv, 2 * dv - 1) + du * dv) + kRounding_px;
  StoreLanes(wx, f.middle[0].data()), StoreLanes(wy, f.middle[1].data());
  StoreLanes(wz, f.middle[2].data());
  StoreLanes(x, f.x.data()), StoreLanes(y, f.y.data());
  StoreLanes(ax0, f.along_x[0].data()), StoreLanes(ax1, f.along_x[1].data());
  StoreLanes(ax2, f.along_x[2].data());
  StoreLanes(ay0, f.along_y[0].data()), StoreLanes(ay1, f.along_y[1].data());
  StoreLanes(ay2, f.along_y[2].data());
  StoreLanes(d0, f.depth[0].data()), StoreLanes(d1, f.depth[1].data());
  StoreLanes(d2, f.depth[2].data());
  StoreLanes(reach_x, f.reach_x.data()), StoreLanes(reach_y, f.reach_y.data());
  StoreLanes(is_valid ? error : error + kNoFrame_px, f.error.data());
  return JudgeAll({x, y, half * reach_x + error, half * reach_y + error,
                   (is_behind | (is_ahead & misses)) & 0x10000, is_valid},
                  eye.planes);
}

// One lane of frames, evaluated at another point.
struct Frame {
  float x, y;
  std::array<float, 3> along_x, along_y, depth;
  float reach_x, reach_y, error;
  std::array<float, 3> offset;  // Of that point from the middle.

  MOCAP_INLINE
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
  static MOCAP_INLINE std::array<float, 3> At(const std::array<Lanes, 3>& lanes, int lane) {
    return {lanes[0][lane], lanes[1][lane], lanes[2][lane]};
  }
};

// A linear function of position: its value at a point, and its gradient.
struct Slope {
  float middle, x, y, z;
  MOCAP_INLINE
  Slope(const std::array<float, 3>& slope, float constant, const std::array<float, 3>& offset)
      : middle(constant + slope[0] * offset[0] + slope[1] * offset[1] + slope[2] * offset[2]),
        x(slope[0]),
        y(slope[1]),
        z(slope[2]) {}
  // Differences to the value in the middle, for the octants.
  MOCAP_INLINE Floats Beside(float spread) const {
    Floats sign_x, sign_y, sign_z;
    LoadLanes(kSignX.data(), sign_x), LoadLanes(kSignY.data(), sign_y);
    LoadLanes(kSignZ.data(), sign_z);
    return spread * (sign_x * x + sign_y * y + sign_z * z);
  }
};

MOCAP_VECTORIZED
std::uint32_t CoarsePassAll(const Eye& eye, const OctantFrames& frames, int lane,
                            const std::array<float, 3>& middle, float spread, float half) {
  const Frame f(frames, lane, middle);
  const Slope x(f.along_x, 0, f.offset), y(f.along_y, 0, f.offset), z(f.depth, 1, f.offset);
  const float reach_x = half * f.reach_x + f.error;
  const float reach_y = half * f.reach_y + f.error;
  const Floats per_z = 1 / (z.middle + z.Beside(spread));
  return JudgeAll(
      {f.x + (x.middle + x.Beside(spread)) * per_z, f.y + (y.middle + y.Beside(spread)) * per_z,
       AllOf(reach_x), AllOf(reach_y), Ints{}, AllOf(-1)},
      eye.planes);
}

// Whether everything within `half` of a frame's position lies well within the planes' region.
MOCAP_INLINE bool IsInRegion(const WindowMap::Planes& planes, const Frame& f, float x, float y,
                             float half) {
  const float reach_x = half * f.reach_x + f.error + 1, reach_y = half * f.reach_y + f.error + 1;
  return x - reach_x > static_cast<float>(planes.left) &&
         y - reach_y > static_cast<float>(planes.top) &&
         x + reach_x < static_cast<float>(planes.right) &&
         y + reach_y < static_cast<float>(planes.bottom);
}

// The lowest bit of each byte.
constexpr std::uint64_t kEach = 0x0101010101010101;

// Sorts bytes: the lowest bytes of eight words first, then the next, and so on.
MOCAP_INLINE void SortBytes(Ints words, std::array<std::uint64_t, 4>& bytes) {
  static_assert(std::endian::native == std::endian::little);
  using Bytes = std::uint8_t __attribute__((vector_size(sizeof(Ints))));
  const auto mixed = reinterpret_cast<Bytes>(words);
  const Bytes sorted =
      __builtin_shufflevector(mixed, mixed, 0, 4, 8, 12, 16, 20, 24, 28, 1, 5, 9, 13, 17, 21, 25,
                              29, 2, 6, 10, 14, 18, 22, 26, 30, 3, 7, 11, 15, 19, 23, 27, 31);
  std::memcpy(bytes.data(), &sorted, sizeof sorted);
}

// Tests the samples of eight voxels by windows of 1 or 2 px. Returns whether all of them
// lie in the region of the planes; otherwise nothing is decided.
MOCAP_VECTORIZED
bool CoarsePassSamplesAll(const WindowMap::Planes& planes, const OctantFrames& frames, int lane,
                          const std::array<float, 3>& middle, float voxel_spread,
                          float sample_spread, unsigned asked, SampleDecisions& decisions) {
  const Frame f(frames, lane, middle);
  const Slope x(f.along_x, 0, f.offset), y(f.along_y, 0, f.offset), z(f.depth, 1, f.offset);
  if (!IsInRegion(planes, f, f.x + x.middle / z.middle, f.y + y.middle / z.middle,
                  voxel_spread + sample_spread))
    return false;
  const std::uint32_t* const words = planes.words;
  const int wider = planes.words_per_plane;
  const int stride = planes.words_per_column;
  const float error = f.error;
  const float low_x = f.x + 0.5f - error - static_cast<float>(planes.left);
  const float low_y = f.y + 0.5f - error - static_cast<float>(planes.top);
  alignas(32) Lanes voxel_x, voxel_y, voxel_z;
  StoreLanes(x.middle + x.Beside(voxel_spread), voxel_x.data());
  StoreLanes(y.middle + y.Beside(voxel_spread), voxel_y.data());
  StoreLanes(z.middle + z.Beside(voxel_spread), voxel_z.data());
  const Floats sample_x = x.Beside(sample_spread), sample_y = y.Beside(sample_spread);
  const Floats sample_z = z.Beside(sample_spread);
  // One word per sample. Its bytes tell inside, undecided and outside, one bit per voxel.
  Ints collected{};
  for (unsigned left_over = asked; left_over != 0; left_over &= left_over - 1) {
    const int voxel = std::countr_zero(left_over);
    const Floats per_z = 1 / (voxel_z[voxel] + sample_z);
    const Floats left = low_x + (voxel_x[voxel] + sample_x) * per_z;
    const Floats top = low_y + (voxel_y[voxel] + sample_y) * per_z;
    const Ints column = TowardsZero(left), row = TowardsZero(top);
    const Ints is_wide =
        (TowardsZero(left + 2 * error) - column) | (TowardsZero(top + 2 * error) - row);
    const Places place((-is_wide & wider) + (column >> 4) * stride + row);
    const Ints word = LookUp(words, place) >> (column & 15);
    collected |= ((word & 0x10001) | is_wide << 8) << voxel;
  }
  std::array<std::uint64_t, 4> bytes;
  SortBytes(collected, bytes);
  const auto [inside, undecided, outside, none] = bytes;
  decisions = {inside, outside, 0, kEach * asked & ~(inside | undecided | outside)};
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

OctantDecisions OctantView::Project(const Eigen::Vector3f& middle, float spread, float half,
                                    OctantFrames& frames, std::uint8_t& framed) const {
  const std::uint32_t bits =
      ProjectAll(eye_, {middle.x(), middle.y(), middle.z()}, spread, half, frames);
  framed = 0;
  for (int i = 0; i < kLanes; ++i)
    if (frames.error[i] < kGoodFrame_px) framed |= static_cast<std::uint8_t>(1 << i);
  return Unpack(bits);
}

OctantDecisions OctantView::CoarsePass(const OctantFrames& frames, int lane,
                                       const Eigen::Vector3f& middle, float spread,
                                       float half) const {
  return Unpack(
      CoarsePassAll(eye_, frames, lane, {middle.x(), middle.y(), middle.z()}, spread, half));
}

SampleDecisions OctantView::CoarsePassSamples(const OctantFrames& frames, int lane,
                                              const Eigen::Vector3f& middle, float voxel_spread,
                                              float sample_spread, std::uint8_t asked) const {
  const std::array<float, 3> p = {middle.x(), middle.y(), middle.z()};
  SampleDecisions decisions;
  if (CoarsePassSamplesAll(eye_.planes, frames, lane, p, voxel_spread, sample_spread, asked,
                           decisions))
    return decisions;
  const OctantDecisions voxels =
      Unpack(CoarsePassAll(eye_, frames, lane, p, voxel_spread, sample_spread));
  decisions = {kEach * voxels.inside, kEach * voxels.outside, kEach * voxels.unseen, 0};
  unsigned open = asked & ~(voxels.inside | voxels.outside | voxels.unseen);
  for (; open != 0; open &= open - 1) {
    const int voxel = std::countr_zero(open);
    const OctantDecisions samples = Unpack(
        CoarsePassAll(eye_, frames, lane,
                      {p[0] + kSignX[voxel] * voxel_spread, p[1] + kSignY[voxel] * voxel_spread,
                       p[2] + kSignZ[voxel] * voxel_spread},
                      sample_spread, 0));
    decisions.inside |= SpreadBits(samples.inside) << voxel;
    decisions.outside |= SpreadBits(samples.outside) << voxel;
    decisions.unseen |= SpreadBits(samples.unseen) << voxel;
    decisions.gap |= SpreadBits(samples.gap) << voxel;
  }
  return decisions;
}

}  // namespace mocap
