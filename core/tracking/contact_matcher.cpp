#include "core/tracking/contact_matcher.h"

#include <algorithm>
#include <bit>
#include <numeric>
#include <utility>

#include "core/errors.h"
#include "core/lanes.h"

namespace mocap {
namespace {

using Block = ContactMatcher::Block;
using SlimCapsule = ContactMatcher::SlimCapsule;
using SlimShape = ContactMatcher::SlimShape;
using Best = ContactMatcher::Best;
using Trial = ContactMatcher::Trial;

// A point on the inside of the left leg is no evidence for the right leg. Perpendicular surfaces
// count as this far apart.
constexpr float kSquare_mm = 40;
// Lower limit for squared lengths, to avoid division by zero.
constexpr float kLeastSq_mm2 = 1e-3f;
constexpr float kParallel = 1e-4f;
// Share of all edges. If this many edges miss the hull and graze a part, its flesh was carved away.
constexpr double kShareThatTells = 1.0 / 60;
constexpr float kGrazes_mm = 40;
// Larger than the rounding error of a distance between boxes.
constexpr float kRounding_mm = 0.1f;
// Contacts are sorted by cells of this size. Longer edges come separately, because their boxes are
// large.
constexpr double kCell_mm = 128;
constexpr double kLong_mm = 400;
constexpr int kCellBits = 5;
constexpr int kDigitBits = 9;
constexpr int kKeyBits = 2 * kDigitBits;
static_assert(kKeyBits >= 2 + 3 * kCellBits);
// Number of blocks with the same initial guess.
constexpr int kFirstTogether = 8;

// The best matches so far for a block's contacts.
struct BestLanes {
  Floats mismatch, distance;
  Ints capsule;
};

MOCAP_INLINE void LoadColumns(const std::array<Block::Column, 3>& columns, Floats& x, Floats& y,
                              Floats& z) {
  LoadLanes(columns[0].data(), x), LoadLanes(columns[1].data(), y), LoadLanes(columns[2].data(), z);
}

// Closest points of two segments (Ericson 2005, §5.1.9), without branches.
MOCAP_INLINE void TryCapsule(const Block& block, const SlimCapsule& capsule, int index,
                             BestLanes& best) {
  const float cx = capsule.core.x(), cy = capsule.core.y(), cz = capsule.core.z();
  const float core_sq = capsule.core_sq, per_core_sq = capsule.per_core_sq;
  Floats lx, ly, lz, bx, by, bz, along_sq, per_along_sq;
  LoadColumns(block.along, lx, ly, lz), LoadColumns(block.from, bx, by, bz);
  LoadLanes(block.along_sq.data(), along_sq), LoadLanes(block.per_along_sq.data(), per_along_sq);
  bx = capsule.a.x() - bx, by = capsule.a.y() - by, bz = capsule.a.z() - bz;
  const Floats dot = cx * lx + cy * ly + cz * lz;
  const Floats c = cx * bx + cy * by + cz * bz;
  const Floats f = lx * bx + ly * by + lz * bz;
  const Floats slant = core_sq * along_sq - dot * dot;
  const Floats least = kParallel * core_sq * along_sq;
  Floats first = (dot * f - c * along_sq) / (slant > least ? slant : least);
  first = Clamped(first, 0.0f, 1.0f);
  Floats on_segment = (dot * first + f) * per_along_sq;
  on_segment = Clamped(on_segment, 0.0f, 1.0f);
  Floats share = (dot * on_segment - c) * per_core_sq;
  share = Clamped(share, 0.0f, 1.0f);
  const Floats x = on_segment * lx - bx - share * cx;
  const Floats y = on_segment * ly - by - share * cy;
  const Floats z = on_segment * lz - bz - share * cz;
  Floats length = x * x + y * y + z * z;
  TakeRoots(length);
  const Floats outside = length - capsule.radius - share * capsule.taper;
  const Floats apart = outside > 0 ? outside : -outside;
  Floats ox, oy, oz;
  LoadColumns(block.outward, ox, oy, oz);
  const Floats facing = (ox * x + oy * y + oz * z) / (length + 1);
  const Floats value = apart + kSquare_mm * (1 - facing);
  // Parts that share a joint are equally near to points beside it: the one with the lower index
  // wins.
  const Ints is_better =
      (value < best.mismatch) | ((value == best.mismatch) & (index < best.capsule));
  best.capsule = is_better ? Ints{} + index : best.capsule;
  best.distance = is_better ? apart : best.distance;
  best.mismatch = is_better ? value : best.mismatch;
}

MOCAP_VECTORIZED
void TryAll(const Trial* trials, int count, const Block* blocks, const SlimCapsule* capsules,
            Best* bests) {
  for (int i = 0; i < count; ++i) {
    const Trial& trial = trials[i];
    Best& best = bests[trial.block];
    BestLanes lanes;
    LoadLanes(best.mismatch.data(), lanes.mismatch);
    LoadLanes(best.distance.data(), lanes.distance);
    LoadLanes(best.capsule.data(), lanes.capsule);
    TryCapsule(blocks[trial.block], capsules[trial.capsule], trial.capsule, lanes);
    StoreLanes(lanes.mismatch, best.mismatch.data());
    StoreLanes(lanes.distance, best.distance.data());
    StoreLanes(lanes.capsule, best.capsule.data());
  }
}

// In a tree, so that no comparison waits for the previous one.
MOCAP_INLINE float WorstOf(const std::array<float, Block::kContacts>& a) {
  return std::max(std::max(std::max(a[0], a[1]), std::max(a[2], a[3])),
                  std::max(std::max(a[4], a[5]), std::max(a[6], a[7])));
}

MOCAP_INLINE std::uint32_t UnionOf(const Ints& lanes) {
  std::array<std::uint32_t, kFloats> a;
  StoreLanes(lanes, a.data());
  return ((a[0] | a[1]) | (a[2] | a[3])) | ((a[4] | a[5]) | (a[6] | a[7]));
}

MOCAP_INLINE bool HasAny(const Ints& lanes) {
  std::array<std::uint64_t, kFloats / 2> a;
  StoreLanes(lanes, a.data());
  return ((a[0] | a[1]) | (a[2] | a[3])) != 0;
}

// The capsules whose box is within reach of the block's.
MOCAP_INLINE std::uint32_t CapsulesWithin(const Block& block, const SlimShape& shape,
                                          float reach_mm) {
  Ints bits = {1 << 0, 1 << 1, 1 << 2, 1 << 3, 1 << 4, 1 << 5, 1 << 6, 1 << 7};
  Ints within{};
  for (int k = 0; k < ContactMatcher::kMostCapsules; k += kFloats, bits <<= kFloats) {
    Ints is_within = Ints{} - 1;
    for (int axis = 0; axis < 3; ++axis) {
      Floats low, high;
      LoadLanes(&shape.low[axis][k], low), LoadLanes(&shape.high[axis][k], high);
      is_within &= (low <= block.high[axis] + reach_mm) & (high >= block.low[axis] - reach_mm);
    }
    within |= is_within & bits;
  }
  return UnionOf(within);
}

// Whether the ball around a capsule is near enough for a better match of one of a block's contacts.
MOCAP_INLINE bool IsInReach(const Block& block, const SlimCapsule& capsule, const Best& best) {
  Floats lx, ly, lz, x, y, z, per_along_sq, mismatch;
  LoadColumns(block.along, lx, ly, lz), LoadColumns(block.from, x, y, z);
  LoadLanes(block.per_along_sq.data(), per_along_sq);
  LoadLanes(best.mismatch.data(), mismatch);
  x = capsule.middle.x() - x, y = capsule.middle.y() - y, z = capsule.middle.z() - z;
  Floats on_segment = (x * lx + y * ly + z * lz) * per_along_sq;
  on_segment = Clamped(on_segment, 0.0f, 1.0f);
  x -= on_segment * lx, y -= on_segment * ly, z -= on_segment * lz;
  const Floats reach = mismatch + (capsule.reach + kRounding_mm);
  const Ints is_within = x * x + y * y + z * z <= reach * reach;
  return HasAny(is_within);
}

// Lists the capsules that may match a block's contacts better than its favourites: a mismatch is
// never less than the gap. Returns their number.
MOCAP_VECTORIZED
int ListOthers(int begin, int end, const Block* blocks, const SlimShape& shape, const Best* bests,
               Trial* trials) {
  int count = 0;
  for (int b = begin; b < end; ++b) {
    std::uint32_t some =
        CapsulesWithin(blocks[b], shape, WorstOf(bests[b].mismatch) + kRounding_mm);
    for (some &= shape.all & ~blocks[b].favourites; some != 0; some &= some - 1) {
      trials[count] = {b, std::countr_zero(some)};
      count += IsInReach(blocks[b], shape.capsules[trials[count].capsule], bests[b]);
    }
  }
  return count;
}

// Sorts by rows of cells, one above the other; edges come after the other contacts.
std::uint32_t KeyOf(const Contact& contact) {
  // Conversion rounds towards zero.
  constexpr double kAhead = 1 << 10;
  const Vector3 place = ((contact.from_W + contact.to_W) / (2 * kCell_mm)).array() + kAhead;
  const bool is_long = (contact.to_W - contact.from_W).squaredNorm() > kLong_mm * kLong_mm;
  std::uint32_t key = contact.is_edge ? 1 + is_long : 0;
  for (int axis = 2; axis >= 0; --axis) {
    const auto cell = static_cast<std::uint32_t>(static_cast<int>(place[axis]));
    key = key << kCellBits | (cell & ((1u << kCellBits) - 1));
  }
  return key;
}

std::uint32_t CapsulesOf(const Best& best) {
  std::uint32_t capsules = 0;
  for (const std::int32_t k : best.capsule)
    if (k >= 0) capsules |= std::uint32_t{1} << k;
  return capsules;
}

}  // namespace

void ContactMatcher::Slim(std::span<const PosedCapsule> capsules) {
  slim_.capsules.clear();
  for (const PosedCapsule& capsule : capsules) {
    SlimCapsule slim;
    slim.a = capsule.a_W.cast<float>();
    slim.core = (capsule.b_W - capsule.a_W).cast<float>();
    slim.middle = capsule.middle_W.cast<float>();
    slim.reach = static_cast<float>(capsule.reach_mm);
    slim.core_sq = std::max(slim.core.squaredNorm(), kLeastSq_mm2);
    slim.per_core_sq = 1 / slim.core_sq;
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
  slim_.all = ~std::uint32_t{0} >> (kMostCapsules - capsules.size());
}

void ContactMatcher::SetContacts(std::span<const Contact> contacts) {
  contacts_.assign(contacts.begin(), contacts.end());
  matches_.resize(contacts.size());
  distances_.resize(contacts.size());
  surface_W_.Set(contacts);
  SortByPlace();
  blocks_.resize((contacts.size() + Block::kContacts - 1) / Block::kContacts);
  for (std::size_t i = 0; i < blocks_.size(); ++i) FillBlock(i * Block::kContacts, blocks_[i]);
  bests_.resize(blocks_.size());
  trials_.resize(blocks_.size() * kMostCapsules + 1);
  missing_.clear();
  for (std::size_t place = 0; place < order_.size(); ++place)
    if (contacts_[order_[place]].misses_hull) missing_.push_back(place);
  const auto edges = std::ranges::count_if(contacts_, &Contact::is_edge);
  rays_that_tell_ = std::max(2.0, kShareThatTells * static_cast<double>(edges));
  has_favourites_ = false;
}

// Radix sort, lowest digit first.
void ContactMatcher::SortByPlace() {
  keys_.clear();
  for (const Contact& contact : contacts_) keys_.push_back(KeyOf(contact));
  order_.resize(keys_.size());
  order_before_.resize(keys_.size());
  std::iota(order_.begin(), order_.end(), 0);
  for (int shift = 0; shift < kKeyBits; shift += kDigitBits) {
    const auto digit = [&](std::uint32_t i) {
      return keys_[i] >> shift & ((1u << kDigitBits) - 1);
    };
    order_.swap(order_before_);
    std::array<std::uint32_t, (1 << kDigitBits) + 1> begins{};
    for (const std::uint32_t i : order_before_) ++begins[digit(i) + 1];
    std::partial_sum(begins.begin(), begins.end(), begins.begin());
    for (const std::uint32_t i : order_before_) order_[begins[digit(i)]++] = i;
  }
}

// The last contact is repeated to fill the block.
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

// Lists the trials for many blocks first: a decision after each trial would wait for its result.
void ContactMatcher::MatchBlocks(int begin, int end, float reach_mm) {
  int count = 0;
  for (int b = begin; b < end; ++b) {
    bests_[b].mismatch.fill(reach_mm);
    bests_[b].distance.fill(reach_mm);
    bests_[b].capsule.fill(-1);
    for (std::uint32_t some = slim_.all & blocks_[b].favourites; some != 0; some &= some - 1)
      trials_[count++] = {b, std::countr_zero(some)};
  }
  TryAll(trials_.data(), count, blocks_.data(), slim_.capsules.data(), bests_.data());
  count = ListOthers(begin, end, blocks_.data(), slim_, bests_.data(), trials_.data());
  TryAll(trials_.data(), count, blocks_.data(), slim_.capsules.data(), bests_.data());
  for (int b = begin; b < end; ++b) blocks_[b].favourites = CapsulesOf(bests_[b]);
}

void ContactMatcher::MatchAll(std::span<const PosedCapsule> capsules, double reach_mm) {
  MOCAP_CHECK(!capsules.empty() && capsules.size() <= kMostCapsules);
  Slim(capsules);
  const int count = static_cast<int>(blocks_.size());
  const int together = std::exchange(has_favourites_, true) ? count : kFirstTogether;
  for (int begin = 0; begin < count; begin += together) {
    const int end = std::min(begin + together, count);
    // The capsules that explain the neighbours are the initial guess.
    for (int b = begin; b < end && begin > 0; ++b)
      if (blocks_[b].favourites == 0) blocks_[b].favourites = blocks_[begin - 1].favourites;
    MatchBlocks(begin, end, static_cast<float>(reach_mm));
  }
}

template <typename Visit>
void ContactMatcher::ForEachBest(const Visit& visit) const {
  for (std::size_t i = 0; i < order_.size(); ++i)
    visit(order_[i], bests_[i / Block::kContacts], i % Block::kContacts);
}

const std::vector<ContactMatch>& ContactMatcher::Match(std::span<const PosedCapsule> capsules,
                                                       double reach_mm) {
  MatchAll(capsules, reach_mm);
  pairs_.clear();
  ForEachBest([&](std::uint32_t contact, const Best& best, std::size_t i) {
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
  MatchAll(capsules, reach_mm);
  ForEachBest([&](std::uint32_t contact, const Best& best, std::size_t i) {
    distances_[contact] = best.distance[i];
  });
  return distances_;
}

std::uint32_t ContactMatcher::CarvedAway() const {
  if (missing_.empty()) return 0;
  std::array<int, kMostCapsules> rays{};
  for (const std::size_t place : missing_) {
    const Best& best = bests_[place / Block::kContacts];
    const std::size_t i = place % Block::kContacts;
    if (best.capsule[i] >= 0 && best.distance[i] < kGrazes_mm) ++rays[best.capsule[i]];
  }
  std::uint32_t capsules = 0;
  for (int k = 0; k < kMostCapsules; ++k)
    if (rays[k] >= rays_that_tell_) capsules |= std::uint32_t{1} << k;
  return capsules;
}

}  // namespace mocap
