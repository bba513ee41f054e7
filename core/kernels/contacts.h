// Which of a body's capsules are near contacts, in single precision.
#pragma once

#include <array>
#include <cstdint>

namespace mocap::kernels {

inline constexpr int kMostCapsules = 32;

/// A capsule.
struct SlimCapsule {
  std::array<float, 3> a, core, middle;  ///< One end, the way to the other one, and the middle.
  float core_sq, per_core_sq, radius, taper;
  float reach;  ///< Radius of a bounding sphere around its middle.
};

/// The corners of the capsules' bounding boxes.
struct CapsuleBoxes {
  alignas(32) std::array<std::array<float, kMostCapsules>, 3> low{}, high{};
};

/// Several contacts, in columns.
struct alignas(64) ContactBlock {
  static constexpr int kContacts = 8;
  using Column = std::array<float, kContacts>;

  std::array<Column, 3> from, along, outward;
  Column along_sq, per_along_sq;
  std::array<float, 3> low, high;  ///< The corners of a box around them.
  std::uint32_t favourites = 0;    ///< The capsules that were best for some contact, as bits.
};

/// The best matches so far of a block's contacts.
struct BestCapsules {
  alignas(32) std::array<float, ContactBlock::kContacts> mismatch, distance;
  alignas(32) std::array<std::int32_t, ContactBlock::kContacts> capsule;
};

/// A capsule to be compared with a block's contacts.
struct CapsuleTrial {
  std::int32_t block, capsule;
};

/// A point on the inside of the left leg is no evidence for the right leg. Perpendicular surfaces
/// count as this far apart.
inline constexpr float kSquare_mm = 40;
/// Share of the product of two squared lengths, below which segments count as parallel.
inline constexpr float kParallel = 1e-4f;
/// Larger than the rounding error of a distance between boxes.
inline constexpr float kBoxRounding_mm = 0.1f;

/// Compares capsules with contacts: their distance plus the angle between the surfaces. Keeps the
/// better ones in `bests`. Of equally good ones, the one with the lower index wins: parts that
/// share a joint are equally near to points beside it.
void TryCapsules(const CapsuleTrial* trials, int count, const ContactBlock* blocks,
                 const SlimCapsule* capsules, BestCapsules* bests);

/// Lists the capsules, favourites excepted, that may match contacts of blocks [begin, end) better
/// than the best so far: a mismatch is never less than the gap.
/// @param all     the capsules that exist, as bits.
/// @param trials  has space for all of them, and one more.
/// @return        the number of trials.
int ListNearCapsules(int begin, int end, const ContactBlock* blocks, const SlimCapsule* capsules,
                     const CapsuleBoxes& boxes, std::uint32_t all, const BestCapsules* bests,
                     CapsuleTrial* trials);

}  // namespace mocap::kernels
