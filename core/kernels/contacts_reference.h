// What contacts.h means, contact by contact.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/kernels/contacts.h"

namespace mocap::kernels::reference {

inline float Dot(const std::array<float, 3>& a, const std::array<float, 3>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline std::array<float, 3> At(const std::array<ContactBlock::Column, 3>& columns, int i) {
  return {columns[0][i], columns[1][i], columns[2][i]};
}

/// A capsule's distance from a contact, and that plus the angle between the surfaces.
struct Mismatch {
  float distance, value;
};
/// Closest points of two segments (Ericson 2005, §5.1.9).
inline Mismatch MismatchOf(const ContactBlock& block, int i, const SlimCapsule& capsule) {
  const std::array<float, 3> along = At(block.along, i), from = At(block.from, i);
  const std::array<float, 3>& core = capsule.core;
  const std::array<float, 3> between = {capsule.a[0] - from[0], capsule.a[1] - from[1],
                                        capsule.a[2] - from[2]};
  const float dot = Dot(core, along), c = Dot(core, between), f = Dot(along, between);
  const float slant = capsule.core_sq * block.along_sq[i] - dot * dot;
  const float least = kParallel * capsule.core_sq * block.along_sq[i];
  const float first =
      std::clamp((dot * f - c * block.along_sq[i]) / std::max(slant, least), 0.0f, 1.0f);
  const float on_segment = std::clamp((dot * first + f) * block.per_along_sq[i], 0.0f, 1.0f);
  const float share = std::clamp((dot * on_segment - c) * capsule.per_core_sq, 0.0f, 1.0f);
  std::array<float, 3> way;
  for (int axis = 0; axis < 3; ++axis)
    way[axis] = on_segment * along[axis] - between[axis] - share * core[axis];
  const float length = std::sqrt(Dot(way, way));
  const float apart = std::abs(length - capsule.radius - share * capsule.taper);
  const float facing = Dot(At(block.outward, i), way) / (length + 1);
  return {apart, apart + kSquare_mm * (1 - facing)};
}

inline void TryCapsules(const CapsuleTrial* trials, int count, const ContactBlock* blocks,
                        const SlimCapsule* capsules, BestCapsules* bests) {
  for (int trial = 0; trial < count; ++trial) {
    const auto [block, capsule] = trials[trial];
    BestCapsules& best = bests[block];
    for (int i = 0; i < ContactBlock::kContacts; ++i) {
      const auto [distance, value] = MismatchOf(blocks[block], i, capsules[capsule]);
      if (value > best.mismatch[i] || (value == best.mismatch[i] && capsule >= best.capsule[i]))
        continue;
      best.mismatch[i] = value, best.distance[i] = distance, best.capsule[i] = capsule;
    }
  }
}

/// Whether a capsule's box and bounding ball are near enough to some contact of a block.
inline bool IsNear(const ContactBlock& block, int capsule, const SlimCapsule& slim,
                   const CapsuleBoxes& boxes, const BestCapsules& best) {
  const float reach = *std::ranges::max_element(best.mismatch) + kBoxRounding_mm;
  for (int axis = 0; axis < 3; ++axis) {
    if (boxes.low[axis][capsule] > block.high[axis] + reach ||
        boxes.high[axis][capsule] < block.low[axis] - reach)
      return false;
  }
  for (int i = 0; i < ContactBlock::kContacts; ++i) {
    const std::array<float, 3> along = At(block.along, i), from = At(block.from, i);
    std::array<float, 3> way;
    for (int axis = 0; axis < 3; ++axis) way[axis] = slim.middle[axis] - from[axis];
    const float share = std::clamp(Dot(way, along) * block.per_along_sq[i], 0.0f, 1.0f);
    for (int axis = 0; axis < 3; ++axis) way[axis] -= share * along[axis];
    const float most = best.mismatch[i] + (slim.reach + kBoxRounding_mm);
    if (Dot(way, way) <= most * most) return true;
  }
  return false;
}

inline int ListNearCapsules(int begin, int end, const ContactBlock* blocks,
                            const SlimCapsule* capsules, const CapsuleBoxes& boxes,
                            std::uint32_t all, const BestCapsules* bests, CapsuleTrial* trials) {
  int count = 0;
  for (int b = begin; b < end; ++b) {
    for (int capsule = 0; capsule < kMostCapsules; ++capsule) {
      if (((all & ~blocks[b].favourites) >> capsule & 1) != 0 &&
          IsNear(blocks[b], capsule, capsules[capsule], boxes, bests[b]))
        trials[count++] = {b, capsule};
    }
  }
  return count;
}

}  // namespace mocap::kernels::reference
