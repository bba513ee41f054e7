// Matches segments with the capsules that fit them best.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/body/segment_distances.h"
#include "core/kernels/contacts.h"

namespace mocap {

/// A part of the body farther away than this does not explain evidence [mm].
inline constexpr double kReach_mm = 150;

/// A segment that touches a surface, or a point of one (from_W = to_W).
struct OrientedSegment {
  Vector3 from_W;
  Vector3 to_W;
  Vector3 outward_W;  ///< The surface's normal there; unit length.
};

/// The capsule that fits a segment best: it is near and faces the same way.
struct SegmentMatch {
  int capsule = -1;  ///< -1: none within reach.
  PosedCapsule::SegmentDistance distance{};
};

/// Matches the same segments with one posed body after another. The best capsule is found in single
/// precision, for a block of neighbouring segments at a time, among the capsules in reach. Its
/// distance is computed in double precision.
class SegmentMatcher {
 public:
  /// Copies segments: a range of OrientedSegment, or of what is derived from it.
  template <typename Segments>
  void SetSegments(const Segments& segments) {
    segments_.assign(segments.begin(), segments.end());
    Prepare();
  }

  /// Finds for each segment the capsule with the least mismatch: its distance [mm] plus the angle
  /// between the surfaces, also expressed in millimetres.
  /// @param reach_mm  a capsule with this mismatch or more does not fit a segment.
  /// @return  one match per segment, valid until the next call.
  const std::vector<SegmentMatch>& Match(std::span<const PosedCapsule> capsules, double reach_mm);
  /// Those of the last call.
  const std::vector<SegmentMatch>& matches() const { return matches_; }

  static constexpr int kMostCapsules = kernels::kMostCapsules;

 private:
  void Prepare();
  // A posed body in single precision.
  struct SlimShape {
    std::vector<kernels::SlimCapsule> capsules;
    kernels::CapsuleBoxes boxes;
    std::uint32_t all;  // All of them, as bits.
  };
  void MatchAll(std::span<const PosedCapsule> capsules, double reach_mm);
  void MatchBlocks(int begin, int end, float reach_mm);
  void Slim(std::span<const PosedCapsule> capsules);
  void SortByPlace();
  void FillBlock(std::size_t first, kernels::ContactBlock& block) const;

  std::vector<OrientedSegment> segments_;
  std::vector<std::uint32_t> order_;  ///< The segments in the order of the blocks.
  std::vector<std::uint32_t> keys_;   ///< The segments' sort keys.
  std::vector<std::uint32_t> order_before_;
  std::vector<kernels::ContactBlock> blocks_;
  std::vector<kernels::BestCapsules> bests_;  ///< One per block.
  std::vector<kernels::CapsuleTrial> trials_;
  bool has_favourites_ = false;
  SlimShape slim_;
  std::vector<CapsuleAndSegment> pairs_;
  std::vector<SegmentMatch> matches_;
};

}  // namespace mocap
