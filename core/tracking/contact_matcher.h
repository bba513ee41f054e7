// Which part of a posed body explains each contact of a frame best: all of them at once.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "core/tracking/contact.h"

namespace mocap {

/// The part of a body that explains a contact best: the one that lies near and faces the same way.
struct ContactMatch {
  int capsule = -1;  ///< -1: none within reach.
  PosedCapsule::SegmentDistance distance{};

  /// How far the contact is from the surface, inside or outside of it [mm].
  double DistanceOr(double without_match_mm) const {
    return capsule < 0 ? without_match_mm : std::abs(distance.outside_mm);
  }
};

/// Matches the same contacts with one posed body after another. Which capsule is the best is found
/// in single precision, in loops over all contacts; how far it is, in double.
class ContactMatcher {
 public:
  void SetContacts(std::span<const Contact> contacts);
  const std::vector<Contact>& contacts() const { return contacts_; }

  /// Finds for each contact the capsule of the least mismatch: its distance [mm] and, as
  /// millimetres too, how far the surfaces face apart.
  /// @param reach_mm  mismatch from which on a capsule does not explain a contact.
  /// @return  one match a contact, valid until the next call.
  const std::vector<ContactMatch>& Match(std::span<const PosedCapsule> capsules, double reach_mm);

 private:
  using Column = std::vector<float>;

  std::vector<Contact> contacts_;
  std::array<Column, 3> from_;
  std::array<Column, 3> along_;
  std::array<Column, 3> outward_;
  Column along_sq_;
  Column mismatch_;
  std::vector<std::int32_t> best_;
  std::vector<ContactMatch> matches_;
};

}  // namespace mocap
