// Whether the clocks of two computers agree.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>

namespace mocap {

/// Judges a node's clock by how long its messages seem to take: received by the clock here, less
/// sent by the clock there. The least of up to a second is what the clocks lie apart,
/// and what the network takes at the least. Thread-bound.
class NodeClock {
 public:
  /// Frames of clocks that lie farther apart cannot be grouped.
  static constexpr std::int64_t kMostApartNs = 5'000'000;
  /// What took longer is of no use, whatever the reason.
  static constexpr std::int64_t kStaleNs = 500'000'000;

  /// Takes a message. @param set_ns  by how much the clock there was set so far; after it was set
  /// again, nothing can be used for half a second. @param now_ns  by the steady clock.
  /// @return  whether what the message tells of times can be used.
  bool Take(std::int64_t transit_ns, std::int64_t set_ns, std::int64_t now_ns);

  bool agrees() const { return apart_ns() >= -kMostApartNs && apart_ns() <= kMostApartNs; }
  /// How far the clock here is ahead of the node's; 0 before the first message.
  std::int64_t apart_ns() const;

 private:
  static constexpr std::int64_t kNone = std::numeric_limits<std::int64_t>::max();

  std::optional<std::int64_t> set_ns_;
  std::int64_t settled_ns_ = 0;  ///< From when on it can be judged.
  std::int64_t window_begin_ns_ = 0;
  std::int64_t least_ns_ = kNone;         ///< Of this window,
  std::int64_t least_before_ns_ = kNone;  ///< and of the one before.
};

}  // namespace mocap
