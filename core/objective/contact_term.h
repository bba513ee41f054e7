// Evidence that the body's surface touches: rays that graze the person, and the hull's surface.
//
// Outlines have the largest weight: a visual hull is larger than the person and has ghost limbs,
// but the outlines' rays graze only the person (Cheung, Baker and Kanade 2003; Gall et al. 2009).
#pragma once

#include <utility>
#include <vector>

#include "core/body/posed_body.h"
#include "core/body/segment_matcher.h"
#include "core/objective/carried_things.h"
#include "core/objective/noise.h"

namespace mocap {

/// How well a body explains the contacts.
struct ContactNats {
  double rays = 0, surface = 0;  ///< [nats]
  double things = 0;             ///< What things explain better, and their own cost; never above 0.
  Things shown;                  ///< The things that are worth their cost.
  double unexplained_share = 0;  ///< Of the rays: no part of the body is near.
  double surface_mm = 0;         ///< Mean distance of the voxels' surface.
  /// Mean cost of the rays that touch the hull, as a share of what one costs that no part explains;
  /// that of voxels if there are no rays.
  double misfit = 0;
};

/// -log p of the contacts: the residual of each is its distance from the part that explains it
/// best, or kReach_mm if none does. Reuses its memory.
class ContactTerm {
 public:
  /// Looks at so many of the evidence's voxels and rays. Poses may be off by `pose_std_mm`.
  void SetEvidence(const Evidence& evidence, int voxels, int rays, double pose_std_mm);

  /// Takes over the contacts that the rest of a body does not explain: from now on only some of its
  /// capsules move, and others are absent.
  void TakeOpen(ContactTerm& whole, const PosedBody& posed, CapsuleSet moving, CapsuleSet absent,
                const Things& things);

  /// @param things  what the body may wear or carry.
  ContactNats At(const PosedBody& posed, const Things& things);
  void Linearize(const PosedBody& posed, const Things& things, Linearisation& sums);

  /// One contact compared with the body.
  struct Residual {
    bool is_ray;
    int capsule;       ///< Index into the body's shape(); -1: explained by no part.
    double share;      ///< Position along its core.
    Vector3 p_W;       ///< Target point of the capsule.
    Vector3 normal_W;  ///< Out of the surface; where the capsule tapers it leans and is longer.
    double outside_mm;
  };
  /// Visits all contacts.
  template <typename Visit>
  void ForEach(const PosedBody& posed, const Visit& visit);

  const ResidualNoise& NoiseOf(bool is_ray) const { return is_ray ? of_rays_ : of_surface_; }
  /// Capsules that several rays graze which miss the hull: their flesh was carved away because a
  /// camera did not see it. Refers to the last pose.
  CapsuleSet CarvedAway() const;
  /// Those of the evidence that are looked at.
  const std::vector<Contact>& contacts() const { return contacts_; }

 private:
  // To be called when the contacts have changed.
  void Prepare();
  // How much less a contact costs if it is a thing's [nats].
  double SavedBy(const Residual& residual) const;
  // Matches the contacts with the capsules that move.
  const std::vector<SegmentMatch>& Match(const PosedBody& posed);

  std::vector<Contact> contacts_;
  SegmentMatcher matcher_;
  ResidualNoise of_rays_, of_surface_;
  int rays_ = 0, voxels_ = 0;
  std::vector<int> moving_;      ///< Capsules; empty: all.
  std::vector<double> rest_mm_;  ///< Distance of each contact from the other capsules.
  std::vector<PosedCapsule> posed_;
  std::vector<std::pair<Thing, Residual>> of_things_;
};

template <typename Visit>
void ContactTerm::ForEach(const PosedBody& posed, const Visit& visit) {
  Residual residual;
  const std::vector<SegmentMatch>& matches = Match(posed);
  for (std::size_t i = 0; i < matches.size(); ++i) {
    const SegmentMatch& match = matches[i];
    residual.is_ray = contacts_[i].is_edge;
    residual.capsule = -1;
    residual.outside_mm = rest_mm_.empty() ? kReach_mm : rest_mm_[i];
    if (match.capsule >= 0 && std::abs(match.distance.outside_mm) < std::abs(residual.outside_mm)) {
      const Vector3 offset = match.distance.segment_W - match.distance.core_W;
      residual.outside_mm = match.distance.outside_mm;
      residual.share = match.distance.share;
      residual.p_W = match.distance.segment_W;
      residual.capsule = moving_.empty() ? match.capsule : moving_[match.capsule];
      const double length = std::max(1.0, offset.norm());
      residual.normal_W =
          offset / length - LeanOf(posed.capsules()[residual.capsule], residual.share);
    }
    visit(residual, contacts_[i]);
  }
}

}  // namespace mocap
