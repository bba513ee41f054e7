#include "core/objective/contact_matcher.h"

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
// Share of all edges. If this many edges miss the hull and graze a part, its flesh was carved away.
constexpr double kShareThatTells = 1.0 / 60;
constexpr float kGrazes_mm = 40;
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

std::array<float, 3> ArrayOf(const Eigen::Vector3f& v) { return {v.x(), v.y(), v.z()}; }

std::uint32_t CapsulesOf(const kernels::BestCapsules& best) {
  std::uint32_t capsules = 0;
  for (const std::int32_t k : best.capsule)
    if (k >= 0) capsules |= std::uint32_t{1} << k;
  return capsules;
}

}  // namespace

void ContactMatcher::Slim(std::span<const PosedCapsule> capsules) {
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

void ContactMatcher::SetContacts(std::span<const Contact> contacts) {
  contacts_.assign(contacts.begin(), contacts.end());
  matches_.resize(contacts.size());
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
    for (int axis = 0; axis < 3; ++axis) {
      const auto [low, high] = std::minmax({from[axis], to[axis]});
      block.low[axis] = i == 0 ? low : std::min(block.low[axis], low);
      block.high[axis] = i == 0 ? high : std::max(block.high[axis], high);
    }
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
  kernels::TryCapsules(trials_.data(), count, blocks_.data(), slim_.capsules.data(), bests_.data());
  count = kernels::ListNearCapsules(begin, end, blocks_.data(), slim_.capsules.data(), slim_.boxes,
                                    slim_.all, bests_.data(), trials_.data());
  kernels::TryCapsules(trials_.data(), count, blocks_.data(), slim_.capsules.data(), bests_.data());
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
  ForEachBest([&](std::uint32_t contact, const kernels::BestCapsules& best, std::size_t i) {
    ContactMatch& match = matches_[contact];
    match.capsule = best.capsule[i];
    if (match.capsule < 0) return;
    pairs_.push_back({&capsules[match.capsule], &contacts_[contact].from_W,
                      &contacts_[contact].to_W, &match.distance});
  });
  FindDistances(pairs_);
  return matches_;
}

std::uint32_t ContactMatcher::CarvedAway() const {
  if (missing_.empty()) return 0;
  std::array<int, kMostCapsules> rays{};
  for (const std::size_t place : missing_) {
    const kernels::BestCapsules& best = bests_[place / Block::kContacts];
    const std::size_t i = place % Block::kContacts;
    if (best.capsule[i] >= 0 && best.distance[i] < kGrazes_mm) ++rays[best.capsule[i]];
  }
  std::uint32_t capsules = 0;
  for (int k = 0; k < kMostCapsules; ++k)
    if (rays[k] >= rays_that_tell_) capsules |= std::uint32_t{1} << k;
  return capsules;
}

}  // namespace mocap
