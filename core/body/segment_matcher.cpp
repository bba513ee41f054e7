#include "core/body/segment_matcher.h"

#include <algorithm>
#include <bit>
#include <numeric>
#include <utility>

#include "core/errors.h"

namespace mocap {
namespace {

using Block = kernels::ContactBlock;
using kernels::SlimCapsule;

// Lower limit for squared lengths, to avoid division by zero.
constexpr float kLeastSq_mm2 = 1e-3f;
// Segments are sorted by cells of this size. Longer ones come separately, because their boxes are
// large.
constexpr double kCell_mm = 128;
constexpr double kLong_mm = 400;
constexpr int kCellBits = 5;
constexpr int kDigitBits = 9;
constexpr int kKeyBits = 2 * kDigitBits;
static_assert(kKeyBits >= 2 + 3 * kCellBits);
// Number of blocks with the same initial guess.
constexpr int kFirstTogether = 8;

// Sorts by rows of cells, one above the other; points come first.
std::uint32_t KeyOf(const OrientedSegment& segment) {
  // Conversion rounds towards zero.
  constexpr double kAhead = 1 << 10;
  const Vector3 place = ((segment.from_W + segment.to_W) / (2 * kCell_mm)).array() + kAhead;
  const double length_sq = (segment.to_W - segment.from_W).squaredNorm();
  std::uint32_t key = length_sq == 0 ? 0 : 1 + (length_sq > kLong_mm * kLong_mm);
  for (int axis = 2; axis >= 0; --axis) {
    const auto cell = static_cast<std::uint32_t>(static_cast<int>(place[axis]));
    key = key << kCellBits | (cell & ((1u << kCellBits) - 1));
  }
  return key;
}

std::array<float, 3> ArrayOf(const Eigen::Vector3f& v) { return {v.x(), v.y(), v.z()}; }

std::uint32_t CapsulesOf(const kernels::BestCapsules& best) {
  std::uint32_t capsules = 0;
  for (const std::int32_t k : best.capsule)
    if (k >= 0) capsules |= std::uint32_t{1} << k;
  return capsules;
}

}  // namespace

void SegmentMatcher::Slim(std::span<const PosedCapsule> capsules) {
  slim_.capsules.clear();
  for (const PosedCapsule& capsule : capsules) {
    const Eigen::Vector3f a = capsule.a_W.cast<float>();
    const Eigen::Vector3f core = (capsule.b_W - capsule.a_W).cast<float>();
    const Eigen::Vector3f b = a + core;
    SlimCapsule slim;
    slim.a = ArrayOf(a);
    slim.core = ArrayOf(core);
    slim.middle = ArrayOf(capsule.middle_W.cast<float>());
    slim.reach = static_cast<float>(capsule.reach_mm);
    slim.core_sq = std::max(core.squaredNorm(), kLeastSq_mm2);
    slim.per_core_sq = 1 / slim.core_sq;
    slim.radius = static_cast<float>(capsule.radius_a_mm);
    slim.taper = static_cast<float>(capsule.radius_b_mm - capsule.radius_a_mm);
    const float widest = std::max(slim.radius, slim.radius + slim.taper);
    for (int axis = 0; axis < 3; ++axis) {
      slim_.boxes.low[axis][slim_.capsules.size()] = std::min(a[axis], b[axis]) - widest;
      slim_.boxes.high[axis][slim_.capsules.size()] = std::max(a[axis], b[axis]) + widest;
    }
    slim_.capsules.push_back(slim);
  }
  slim_.all = ~std::uint32_t{0} >> (kMostCapsules - capsules.size());
}

void SegmentMatcher::Prepare() {
  matches_.resize(segments_.size());
  SortByPlace();
  blocks_.resize((segments_.size() + Block::kContacts - 1) / Block::kContacts);
  for (std::size_t i = 0; i < blocks_.size(); ++i) FillBlock(i * Block::kContacts, blocks_[i]);
  bests_.resize(blocks_.size());
  trials_.resize(blocks_.size() * kMostCapsules + 1);
  has_favourites_ = false;
}

// Radix sort, lowest digit first.
void SegmentMatcher::SortByPlace() {
  keys_.clear();
  for (const OrientedSegment& segment : segments_) keys_.push_back(KeyOf(segment));
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

// The last segment is repeated to fill the block.
void SegmentMatcher::FillBlock(std::size_t first, Block& block) const {
  for (int i = 0; i < Block::kContacts; ++i) {
    const OrientedSegment& segment =
        segments_[order_[std::min(first + static_cast<std::size_t>(i), order_.size() - 1)]];
    const Eigen::Vector3f from = segment.from_W.cast<float>();
    const Eigen::Vector3f to = segment.to_W.cast<float>();
    for (int axis = 0; axis < 3; ++axis) {
      block.from[axis][i] = from[axis];
      block.along[axis][i] = static_cast<float>(segment.to_W[axis] - segment.from_W[axis]);
      block.outward[axis][i] = static_cast<float>(segment.outward_W[axis]);
    }
    block.along_sq[i] =
        std::max(static_cast<float>((segment.to_W - segment.from_W).squaredNorm()), kLeastSq_mm2);
    block.per_along_sq[i] = 1 / block.along_sq[i];
    block.favourites = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const auto [low, high] = std::minmax({from[axis], to[axis]});
      block.low[axis] = i == 0 ? low : std::min(block.low[axis], low);
      block.high[axis] = i == 0 ? high : std::max(block.high[axis], high);
    }
  }
}

// Lists the trials for many blocks first: a decision after each trial would wait for its result.
void SegmentMatcher::MatchBlocks(int begin, int end, float reach_mm) {
  int count = 0;
  for (int b = begin; b < end; ++b) {
    bests_[b].mismatch.fill(reach_mm);
    bests_[b].distance.fill(reach_mm);
    bests_[b].capsule.fill(-1);
    for (std::uint32_t some = slim_.all & blocks_[b].favourites; some != 0; some &= some - 1)
      trials_[count++] = {b, std::countr_zero(some)};
  }
  kernels::TryCapsules(trials_.data(), count, blocks_.data(), slim_.capsules.data(), bests_.data());
  count = kernels::ListNearCapsules(begin, end, blocks_.data(), slim_.capsules.data(), slim_.boxes,
                                    slim_.all, bests_.data(), trials_.data());
  kernels::TryCapsules(trials_.data(), count, blocks_.data(), slim_.capsules.data(), bests_.data());
  for (int b = begin; b < end; ++b) blocks_[b].favourites = CapsulesOf(bests_[b]);
}

void SegmentMatcher::MatchAll(std::span<const PosedCapsule> capsules, double reach_mm) {
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

const std::vector<SegmentMatch>& SegmentMatcher::Match(std::span<const PosedCapsule> capsules,
                                                       double reach_mm) {
  MatchAll(capsules, reach_mm);
  pairs_.clear();
  for (std::size_t i = 0; i < order_.size(); ++i) {
    const OrientedSegment& segment = segments_[order_[i]];
    SegmentMatch& match = matches_[order_[i]];
    match.capsule = bests_[i / Block::kContacts].capsule[i % Block::kContacts];
    if (match.capsule < 0) continue;
    pairs_.push_back({&capsules[match.capsule], &segment.from_W, &segment.to_W, &match.distance});
  }
  FindDistances(pairs_);
  return matches_;
}

}  // namespace mocap
