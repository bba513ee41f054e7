// Measures durations: percentiles without storing every value.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace mocap {

/// Buckets of durations, each 1/32 of an octave wide but at least 128 ns. From 4.1 us on, the error
/// is at most 3 %.
struct LatencyBuckets {
  static constexpr int kUnitBits = 7;  ///< Durations count in units of 128 ns.
  static constexpr std::uint64_t kPerOctave = 32;
  static constexpr std::size_t kCount = 26 * kPerOctave;  ///< Up to two minutes.

  static constexpr std::size_t IndexOf(std::int64_t duration_ns) {
    const auto units =
        static_cast<std::uint64_t>(std::max<std::int64_t>(duration_ns, 0)) >> kUnitBits;
    if (units < kPerOctave) return units;
    const int shift = std::bit_width(units) - std::bit_width(kPerOctave);
    const std::size_t index = kPerOctave * shift + (units >> shift);
    return std::min(index, kCount - 1);
  }
  /// Start of a bucket [ns].
  static constexpr double BeginNs(std::size_t index) {
    const std::size_t octave = index / kPerOctave;
    const std::size_t shift = octave > 0 ? octave - 1 : 0;
    const std::size_t units = octave > 0 ? index % kPerOctave + kPerOctave : index;
    return static_cast<double>(units << shift << kUnitBits);
  }
};

/// Durations counted by bucket.
class LatencyHistogram {
 public:
  void Add(std::size_t bucket, std::int64_t count) { counts_[bucket] += count; }

  std::int64_t count() const {
    std::int64_t sum = 0;
    for (const std::int64_t count : counts_) sum += count;
    return sum;
  }

  /// The duration that a `share` (0 to 1) of all samples stays below; 0 without samples.
  double PercentileMs(double share) const {
    const auto wanted = share * static_cast<double>(count());
    std::int64_t below = 0;
    for (std::size_t i = 0; i < counts_.size(); ++i) {
      below += counts_[i];
      if (counts_[i] > 0 && static_cast<double>(below) >= wanted) {
        return (LatencyBuckets::BeginNs(i) + LatencyBuckets::BeginNs(i + 1)) / 2e6;
      }
    }
    return 0;
  }
  double MaxMs() const { return PercentileMs(1); }

  /// The samples since an earlier state of the same recorder.
  LatencyHistogram Since(const LatencyHistogram& earlier) const {
    LatencyHistogram later = *this;
    for (std::size_t i = 0; i < counts_.size(); ++i) later.counts_[i] -= earlier.counts_[i];
    return later;
  }

 private:
  std::array<std::int64_t, LatencyBuckets::kCount> counts_{};
};

/// Counts durations. Thread-safe; never waits, never allocates.
class LatencyRecorder {
 public:
  void Record(std::int64_t duration_ns) {
    counts_[LatencyBuckets::IndexOf(duration_ns)].fetch_add(1, std::memory_order_relaxed);
  }

  LatencyHistogram Snapshot() const {
    LatencyHistogram histogram;
    for (std::size_t i = 0; i < counts_.size(); ++i) {
      histogram.Add(i, counts_[i].load(std::memory_order_relaxed));
    }
    return histogram;
  }

 private:
  std::array<std::atomic<std::int64_t>, LatencyBuckets::kCount> counts_{};
};

}  // namespace mocap
