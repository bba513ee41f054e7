#include "core/tracking/contact_matcher.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/errors.h"
#include "core/vectorized.h"

namespace mocap {
namespace {

using Block = ContactMatcher::Block;
using SlimCapsule = ContactMatcher::SlimCapsule;
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

inline float Clamped(float x) { return x < 0 ? 0 : x > 1 ? 1 : x; }

// Closest places of two segments (Ericson 2005, §5.1.9), without branches.
inline __attribute__((always_inline)) void TryCapsule(const Block& block,
                                                      const SlimCapsule& capsule, int index,
                                                      Best& best) {
  const float ax = capsule.a.x(), ay = capsule.a.y(), az = capsule.a.z();
  const float cx = capsule.core.x(), cy = capsule.core.y(), cz = capsule.core.z();
  const float core_sq = capsule.core_sq, radius = capsule.radius, taper = capsule.taper;
  const float per_core_sq = 1 / core_sq;
#pragma GCC ivdep
  for (int i = 0; i < Block::kContacts; ++i) {
    const float lx = block.along[0][i], ly = block.along[1][i], lz = block.along[2][i];
    const float bx = ax - block.from[0][i], by = ay - block.from[1][i], bz = az - block.from[2][i];
    const float along_sq = block.along_sq[i];
    const float dot = cx * lx + cy * ly + cz * lz;
    const float c = cx * bx + cy * by + cz * bz;
    const float f = lx * bx + ly * by + lz * bz;
    const float slant = core_sq * along_sq - dot * dot;
    const float least = kParallel * core_sq * along_sq;
    const float first = Clamped((dot * f - c * along_sq) / (slant > least ? slant : least));
    const float on_segment = Clamped((dot * first + f) * block.per_along_sq[i]);
    const float share = Clamped((dot * on_segment - c) * per_core_sq);
    const float x = on_segment * lx - bx - share * cx;
    const float y = on_segment * ly - by - share * cy;
    const float z = on_segment * lz - bz - share * cz;
    const float length = std::sqrt(x * x + y * y + z * z);
    const float apart = std::abs(length - radius - share * taper);
    const float facing =
        (block.outward[0][i] * x + block.outward[1][i] * y + block.outward[2][i] * z) /
        (length + 1);
    const float value = apart + kSquare_mm * (1 - facing);
    const float least_yet = best.mismatch[i];
    const std::int32_t best_yet = best.capsule[i];
    const float distance_yet = best.distance[i];
    // Parts that share a joint are as near to what lies beside it: whichever is tried first.
    const bool is_better = (value < least_yet) | ((value == least_yet) & (index < best_yet));
    best.capsule[i] = is_better ? index : best_yet;
    best.distance[i] = is_better ? apart : distance_yet;
    best.mismatch[i] = is_better ? value : least_yet;
  }
}

float GapBetween(const Block& block, const SlimCapsule& capsule) {
  return (capsule.low - block.high).cwiseMax(block.low - capsule.high).maxCoeff();
}

// A capsule's mismatch is no less than the gap to it: the sooner good ones are tried, the fewer
// are.
MOCAP_VECTORIZED
void MatchBlock(const Block& block, const SlimCapsule* capsules, int count, float reach,
                Best& best) {
  best.mismatch.fill(reach);
  best.distance.fill(reach);
  best.capsule.fill(-1);
  float worst = reach;
  const std::uint64_t all = ~std::uint64_t{0} >> (64 - count);
  for (const std::uint64_t some : {all & block.favourites, all & ~block.favourites}) {
    for (std::uint64_t left = some; left != 0; left &= left - 1) {
      const int k = std::countr_zero(left);
      if (GapBetween(block, capsules[k]) > worst + kRounding_mm) continue;
      TryCapsule(block, capsules[k], k, best);
      worst = 0;
      for (const float mismatch : best.mismatch) worst = worst < mismatch ? mismatch : worst;
    }
  }
}

std::uint64_t CapsulesOf(const Best& best) {
  std::uint64_t capsules = 0;
  for (const std::int32_t k : best.capsule)
    if (k >= 0) capsules |= std::uint64_t{1} << k;
  return capsules;
}

}  // namespace

ContactMatcher::SlimCapsule::SlimCapsule(const PosedCapsule& capsule)
    : a(capsule.a_W.cast<float>()),
      core((capsule.b_W - capsule.a_W).cast<float>()),
      core_sq(std::max(core.squaredNorm(), kLeastSq_mm2)),
      radius(static_cast<float>(capsule.radius_a_mm)),
      taper(static_cast<float>(capsule.radius_b_mm - capsule.radius_a_mm)) {
  const Eigen::Vector3f b = a + core;
  const auto widest = Eigen::Vector3f::Constant(std::max(radius, radius + taper));
  low = a.cwiseMin(b) - widest;
  high = a.cwiseMax(b) + widest;
}

void ContactMatcher::SetContacts(std::span<const Contact> contacts) {
  contacts_.assign(contacts.begin(), contacts.end());
  matches_.resize(contacts.size());
  distances_.resize(contacts.size());
  surface_W_.clear();
  for (const Contact& contact : contacts) {
    if (!contact.is_edge) surface_W_.push_back(contact.from_W);
  }
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
  MOCAP_CHECK(!capsules.empty() && capsules.size() <= 64);
  slim_.clear();
  for (const PosedCapsule& capsule : capsules) slim_.emplace_back(capsule);
  Best best;
  for (std::size_t block = 0; block < blocks_.size(); ++block) {
    // What explains the neighbours is a first guess.
    if (blocks_[block].favourites == 0 && block > 0)
      blocks_[block].favourites = blocks_[block - 1].favourites;
    MatchBlock(blocks_[block], slim_.data(), static_cast<int>(slim_.size()),
               static_cast<float>(reach_mm), best);
    blocks_[block].favourites = CapsulesOf(best);
    const std::size_t first = block * Block::kContacts;
    const std::size_t count = std::min<std::size_t>(Block::kContacts, order_.size() - first);
    for (std::size_t i = 0; i < count; ++i) visit(order_[first + i], best, i);
  }
}

const std::vector<ContactMatch>& ContactMatcher::Match(std::span<const PosedCapsule> capsules,
                                                       double reach_mm) {
  ForEachBest(capsules, reach_mm, [&](std::uint32_t contact, const Best& best, std::size_t i) {
    ContactMatch& match = matches_[contact];
    match.capsule = best.capsule[i];
    if (match.capsule < 0) return;
    match.distance =
        capsules[match.capsule].DistanceTo(contacts_[contact].from_W, contacts_[contact].to_W);
  });
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
