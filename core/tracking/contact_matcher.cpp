#include "core/tracking/contact_matcher.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/errors.h"
#include "core/lanes.h"

namespace mocap {
namespace {

using Block = ContactMatcher::Block;
using SlimCapsule = ContactMatcher::SlimCapsule;
using SlimShape = ContactMatcher::SlimShape;
using Best = ContactMatcher::Best;

// A place on the inside of the left leg is no evidence for the right one: surfaces that face
// square to each other count as this far apart.
constexpr float kSquare_mm = 40;
// Lengths are no less, so that nothing is divided by zero.
constexpr float kLeastSq_mm2 = 1e-3f;
constexpr float kParallel = 1e-4f;
// More than rounding makes of a distance between boxes.
constexpr float kRounding_mm = 0.1f;
// Contacts are sorted by cells of this size; edges longer than that by themselves, for their boxes
// are large.
constexpr double kCell_mm = 128;
constexpr double kLong_mm = 400;
constexpr int kIndexBits = 16;

// Closest places of two segments (Ericson 2005, §5.1.9), without branches.
MOCAP_INLINE void TryCapsule(const Block& block, int i, const SlimCapsule& capsule, int index,
                             Best& best) {
  const float cx = capsule.core.x(), cy = capsule.core.y(), cz = capsule.core.z();
  const float core_sq = capsule.core_sq, per_core_sq = 1 / core_sq;
  Floats lx, ly, lz, bx, by, bz, along_sq, per_along_sq;
  LoadLanes(&block.along[0][i], lx), LoadLanes(&block.along[1][i], ly),
      LoadLanes(&block.along[2][i], lz);
  LoadLanes(&block.from[0][i], bx), LoadLanes(&block.from[1][i], by),
      LoadLanes(&block.from[2][i], bz);
  LoadLanes(&block.along_sq[i], along_sq), LoadLanes(&block.per_along_sq[i], per_along_sq);
  bx = capsule.a.x() - bx, by = capsule.a.y() - by, bz = capsule.a.z() - bz;
  const Floats dot = cx * lx + cy * ly + cz * lz;
  const Floats c = cx * bx + cy * by + cz * bz;
  const Floats f = lx * bx + ly * by + lz * bz;
  const Floats slant = core_sq * along_sq - dot * dot;
  const Floats least = kParallel * core_sq * along_sq;
  Floats first = (dot * f - c * along_sq) / (slant > least ? slant : least);
  ClampLanes(first, 0.0f, 1.0f);
  Floats on_segment = (dot * first + f) * per_along_sq;
  ClampLanes(on_segment, 0.0f, 1.0f);
  Floats share = (dot * on_segment - c) * per_core_sq;
  ClampLanes(share, 0.0f, 1.0f);
  const Floats x = on_segment * lx - bx - share * cx;
  const Floats y = on_segment * ly - by - share * cy;
  const Floats z = on_segment * lz - bz - share * cz;
  Floats length = x * x + y * y + z * z;
  TakeRoots(length);
  const Floats outside = length - capsule.radius - share * capsule.taper;
  const Floats apart = outside > 0 ? outside : -outside;
  Floats ox, oy, oz, least_yet, distance_yet;
  Ints best_yet;
  LoadLanes(&block.outward[0][i], ox), LoadLanes(&block.outward[1][i], oy),
      LoadLanes(&block.outward[2][i], oz);
  LoadLanes(&best.mismatch[i], least_yet), LoadLanes(&best.distance[i], distance_yet);
  LoadLanes(&best.capsule[i], best_yet);
  const Floats facing = (ox * x + oy * y + oz * z) / (length + 1);
  const Floats value = apart + kSquare_mm * (1 - facing);
  // Parts that share a joint are as near to what lies beside it: whichever is tried first.
  const Ints is_better = (value < least_yet) | ((value == least_yet) & (index < best_yet));
  const Ints capsule_now = is_better ? Ints{} + index : best_yet;
  const Floats distance_now = is_better ? apart : distance_yet;
  const Floats least_now = is_better ? value : least_yet;
  StoreLanes(capsule_now, &best.capsule[i]);
  StoreLanes(distance_now, &best.distance[i]);
  StoreLanes(least_now, &best.mismatch[i]);
}

// By halves, so that no comparison waits for the one before.
MOCAP_INLINE float WorstOf(const Best& best) {
  static_assert(Block::kContacts == 2 * kFloats);
  Floats a, b;
  LoadLanes(&best.mismatch[0], a), LoadLanes(&best.mismatch[kFloats], b);
  a = a > b ? a : b;
  const float ab = std::max(std::max(a[0], a[1]), std::max(a[2], a[3]));
  return std::max(ab, std::max(std::max(a[4], a[5]), std::max(a[6], a[7])));
}

using Gaps = std::array<float, ContactMatcher::kMostCapsules>;

// How far the box around a block is from each capsule's.
inline __attribute__((always_inline)) void FindGaps(const Block& block, const SlimShape& shape,
                                                    int count, Gaps& gaps) {
  const float low_x = block.low.x(), low_y = block.low.y(), low_z = block.low.z();
  const float high_x = block.high.x(), high_y = block.high.y(), high_z = block.high.z();
#pragma GCC ivdep
  for (int k = 0; k < count; ++k) {
    const float x = std::max(shape.low[0][k] - high_x, low_x - shape.high[0][k]);
    const float y = std::max(shape.low[1][k] - high_y, low_y - shape.high[1][k]);
    const float z = std::max(shape.low[2][k] - high_z, low_z - shape.high[2][k]);
    gaps[k] = std::max(std::max(x, y), z);
  }
}

MOCAP_INLINE std::uint64_t WithinOf(const Gaps& gaps, std::uint64_t some, float reach) {
  std::uint64_t within = 0;
  for (; some != 0; some &= some - 1) {
    const int k = std::countr_zero(some);
    within |= std::uint64_t{gaps[k] <= reach + kRounding_mm} << k;
  }
  return within;
}

MOCAP_INLINE void TryCapsules(const Block& block, const SlimShape& shape, std::uint64_t some,
                              Best& best) {
  for (; some != 0; some &= some - 1) {
    const int k = std::countr_zero(some);
    for (int i = 0; i < Block::kContacts; i += kFloats)
      TryCapsule(block, i, shape.capsules[k], k, best);
  }
}

// A capsule's mismatch is no less than the gap to it. Which are tried is decided once, after the
// favourites: a decision after each would wait for its outcome.
MOCAP_VECTORIZED
void MatchBlock(const Block& block, const SlimShape& shape, float reach, Best& best) {
  best.mismatch.fill(reach);
  best.distance.fill(reach);
  best.capsule.fill(-1);
  const int count = static_cast<int>(shape.capsules.size());
  Gaps gaps;
  FindGaps(block, shape, count, gaps);
  const std::uint64_t all = ~std::uint64_t{0} >> (64 - count);
  TryCapsules(block, shape, WithinOf(gaps, all & block.favourites, reach), best);
  TryCapsules(block, shape, WithinOf(gaps, all & ~block.favourites, WorstOf(best)), best);
}

std::uint64_t CapsulesOf(const Best& best) {
  std::uint64_t capsules = 0;
  for (const std::int32_t k : best.capsule)
    if (k >= 0) capsules |= std::uint64_t{1} << k;
  return capsules;
}

}  // namespace

void ContactMatcher::Slim(std::span<const PosedCapsule> capsules) {
  slim_.capsules.clear();
  for (const PosedCapsule& capsule : capsules) {
    SlimCapsule slim;
    slim.a = capsule.a_W.cast<float>();
    slim.core = (capsule.b_W - capsule.a_W).cast<float>();
    slim.core_sq = std::max(slim.core.squaredNorm(), kLeastSq_mm2);
    slim.radius = static_cast<float>(capsule.radius_a_mm);
    slim.taper = static_cast<float>(capsule.radius_b_mm - capsule.radius_a_mm);
    const Eigen::Vector3f b = slim.a + slim.core;
    const float widest = std::max(slim.radius, slim.radius + slim.taper);
    for (int axis = 0; axis < 3; ++axis) {
      slim_.low[axis][slim_.capsules.size()] = std::min(slim.a[axis], b[axis]) - widest;
      slim_.high[axis][slim_.capsules.size()] = std::max(slim.a[axis], b[axis]) + widest;
    }
    slim_.capsules.push_back(slim);
  }
}

void ContactMatcher::SetContacts(std::span<const Contact> contacts) {
  contacts_.assign(contacts.begin(), contacts.end());
  matches_.resize(contacts.size());
  distances_.resize(contacts.size());
  surface_W_.Set(contacts);
  SortByPlace();
  blocks_.resize((contacts.size() + Block::kContacts - 1) / Block::kContacts);
  for (std::size_t i = 0; i < blocks_.size(); ++i) FillBlock(i * Block::kContacts, blocks_[i]);
}

// Rows of cells, one above the other.
void ContactMatcher::SortByPlace() {
  MOCAP_CHECK(contacts_.size() < std::size_t{1} << kIndexBits);
  order_.clear();
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    const Contact& contact = contacts_[i];
    const Vector3 place = (contact.from_W + contact.to_W) / (2 * kCell_mm);
    const auto cell = [&](int axis, unsigned bits) {
      return static_cast<std::uint32_t>(std::lround(place[axis])) & ((1u << bits) - 1);
    };
    const bool is_long = (contact.to_W - contact.from_W).squaredNorm() > kLong_mm * kLong_mm;
    const std::uint32_t key =
        (is_long ? 1u : 0u) << 15 | cell(2, 5) << 10 | cell(1, 5) << 5 | cell(0, 5);
    order_.push_back(key << kIndexBits | static_cast<std::uint32_t>(i));
  }
  std::ranges::sort(order_);
  for (std::uint32_t& place : order_) place &= (1u << kIndexBits) - 1;
}

// Behind the last contact it is repeated.
void ContactMatcher::FillBlock(std::size_t first, Block& block) const {
  for (int i = 0; i < Block::kContacts; ++i) {
    const Contact& contact =
        contacts_[order_[std::min(first + static_cast<std::size_t>(i), order_.size() - 1)]];
    const Eigen::Vector3f from = contact.from_W.cast<float>();
    const Eigen::Vector3f to = contact.to_W.cast<float>();
    for (int axis = 0; axis < 3; ++axis) {
      block.from[axis][i] = from[axis];
      block.along[axis][i] = static_cast<float>(contact.to_W[axis] - contact.from_W[axis]);
      block.outward[axis][i] = static_cast<float>(contact.outward_W[axis]);
    }
    block.along_sq[i] =
        std::max(static_cast<float>((contact.to_W - contact.from_W).squaredNorm()), kLeastSq_mm2);
    block.per_along_sq[i] = 1 / block.along_sq[i];
    block.favourites = 0;
    block.low = i == 0 ? from.cwiseMin(to).eval() : block.low.cwiseMin(from).cwiseMin(to).eval();
    block.high = i == 0 ? from.cwiseMax(to).eval() : block.high.cwiseMax(from).cwiseMax(to).eval();
  }
}

template <typename Visit>
void ContactMatcher::ForEachBest(std::span<const PosedCapsule> capsules, double reach_mm,
                                 const Visit& visit) {
  MOCAP_CHECK(!capsules.empty() && capsules.size() <= kMostCapsules);
  Slim(capsules);
  Best best;
  for (std::size_t block = 0; block < blocks_.size(); ++block) {
    // What explains the neighbours is a first guess.
    if (blocks_[block].favourites == 0 && block > 0)
      blocks_[block].favourites = blocks_[block - 1].favourites;
    MatchBlock(blocks_[block], slim_, static_cast<float>(reach_mm), best);
    blocks_[block].favourites = CapsulesOf(best);
    const std::size_t first = block * Block::kContacts;
    const std::size_t count = std::min<std::size_t>(Block::kContacts, order_.size() - first);
    for (std::size_t i = 0; i < count; ++i) visit(order_[first + i], best, i);
  }
}

const std::vector<ContactMatch>& ContactMatcher::Match(std::span<const PosedCapsule> capsules,
                                                       double reach_mm) {
  pairs_.clear();
  ForEachBest(capsules, reach_mm, [&](std::uint32_t contact, const Best& best, std::size_t i) {
    ContactMatch& match = matches_[contact];
    match.capsule = best.capsule[i];
    if (match.capsule < 0) return;
    pairs_.push_back({&capsules[match.capsule], &contacts_[contact].from_W,
                      &contacts_[contact].to_W, &match.distance});
  });
  FindDistances(pairs_);
  return matches_;
}

const std::vector<float>& ContactMatcher::Distances(std::span<const PosedCapsule> capsules,
                                                    double reach_mm) {
  ForEachBest(capsules, reach_mm, [&](std::uint32_t contact, const Best& best, std::size_t i) {
    distances_[contact] = best.distance[i];
  });
  return distances_;
}

}  // namespace mocap
