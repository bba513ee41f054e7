#include "core/kernels/octants.h"

#include <bit>
#include <cstddef>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/kernels/octants.cpp"
#include "core/kernels/each_target.h"
#include "core/kernels/octants-inl.h"

HWY_BEFORE_NAMESPACE();
namespace mocap::kernels::HWY_NAMESPACE {
namespace {

HWY_INLINE OctantBits Packed(unsigned inside, unsigned outside, unsigned unseen, unsigned unknown,
                             std::size_t k) {
  return (inside | outside << 8 | unseen << 16 | unknown << 24) << k;
}

HWY_INLINE void Store(Floats numbers, OctantFrames::Lanes& to, std::size_t k) {
  hn::StoreU(numbers, kFloats, &to[k]);
}

// Along x, y and z of the world, for each octant.
using Gradients = std::array<Floats, 3>;

HWY_INLINE void Store(const Gradients& numbers, std::array<OctantFrames::Lanes, 3>& to,
                      std::size_t k) {
  for (std::size_t i = 0; i < 3; ++i) Store(numbers[i], to[i], k);
}

// The most that a linear function changes within a cube, per half of its side.
HWY_INLINE Floats Reach(const Gradients& g) {
  return hn::Abs(g[0]) + hn::Abs(g[1]) + hn::Abs(g[2]);
}

// Cubes on the sensor plane (Xu/f, Yu/f).
struct PlaneView {
  Floats x, y;
  Gradients along_x, along_y;  // [1/mm].
  Floats reach_x, reach_y;     // Of the cube around (x, y).
  Gradients depth;             // Change of the depth, as a share of it [1/mm].
  Floats slant, grown;         // Its reach; a bound of 1 / (1 + depth · o) within the cube.
  Choice is_ahead, is_behind;
};

HWY_INLINE Gradients Turned(const std::array<float, 3>& row, Floats per_z) {
  return {All(row[0]) * per_z, All(row[1]) * per_z, All(row[2]) * per_z};
}

HWY_INLINE Floats InCamera(const OctantCamera& camera, std::size_t axis, const Gradients& w) {
  const auto& row = camera.R[axis];
  return All(row[0]) * w[0] + All(row[1]) * w[1] + All(row[2]) * w[2] + All(camera.p[axis]);
}

HWY_INLINE PlaneView OnPlane(const OctantCamera& camera, const Gradients& w, float half) {
  const float nearest = kNearestOctant * half + 1;
  const Floats one = All(1.0f);
  const Floats cx = InCamera(camera, 0, w), cy = InCamera(camera, 1, w);
  const Floats cz = InCamera(camera, 2, w);
  PlaneView view;
  view.is_ahead = hn::Gt(cz, All(nearest));
  view.is_behind = hn::Lt(cz, All(-nearest));
  const Floats per_z = one / hn::IfThenElse(view.is_ahead, cz, All(nearest));
  view.x = cx * per_z;
  view.y = cy * per_z;
  view.depth = Turned(camera.R[2], per_z);
  const Gradients right = Turned(camera.R[0], per_z), down = Turned(camera.R[1], per_z);
  for (std::size_t i = 0; i < 3; ++i) {
    view.along_x[i] = right[i] - view.x * view.depth[i];
    view.along_y[i] = down[i] - view.y * view.depth[i];
  }
  view.slant = Reach(view.depth);
  view.grown = one / (one - Lesser(All(half) * view.slant, All(0.5f)));
  view.reach_x = All(half) * Reach(view.along_x) * view.grown;
  view.reach_y = All(half) * Reach(view.along_y) * view.grown;
  return view;
}

// Which cubes the lens shows as a whole, and which lie outside its picture.
struct FieldTest {
  Choice is_inside, misses;
};

HWY_INLINE FieldTest TestField(const SensorPlaneNodes& t, const PlaneView& view) {
  const Floats small = All(1e-3f);
  const Floats rim = view.reach_x + view.reach_y + small;
  const Floats field = All(t.field_radius) + rim;
  const Floats inner = Larger(All(t.field_radius) - rim, hn::Zero(kFloats));
  const Floats off_axis = view.x * view.x + view.y * view.y;
  const Floats beyond =
      Larger(Larger(off_axis - field * field, All(t.low_x) - (view.x + view.reach_x + small)),
             All(t.low_y) - (view.y + view.reach_y + small));
  const Floats beside = Larger(view.x - view.reach_x - small - All(t.high_x),
                               view.y - view.reach_y - small - All(t.high_y));
  return {hn::Gt(inner * inner, off_axis), hn::Gt(Larger(beyond, beside), hn::Zero(kFloats))};
}

// Cubes in the table of the sensor plane, in its cells.
struct TablePlace {
  Floats u, v, reach_u, reach_v;
  Choice has_room;  // The table holds all of the cube.
};

HWY_INLINE TablePlace InTable(const SensorPlaneNodes& t, const PlaneView& view) {
  const Floats scale = All(t.cells_per_unit);
  const Floats u = (view.x - All(t.origin_x)) * scale, v = (view.y - All(t.origin_y)) * scale;
  const Floats du = view.reach_x * scale, dv = view.reach_y * scale;
  const Floats reach = All(static_cast<float>(kBendReach_cells));
  const Floats room = Lesser(Lesser(Lesser(u - du, All(t.last_column) - (u + du)),
                                    Lesser(v - dv, All(t.last_row) - (v + dv))),
                             Lesser(reach - du, reach - dv));
  return {u, v, du, dv, hn::Gt(room, hn::Zero(kFloats))};
}

// The table at a place: pixels, their slopes per unit of the sensor plane, and the bend [px].
struct TableLook {
  Floats x, y, x_per_u, x_per_v, y_per_u, y_per_v, bend;
};

HWY_INLINE TableLook LookUp(const SensorPlaneNodes& t, const TablePlace& place) {
  const Floats near_u = Clamped(kFloats, place.u, 0.0f, t.last_column - 1);
  const Floats near_v = Clamped(kFloats, place.v, 0.0f, t.last_row - 1);
  const Ints column = Truncated(kFloats, near_u), row = Truncated(kFloats, near_v);
  const Floats a = near_u - hn::ConvertTo(kFloats, column);
  const Floats b = near_v - hn::ConvertTo(kFloats, row);
  const Places<D> node(row * All(t.columns) + column);
  const auto [x00, y00, x01, y01] = LoadPairs(t.nodes, node);
  const auto [x10, y10, x11, y11] = LoadPairs(t.nodes + t.columns, node);
  const Floats top_x = x00 + a * (x01 - x00), top_y = y00 + a * (y01 - y00);
  const Floats down_x = x10 + a * (x11 - x10) - top_x, down_y = y10 + a * (y11 - y10) - top_y;
  const Floats right_x = (x01 - x00) + b * (x11 - x10 - x01 + x00);
  const Floats right_y = (y01 - y00) + b * (y11 - y10 - y01 + y00);
  const Floats scale = All(t.cells_per_unit);
  return {top_x + b * down_x, top_y + b * down_y, right_x * scale,        down_x * scale,
          right_y * scale,    down_y * scale,     node.LookUp(t.bends_px)};
}

// The slope changes at each cell boundary within the cube: at worst immediately and then after each
// whole cell, and along the cells.
HWY_INLINE Floats ErrorOf(const TablePlace& place, Floats bend) {
  const Floats one = All(1.0f), two = All(2.0f), du = place.reach_u, dv = place.reach_v;
  return bend * (Larger(du, two * du - one) + Larger(dv, two * dv - one) + du * dv) +
         All(kOctantRounding_px);
}

HWY_INLINE Gradients Chained(Floats per_u, Floats per_v, const PlaneView& view) {
  return {per_u * view.along_x[0] + per_v * view.along_y[0],
          per_u * view.along_x[1] + per_v * view.along_y[1],
          per_u * view.along_x[2] + per_v * view.along_y[2]};
}

// Projects octants from the k-th on.
HWY_INLINE OctantBits Project(const OctantCamera& camera, const std::array<float, 3>& middle,
                              float spread, float half, std::size_t k, OctantFrames& f) {
  const Gradients w = {All(middle[0]) + All(spread) * hn::LoadU(kFloats, &kOctantX[k]),
                       All(middle[1]) + All(spread) * hn::LoadU(kFloats, &kOctantY[k]),
                       All(middle[2]) + All(spread) * hn::LoadU(kFloats, &kOctantZ[k])};
  const PlaneView view = OnPlane(camera, w, half);
  const FieldTest field = TestField(camera.table, view);
  const TablePlace place = InTable(camera.table, view);
  const TableLook look = LookUp(camera.table, place);
  const Choice is_valid = hn::And(hn::And(view.is_ahead, field.is_inside), place.has_room);
  const Gradients along_x = Chained(look.x_per_u, look.x_per_v, view);
  const Gradients along_y = Chained(look.y_per_u, look.y_per_v, view);
  // Within the cube, `grown` bounds 1 / (1 + depth · o), and grown² · slant its change.
  const Floats growth = view.grown + All(half) * view.slant * view.grown * view.grown;
  const Floats reach_x = Reach(along_x) * growth, reach_y = Reach(along_y) * growth;
  const Floats error = ErrorOf(place, look.bend);
  Store(w, f.middle, k), Store(look.x, f.x, k), Store(look.y, f.y, k);
  Store(along_x, f.along_x, k), Store(along_y, f.along_y, k), Store(view.depth, f.depth, k);
  Store(reach_x, f.reach_x, k), Store(reach_y, f.reach_y, k);
  Store(hn::IfThenElse(is_valid, error, error + All(kNoFrame_px)), f.error, k);
  const Answer answer = Judge(
      {look.x, look.y, All(half) * reach_x + error, All(half) * reach_y + error}, camera.planes);
  const Choice unseen = hn::Or(view.is_behind, hn::And(view.is_ahead, field.misses));
  return Packed(BitsOf(hn::And(answer.inside, is_valid)), BitsOf(hn::And(answer.outside, is_valid)),
                BitsOf(hn::Or(hn::And(answer.unseen, is_valid), unseen)),
                BitsOf(hn::And(answer.unknown, is_valid)), k);
}

OctantBits ProjectAll(const OctantCamera& camera, const std::array<float, 3>& middle, float spread,
                      float half, OctantFrames& frames) {
  OctantBits bits = 0;
  for (std::size_t k = 0; k < kOctants; k += kLanes)
    bits |= Project(camera, middle, spread, half, k, frames);
  return bits;
}

using Gradient = std::array<float, 3>;

HWY_INLINE Gradient At(const std::array<OctantFrames::Lanes, 3>& lanes, int lane) {
  return {lanes[0][lane], lanes[1][lane], lanes[2][lane]};
}

// One octant's frame, evaluated at another point.
struct Frame {
  HWY_INLINE Frame(const OctantFrames& f, int lane, const std::array<float, 3>& place)
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

  float x, y;
  Gradient along_x, along_y, depth;
  float reach_x, reach_y, error;
  std::array<float, 3> offset;  // Of that point from the middle.
};

// A linear function of position: its value at a point, and its gradient.
struct Slope {
  HWY_INLINE Slope(const Gradient& slope, float constant, const std::array<float, 3>& offset)
      : middle(constant + slope[0] * offset[0] + slope[1] * offset[1] + slope[2] * offset[2]),
        gradient(slope) {}
  // Differences to the value in the middle, for octants from the k-th on.
  HWY_INLINE Floats Beside(float spread, std::size_t k) const {
    return All(spread) * (hn::LoadU(kFloats, &kOctantX[k]) * All(gradient[0]) +
                          hn::LoadU(kFloats, &kOctantY[k]) * All(gradient[1]) +
                          hn::LoadU(kFloats, &kOctantZ[k]) * All(gradient[2]));
  }
  float middle;
  Gradient gradient;
};

OctantBits JudgeAll(const WindowPlanes& planes, const OctantFrames& frames, int octant,
                    const std::array<float, 3>& middle, float spread, float half) {
  const Frame f(frames, octant, middle);
  const Slope x(f.along_x, 0, f.offset), y(f.along_y, 0, f.offset), z(f.depth, 1, f.offset);
  const Floats reach_x = All(half * f.reach_x + f.error);
  const Floats reach_y = All(half * f.reach_y + f.error);
  OctantBits bits = 0;
  for (std::size_t k = 0; k < kOctants; k += kLanes) {
    const Floats per_z = All(1.0f) / (All(z.middle) + z.Beside(spread, k));
    const Answer answer =
        Judge({All(f.x) + (All(x.middle) + x.Beside(spread, k)) * per_z,
               All(f.y) + (All(y.middle) + y.Beside(spread, k)) * per_z, reach_x, reach_y},
              planes);
    bits |= Packed(BitsOf(answer.inside), BitsOf(answer.outside), BitsOf(answer.unseen),
                   BitsOf(answer.unknown), k);
  }
  return bits;
}

// Whether everything within `half` of a frame's position lies well within the planes' region.
HWY_INLINE bool IsInRegion(const WindowPlanes& planes, const Frame& f, float x, float y,
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
using Words = std::array<std::uint32_t, kOctants>;
using SortedBytes = std::array<std::uint64_t, 4>;

#if HWY_TARGET == HWY_SCALAR

HWY_INLINE SortedBytes Sort(const Words& words) {
  SortedBytes bytes{};
  for (std::size_t plane = 0; plane < bytes.size(); ++plane)
    for (std::size_t i = 0; i < words.size(); ++i)
      bytes[plane] |= std::uint64_t{words[i] >> 8 * plane & 0xff} << 8 * i;
  return bytes;
}

#else

HWY_INLINE SortedBytes Sort(const Words& words) {
  static_assert(std::endian::native == std::endian::little);
  constexpr hn::FixedTag<std::uint8_t, 16> bytes;
  constexpr hn::FixedTag<std::uint32_t, 4> fours;
  constexpr hn::FixedTag<std::uint64_t, 2> eights;
  alignas(16) constexpr std::array<std::uint8_t, 16> kOrder = {0, 4, 8,  12, 1, 5, 9,  13,
                                                               2, 6, 10, 14, 3, 7, 11, 15};
  const auto order = hn::Load(bytes, kOrder.data());
  const auto first = hn::BitCast(bytes, hn::Load(fours, &words[0]));
  const auto second = hn::BitCast(bytes, hn::Load(fours, &words[4]));
  const auto low = hn::BitCast(fours, hn::TableLookupBytes(first, order));
  const auto high = hn::BitCast(fours, hn::TableLookupBytes(second, order));
  alignas(16) SortedBytes sorted;
  hn::Store(hn::BitCast(eights, hn::InterleaveLower(fours, low, high)), eights, &sorted[0]);
  hn::Store(hn::BitCast(eights, hn::InterleaveUpper(fours, low, high)), eights, &sorted[2]);
  return sorted;
}

#endif  // HWY_TARGET == HWY_SCALAR

bool JudgeAllSamples(const WindowPlanes& planes, const OctantFrames& frames, int octant,
                     const std::array<float, 3>& middle, float voxel_spread, float sample_spread,
                     unsigned asked, SampleDecisions& decisions) {
  const Frame f(frames, octant, middle);
  const Slope x(f.along_x, 0, f.offset), y(f.along_y, 0, f.offset), z(f.depth, 1, f.offset);
  if (!IsInRegion(planes, f, f.x + x.middle / z.middle, f.y + y.middle / z.middle,
                  voxel_spread + sample_spread))
    return false;
  const float error = f.error;
  const Floats low_x = All(f.x + 0.5f - error - static_cast<float>(planes.left));
  const Floats low_y = All(f.y + 0.5f - error - static_cast<float>(planes.top));
  const Floats wide = All(2 * error);
  alignas(32) OctantFrames::Lanes voxel_x, voxel_y, voxel_z;
  for (std::size_t k = 0; k < kOctants; k += kLanes) {
    Store(All(x.middle) + x.Beside(voxel_spread, k), voxel_x, k);
    Store(All(y.middle) + y.Beside(voxel_spread, k), voxel_y, k);
    Store(All(z.middle) + z.Beside(voxel_spread, k), voxel_z, k);
  }
  // One word per sample. Its bytes tell inside, undecided and outside, one bit per voxel.
  alignas(32) Words words;
  for (std::size_t k = 0; k < kOctants; k += kLanes) {
    constexpr hn::RebindToUnsigned<IntsFor<D>> kWords;
    const Floats sample_x = x.Beside(sample_spread, k), sample_y = y.Beside(sample_spread, k);
    const Floats sample_z = z.Beside(sample_spread, k);
    auto collected = hn::Zero(kWords);
    for (unsigned left_over = asked; left_over != 0; left_over &= left_over - 1) {
      const int voxel = std::countr_zero(left_over);
      const Floats per_z = All(1.0f) / (All(voxel_z[voxel]) + sample_z);
      const Floats left = low_x + (All(voxel_x[voxel]) + sample_x) * per_z;
      const Floats top = low_y + (All(voxel_y[voxel]) + sample_y) * per_z;
      const Ints column = Truncated(kFloats, left), row = Truncated(kFloats, top);
      const Ints is_wide =
          hn::Or(Truncated(kFloats, left + wide) - column, Truncated(kFloats, top + wide) - row);
      const Places<D> place(hn::And(hn::Neg(is_wide), All(planes.words_per_plane)) +
                            hn::ShiftRight<4>(column) * All(planes.words_per_column) + row);
      const auto word = place.LookUp(planes.words) >> hn::BitCast(kWords, hn::And(column, All(15)));
      const auto bits = hn::Or(hn::And(word, hn::Set(kWords, 0x10001)),
                               hn::ShiftLeft<8>(hn::BitCast(kWords, is_wide)));
      collected = hn::Or(collected, hn::ShiftLeftSame(bits, voxel));
    }
    hn::Store(collected, kWords, &words[k]);
  }
  const auto [inside, undecided, outside, none] = Sort(words);
  decisions = {inside, outside, 0, kEach * asked & ~(inside | undecided | outside)};
  return true;
}

}  // namespace
}  // namespace mocap::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mocap::kernels {

HWY_EXPORT(ProjectAll);
OctantBits ProjectOctants(const OctantCamera& camera, const std::array<float, 3>& middle,
                          float spread, float half, OctantFrames& frames) {
  return HWY_DYNAMIC_DISPATCH(ProjectAll)(camera, middle, spread, half, frames);
}

HWY_EXPORT(JudgeAll);
OctantBits JudgeOctants(const WindowPlanes& planes, const OctantFrames& frames, int octant,
                        const std::array<float, 3>& middle, float spread, float half) {
  return HWY_DYNAMIC_DISPATCH(JudgeAll)(planes, frames, octant, middle, spread, half);
}

HWY_EXPORT(JudgeAllSamples);
bool JudgeSamples(const WindowPlanes& planes, const OctantFrames& frames, int octant,
                  const std::array<float, 3>& middle, float voxel_spread, float sample_spread,
                  unsigned asked, SampleDecisions& decisions) {
  return HWY_DYNAMIC_DISPATCH(JudgeAllSamples)(planes, frames, octant, middle, voxel_spread,
                                               sample_spread, asked, decisions);
}

}  // namespace mocap::kernels
#endif  // HWY_ONCE
