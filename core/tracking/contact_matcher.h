// Which part of a posed body explains each contact of a frame best: all of them at once.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/tracking/contact.h"
#include "core/tracking/flesh_rules.h"
#include "core/tracking/segment_distances.h"

namespace mocap {

/// The part of a body that explains a contact best: the one that lies near and faces the same way.
struct ContactMatch {
  int capsule = -1;  ///< -1: none within reach.
  PosedCapsule::SegmentDistance distance{};
};

/// Matches the same contacts with one posed body after another. Which capsule is the best is found
/// in single precision, for a block of neighbouring contacts at a time, and among the capsules that
/// can reach it; how far the capsule is, in double.
class ContactMatcher {
 public:
  void SetContacts(std::span<const Contact> contacts);
  const std::vector<Contact>& contacts() const { return contacts_; }
  /// Where those contacts are that are no edges.
  const PlaceColumns& surface_W() const { return surface_W_; }

  /// Finds for each contact the capsule of the least mismatch: its distance [mm] and, as
  /// millimetres too, how far the surfaces face apart.
  /// @param reach_mm  mismatch from which on a capsule does not explain a contact.
  /// @return  one match a contact, valid until the next call.
  const std::vector<ContactMatch>& Match(std::span<const PosedCapsule> capsules, double reach_mm);

  /// How far each contact is from the surface of the capsule that Match would find [mm], as the
  /// search for it has it: in single precision, and without what a taper adds.
  /// @return  `reach_mm` where there is none; valid until the next call.
  const std::vector<float>& Distances(std::span<const PosedCapsule> capsules, double reach_mm);

  /// The capsules, as bits, that several rays graze which miss the hull: flesh is missing there
  /// because a camera did not see it. Of the last match.
  std::uint32_t CarvedAway() const;

  static constexpr int kMostCapsules = 32;
  /// A capsule in single precision.
  struct SlimCapsule {
    Eigen::Vector3f a, core, middle;
    float core_sq, per_core_sq, radius, taper;
    float reach;  ///< All of it lies this near to its middle.
  };
  /// A posed body in single precision.
  struct SlimShape {
    std::vector<SlimCapsule> capsules;
    /// The corners of boxes around them.
    alignas(32) std::array<std::array<float, kMostCapsules>, 3> low{}, high{};
    std::uint32_t all;  ///< Of them, as bits.
  };
  /// So many contacts, in columns.
  struct alignas(64) Block {
    static constexpr int kContacts = 8;
    using Column = std::array<float, kContacts>;

    std::array<Column, 3> from, along, outward;
    Column along_sq, per_along_sq;
    Eigen::Vector3f low, high;     ///< The corners of a box around them.
    std::uint32_t favourites = 0;  ///< The capsules that were the best of some, as bits.
  };
  /// The best matches of a block's contacts.
  struct Best {
    alignas(32) std::array<float, Block::kContacts> mismatch, distance;
    alignas(32) std::array<std::int32_t, Block::kContacts> capsule;
  };
  /// A capsule that is to be held against a block's contacts.
  struct Trial {
    std::int32_t block, capsule;
  };

 private:
  void MatchAll(std::span<const PosedCapsule> capsules, double reach_mm);
  void MatchBlocks(int begin, int end, float reach_mm);
  template <typename Visit>
  void ForEachBest(const Visit& visit) const;
  void Slim(std::span<const PosedCapsule> capsules);
  void SortByPlace();
  void FillBlock(std::size_t first, Block& block) const;

  std::vector<Contact> contacts_;
  std::vector<std::uint32_t> order_;  ///< The contacts in the order of the blocks.
  std::vector<std::uint32_t> keys_;   ///< The contacts' own, while they are sorted.
  std::vector<std::uint32_t> order_before_;
  std::vector<Block> blocks_;
  std::vector<Best> bests_;           ///< One a block.
  std::vector<std::size_t> missing_;  ///< Places in order_ of rays that miss the hull.
  double rays_that_tell_ = 0;         ///< That flesh was carved away.
  std::vector<Trial> trials_;
  bool has_favourites_ = false;
  SlimShape slim_;
  PlaceColumns surface_W_;
  std::vector<CapsuleAndSegment> pairs_;
  std::vector<ContactMatch> matches_;
  std::vector<float> distances_;
};

}  // namespace mocap
