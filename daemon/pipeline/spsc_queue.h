// The queues between threads: bounded, lock-free, one producer, one consumer.
#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

#include "core/errors.h"
#include "daemon/pipeline/doorbell.h"

namespace mocap {

/// Policy for a producer that finds its queue full.
enum class Overflow {
  kWait,       ///< The producer waits: nothing is lost. For recorded takes.
  kDropOldest  ///< The oldest item is dropped and counted. For live cameras.
};

/// Passes items from one thread to another in order, without locking or copying.
///
/// Items live in slots that circulate. The producer fills back() and pushes it; the consumer pops
/// and reads front(). Each keeps one slot for itself, so that the memory of items is reused. Every
/// cell of the ring always holds a slot. Pushing and popping swap the thread's own slot with the
/// cell's in one atomic step. This allows a producer to take the oldest item back while the
/// consumer reaches for it.
///
/// back, Push: producer only. front, TryPop: consumer only. Close and the rest: any thread.
template <typename T>
class SpscQueue {
 public:
  /// @param consumer_bell  rung at each push and on closing; several queues with the same consumer
  ///                       may share it. Borrowed for the queue's life.
  /// @param item           initial content of every slot, so that its memory is allocated.
  SpscQueue(std::size_t capacity, Overflow overflow, Doorbell& consumer_bell, const T& item = T())
      : overflow_(overflow),
        slots_(capacity + 2, item),
        cells_(capacity),
        producer_slot_(capacity),
        consumer_slot_(capacity + 1),
        consumer_bell_(consumer_bell) {
    MOCAP_CHECK(capacity > 0 && capacity < kSlotMask);
    for (std::size_t i = 0; i < capacity; ++i)
      cells_[i].store(Pack(0, i), std::memory_order_relaxed);
  }

  /// The item to fill before Push. It contains the data of an earlier item.
  T& back() { return slots_[producer_slot_]; }

  /// Hands back() over. On a closed queue the item is discarded.
  void Push() {
    std::atomic<std::uint64_t>& cell = cells_[pushed_ % cells_.size()];
    if (overflow_ == Overflow::kWait) AwaitSpace(cell);
    if (closed_.load(std::memory_order_acquire)) return;
    ++pushed_;
    const std::uint64_t previous =
        cell.exchange(Pack(pushed_, producer_slot_), std::memory_order_acq_rel);
    producer_slot_ = SlotOf(previous);
    if (NumberOf(previous) != 0) dropped_.fetch_add(1, std::memory_order_relaxed);
    published_.store(pushed_, std::memory_order_release);
    consumer_bell_.Ring();
  }

  /// Takes the oldest item into front(). @return false if there is none now.
  bool TryPop() {
    for (;;) {
      const std::uint64_t published = published_.load(std::memory_order_acquire);
      if (popped_ == published) return false;
      // Items older than the length of the ring have been overwritten.
      if (published - popped_ > cells_.size()) popped_ = published - cells_.size();
      std::atomic<std::uint64_t>& cell = cells_[popped_ % cells_.size()];
      std::uint64_t value = cell.load(std::memory_order_acquire);
      const bool mine = NumberOf(value) == popped_ + 1;
      if (mine &&
          cell.compare_exchange_strong(value, Pack(0, consumer_slot_), std::memory_order_acq_rel)) {
        consumer_slot_ = SlotOf(value);
        ++popped_;
        if (overflow_ == Overflow::kWait) producer_bell_.Ring();
        return true;
      }
      // The producer has just taken this one back.
      ++popped_;
    }
  }

  /// The item popped last. It belongs to the consumer until its next TryPop.
  T& front() { return slots_[consumer_slot_]; }

  /// Closes the queue, from either end. Items already pushed can still be popped; no more are
  /// accepted.
  void Close() {
    closed_.store(true, std::memory_order_release);
    consumer_bell_.Ring();
    producer_bell_.Ring();
  }
  /// Once true, a failed TryPop is final.
  bool closed() const { return closed_.load(std::memory_order_acquire); }
  /// Items that were handed over so far.
  std::int64_t pushed() const {
    return static_cast<std::int64_t>(published_.load(std::memory_order_acquire));
  }
  std::size_t capacity() const { return cells_.size(); }
  /// Upper bound of the capacity.
  static constexpr std::size_t kMostCapacity = 60'000;
  /// Items dropped to make room.
  std::int64_t dropped() const { return dropped_.load(std::memory_order_relaxed); }

 private:
  // A cell: the item's number, counted from 1, and its slot. Number 0 marks an empty slot.
  static constexpr int kSlotBits = 16;
  static constexpr std::uint64_t kSlotMask = (std::uint64_t{1} << kSlotBits) - 1;
  static std::uint64_t Pack(std::uint64_t number, std::size_t slot) {
    return number << kSlotBits | slot;
  }
  static std::uint64_t NumberOf(std::uint64_t cell) { return cell >> kSlotBits; }
  static std::size_t SlotOf(std::uint64_t cell) { return cell & kSlotMask; }

  void AwaitSpace(const std::atomic<std::uint64_t>& cell) const {
    for (;;) {
      const int seen = producer_bell_.count();
      if (NumberOf(cell.load(std::memory_order_acquire)) == 0 || closed()) return;
      producer_bell_.WaitPast(seen);
    }
  }

  const Overflow overflow_;
  std::vector<T> slots_;
  std::vector<std::atomic<std::uint64_t>> cells_;
  // The producer's data, the consumer's data and shared data are on separate cache lines.
  alignas(64) std::size_t producer_slot_;
  std::uint64_t pushed_ = 0;
  alignas(64) std::size_t consumer_slot_;
  std::uint64_t popped_ = 0;
  alignas(64) std::atomic<std::uint64_t> published_{0};
  std::atomic<std::int64_t> dropped_{0};
  std::atomic<bool> closed_{false};
  Doorbell& consumer_bell_;
  Doorbell producer_bell_;
};

}  // namespace mocap
