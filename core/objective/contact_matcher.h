// Matches all contacts of a frame with the parts of a posed body that explain them best.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/body/segment_distances.h"
#include "core/evidence/contact.h"
#include "core/kernels/contacts.h"

namespace mocap {

/// The part of a body that explains a contact best: it is near and faces the same way.
struct ContactMatch {
  int capsule = -1;  ///< -1: none within reach.
  PosedCapsule::SegmentDistance distance{};
};

/// Matches the same contacts with one posed body after another. The best capsule is found in single
/// precision, for a block of neighbouring contacts at a time, among the capsules in reach. Its
/// distance is computed in double precision.
class ContactMatcher {
 public:
  void SetContacts(std::span<const Contact> contacts);
  const std::vector<Contact>& contacts() const { return contacts_; }

  /// Finds for each contact the capsule with the least mismatch: its distance [mm] plus the angle
  /// between the surfaces, also expressed in millimetres.
  /// @param reach_mm  a capsule with this mismatch or more does not explain a contact.
  /// @return  one match per contact, valid until the next call.
  const std::vector<ContactMatch>& Match(std::span<const PosedCapsule> capsules, double reach_mm);

  /// Returns the capsules, as bits, that several rays graze which miss the hull: their flesh was
  /// carved away because a camera did not see it. Refers to the last match.
  std::uint32_t CarvedAway() const;

  static constexpr int kMostCapsules = kernels::kMostCapsules;

 private:
  // A posed body in single precision.
  struct SlimShape {
    std::vector<kernels::SlimCapsule> capsules;
    kernels::CapsuleBoxes boxes;
    std::uint32_t all;  // All of them, as bits.
  };
  void MatchAll(std::span<const PosedCapsule> capsules, double reach_mm);
  void MatchBlocks(int begin, int end, float reach_mm);
  template <typename Visit>
  void ForEachBest(const Visit& visit) const;
  void Slim(std::span<const PosedCapsule> capsules);
  void SortByPlace();
  void FillBlock(std::size_t first, kernels::ContactBlock& block) const;

  std::vector<Contact> contacts_;
  std::vector<std::uint32_t> order_;  ///< The contacts in the order of the blocks.
  std::vector<std::uint32_t> keys_;   ///< The contacts' sort keys.
  std::vector<std::uint32_t> order_before_;
  std::vector<kernels::ContactBlock> blocks_;
  std::vector<kernels::BestCapsules> bests_;  ///< One per block.
  std::vector<std::size_t> missing_;          ///< Positions in order_ of rays that miss the hull.
  double rays_that_tell_ = 0;                 ///< Number of rays that indicates carved-away flesh.
  std::vector<kernels::CapsuleTrial> trials_;
  bool has_favourites_ = false;
  SlimShape slim_;
  std::vector<CapsuleAndSegment> pairs_;
  std::vector<ContactMatch> matches_;
};

}  // namespace mocap
