// Looks up rectangles and directions in a camera's tables. For octants.cpp only.
#if defined(MOCAP_CORE_KERNELS_OCTANTS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef MOCAP_CORE_KERNELS_OCTANTS_INL_H
#undef MOCAP_CORE_KERNELS_OCTANTS_INL_H
#else
#define MOCAP_CORE_KERNELS_OCTANTS_INL_H
#endif

#include "core/kernels/octants.h"
#include "core/kernels/vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace mocap::kernels::HWY_NAMESPACE {
namespace {

constexpr std::size_t kOctants = OctantFrames::kLanes;

// As many octants as fit into a vector are tested at once.
using D = FloatsUpTo<kOctants>;
constexpr D kFloats;
constexpr IntsFor<D> kInts;
constexpr std::size_t kLanes = hn::MaxLanes(kFloats);
using Floats = hn::Vec<D>;
using Ints = hn::Vec<IntsFor<D>>;
using Choice = hn::Mask<D>;

HWY_INLINE Floats All(float number) { return hn::Set(kFloats, number); }
HWY_INLINE Ints All(int number) { return hn::Set(kInts, number); }

HWY_INLINE unsigned BitsOf(Choice choice) { return HWY_NAMESPACE::BitsOf(kFloats, choice); }
HWY_INLINE Choice IsNegative(Ints number) {
  return hn::RebindMask(kFloats, hn::Lt(number, hn::Zero(kInts)));
}
HWY_INLINE Choice HasBit(Ints bits, int bit) {
  return hn::RebindMask(kFloats, hn::TestBit(bits, All(bit)));
}

// Picture positions of table nodes, and of the nodes to their right.
struct NodePairs {
  Floats x, y, next_x, next_y;
};

#if HWY_TARGET == HWY_SCALAR

HWY_INLINE NodePairs LoadPairs(const PicturePlace* nodes, const Places<D>& places) {
  const PicturePlace* const node = nodes + places[0];
  return {All(node[0].x_px), All(node[0].y_px), All(node[1].x_px), All(node[1].y_px)};
}

#else

// A node and the next are four numbers. They are read at once, and in wide vectors together with
// those of the lane four further on.
template <typename Tag>
HWY_INLINE hn::Vec<Tag> LoadPair(Tag tag, const PicturePlace* nodes, const Places<Tag>& places,
                                 int lane) {
  if constexpr (hn::MaxLanes(Tag()) == 8) {
    constexpr hn::Half<Tag> half;
    return hn::Combine(tag, hn::LoadU(half, &nodes[places[lane + 4]].x_px),
                       hn::LoadU(half, &nodes[places[lane]].x_px));
  } else {
    return hn::LoadU(tag, &nodes[places[lane]].x_px);
  }
}

HWY_INLINE NodePairs LoadPairs(const PicturePlace* nodes, const Places<D>& places) {
  constexpr hn::RepartitionToWide<D> wide;
  const Floats a = LoadPair(kFloats, nodes, places, 0), b = LoadPair(kFloats, nodes, places, 1);
  const Floats c = LoadPair(kFloats, nodes, places, 2), e = LoadPair(kFloats, nodes, places, 3);
  // Transposes.
  const auto ab = hn::BitCast(wide, hn::InterleaveLower(kFloats, a, b));
  const auto ce = hn::BitCast(wide, hn::InterleaveLower(kFloats, c, e));
  const auto next_ab = hn::BitCast(wide, hn::InterleaveUpper(kFloats, a, b));
  const auto next_ce = hn::BitCast(wide, hn::InterleaveUpper(kFloats, c, e));
  return {hn::BitCast(kFloats, hn::InterleaveLower(wide, ab, ce)),
          hn::BitCast(kFloats, hn::InterleaveUpper(wide, ab, ce)),
          hn::BitCast(kFloats, hn::InterleaveLower(wide, next_ab, next_ce)),
          hn::BitCast(kFloats, hn::InterleaveUpper(wide, next_ab, next_ce))};
}

#endif  // HWY_TARGET == HWY_SCALAR

struct Rectangles {
  Floats x, y, reach_x, reach_y;
};

HWY_INLINE Ints RoundedDown(Floats place_px) {
  const Floats biased = place_px + All(kPlaceBias_px + 0.5f);
  return Truncated(kFloats, Clamped(kFloats, biased, 0.0f, kFarthestPlace_px)) - All(kPlaceBias_px);
}

HWY_INLINE Ints Within(Ints number, int low, int high) {
  return hn::Min(hn::Max(number, All(low)), All(high));
}

// What is known of rectangles.
struct Answer {
  Choice inside, outside, unseen, unknown;
};

// Tests whether rectangles are inside or outside the silhouette.
HWY_INLINE Answer Judge(const Rectangles& r, const WindowPlanes& planes) {
  const std::uint32_t* const words = planes.words;
  const int left = planes.left, top = planes.top, right = planes.right, bottom = planes.bottom;
  const Ints x0 = RoundedDown(r.x - r.reach_x), x1 = RoundedDown(r.x + r.reach_x);
  const Ints y0 = RoundedDown(r.y - r.reach_y), y1 = RoundedDown(r.y + r.reach_y);
  const Ints side = hn::Max(x1 - x0, y1 - y0) + All(1);
  // One window in each corner covers the rectangle if its side is half the longer side or more. A
  // float's exponent is a logarithm.
  const Ints exponent =
      hn::BitCast(kInts, hn::ConvertTo(kFloats, Within(side - All(1), 1, kWidestOctant_px - 1)));
  const Ints plane = hn::ShiftRight<23>(exponent) - All(127);
  const Ints width = Truncated(kFloats, hn::BitCast(kFloats, hn::And(exponent, All(0x7f800000))));
  const Ints beyond = All(1) - width;
  const Ints begin = plane * All(planes.words_per_plane);
  const Ints first_row = Within(y0, top, bottom) - All(top);
  const Ints last_row = Within(y1 + beyond, top, bottom) - All(top);
  const Ints first = Within(x0, left, right) - All(left);
  const Ints last = Within(x1 + beyond, left, right) - All(left);
  const Ints stride = All(planes.words_per_column);
  const Ints first_column = begin + hn::ShiftRight<4>(first) * stride;
  const Ints last_column = begin + hn::ShiftRight<4>(last) * stride;
  constexpr hn::RebindToUnsigned<IntsFor<D>> kWords;
  const auto firsts = hn::And(Places<D>(first_column + first_row).LookUp(words),
                              Places<D>(first_column + last_row).LookUp(words));
  const auto lasts = hn::And(Places<D>(last_column + first_row).LookUp(words),
                             Places<D>(last_column + last_row).LookUp(words));
  const Ints word =
      hn::BitCast(kInts, hn::And(firsts >> hn::BitCast(kWords, hn::And(first, All(15))),
                                 lasts >> hn::BitCast(kWords, hn::And(last, All(15)))));
  const Ints picture_right = All(planes.width_px - 1), picture_bottom = All(planes.height_px - 1);
  const Ints too_wide = All(kWidestOctant_px) - side;
  // Negative where a condition is violated.
  const Ints in_picture = hn::Or(hn::Or(x0, y0), hn::Or(picture_right - x1, picture_bottom - y1));
  const Ints touches_picture =
      hn::Or(hn::Or(x1, y1), hn::Or(picture_right - x0, picture_bottom - y0));
  const Ints in_region = hn::Or(
      hn::Or(hn::Or(x0 - All(left), y0 - All(top)), hn::Or(All(right) - x1, All(bottom) - y1)),
      too_wide);
  const Ints touches_region =
      hn::Or(hn::Or(x1 - All(left), y1 - All(top)), hn::Or(All(right) - x0, All(bottom) - y0));
  const Choice is_beyond = IsNegative(in_picture);
  const Choice inside = hn::AndNot(IsNegative(hn::Or(in_region, in_picture)), HasBit(word, 1));
  const Choice outside = hn::AndNot(
      is_beyond,
      hn::Or(hn::AndNot(IsNegative(too_wide), HasBit(word, 1 << 16)), IsNegative(touches_region)));
  const Choice is_small = IsNegative(side - All(2));
  const Choice unknown = hn::AndNot(is_beyond, hn::AndNot(hn::Or(inside, outside), is_small));
  return {inside, outside, IsNegative(touches_picture), unknown};
}

}  // namespace
}  // namespace mocap::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // MOCAP_CORE_KERNELS_OCTANTS_INL_H
