// Offsets between pairs of recordings, and the one clock that fits them all.
#pragma once

#include <optional>
#include <span>
#include <vector>

namespace mocap {

/// How one recording's clock lies to another's: an event at `at_s` of the first one is at
/// `at_s - ahead_s` of the second.
struct PairOffset {
  int first = 0, second = 0;
  double ahead_s = 0;
  double at_s = 0;  ///< Where the offset was measured, on the first one's clock.
  std::optional<double> rate_ppm =
      {};              ///< How much faster the offset grows than time; if measured.
  double sigma_s = 0;  ///< Standard deviation.
  /// How clearly it was found: the measure at this offset over that of the next best one, from 1.
  double clearness = 1;
};

/// From a recording's clock to the common one: T = offset + (1 + rate) t.
struct ClockFit {
  double offset_s = 0;
  double rate_ppm = 0;
  double sigma_s = 0;     ///< Standard deviation, from the scatter of the pairs.
  double worst_s = 0;     ///< Largest contradiction of a pair with the fit.
  double clearness = 0;   ///< Of the clearest pair.
  bool is_known = false;  ///< Connected with the reference.
};

/// Finds the clocks that fit all pairs, by weighted least squares. Pairs that contradict the others
/// are left out, as long as all remain connected.
/// @param known  clocks that stay as they are; if there is none, the recording with the most pairs
/// is the reference.
std::vector<ClockFit> FitClocks(std::vector<ClockFit> known, std::span<const PairOffset> pairs);

}  // namespace mocap
