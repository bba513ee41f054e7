// Compares the clocks of two computers.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>

namespace mocap {

/// Judges a node's clock by the apparent transit time of its messages: time received by the clock
/// here, minus time sent by the clock there. The minimum over up to a second is the clock offset
/// plus the least network delay. Thread-bound.
class NodeClock {
 public:
  /// If the offset is larger, frames cannot be grouped.
  static constexpr std::int64_t kMostApartNs = 5'000'000;
  /// A message that took longer is useless, whatever the reason.
  static constexpr std::int64_t kStaleNs = 500'000'000;

  /// Takes a message. @param set_ns  total by which the clock there was set so far. After a change,
  /// nothing can be used for half a second. @param now_ns  by the steady clock.
  /// @return  whether the times in the message can be used.
  bool Take(std::int64_t transit_ns, std::int64_t set_ns, std::int64_t now_ns);

  bool agrees() const { return apart_ns() >= -kMostApartNs && apart_ns() <= kMostApartNs; }
  /// How far the clock here is ahead of the node's; 0 before the first message.
  std::int64_t apart_ns() const;

 private:
  static constexpr std::int64_t kNone = std::numeric_limits<std::int64_t>::max();

  std::optional<std::int64_t> set_ns_;
  std::int64_t settled_ns_ = 0;  ///< Earliest time at which it can be judged.
  std::int64_t window_begin_ns_ = 0;
  std::int64_t least_ns_ = kNone;         ///< In this window,
  std::int64_t least_before_ns_ = kNone;  ///< and in the previous one.
};

}  // namespace mocap
