// Correlation of two recordings' signals over all offsets in time.
#pragma once

#include <vector>

#include "tools/comparison/recorded_motion.h"

namespace mocap {

/// Values at even times; NaN: not known.
using Signal = std::vector<double>;

/// Even times from a recording's first frame to its last.
struct TimeGrid {
  double first_s = 0, step_s = 1;
  std::size_t count = 0;

  double At(std::size_t i) const { return first_s + step_s * static_cast<double>(i); }
};
TimeGrid GridOf(const RecordedMotion& motion, double step_s);

/// A point at the times of a grid: the mean of the frames around each.
std::vector<Vector3> Resampled(const RecordedMotion& motion, const PointTrack& track,
                               const TimeGrid& grid);
/// Speed of a point that was sampled at even times [mm/s].
Signal SpeedOf(const std::vector<Vector3>& p_mm, double step_s);
/// An angle at the times of a grid.
Signal Resampled(const RecordedMotion& motion, const AngleCurve& track, const TimeGrid& grid);

/// Those of several signals that have the shares 0, 1/4, 1/2, 3/4 and 1 of all below them, at each
/// time. They do not depend on which signal is which.
std::vector<Signal> Quantiles(const std::vector<Signal>& signals);

/// A pair of signals that should be the same but for an offset.
struct SignalPair {
  Signal a, b;
};

/// An offset at which signals correlate.
struct OffsetCandidate {
  double lag = 0;          ///< b[i] is compared with a[i + lag]; to a part of a sample.
  double correlation = 0;  ///< Mean of the pairs' Pearson correlations.
  double strength = 0;     ///< Fisher's transform of it, times the root of the overlap.
};

/// Finds the local maxima of the correlation over all lags, the strongest first. Unknown values are
/// left out, and every lag is normalized by what overlaps there (Padfield 2012).
/// @param least_overlap  of the signals, in samples. @param most  candidates.
std::vector<OffsetCandidate> FindOffsets(const std::vector<SignalPair>& pairs,
                                         std::size_t least_overlap, std::size_t most);

}  // namespace mocap
