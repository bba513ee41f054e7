// The low-pass filter of biomechanics: Butterworth (1930), forward and backward, without delay.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace mocap {

/// A filter as it is asked for and recorded: `none`, or `butterworth:ORDER:HZ`.
struct NamedFilter {
  int order = 0;         ///< Of both passes together, even; 0: none.
  double cutoff_hz = 0;  ///< Where a half of the power is left after both passes.

  bool is_none() const { return order == 0; }
  /// The text that ParseFilter reads.
  std::string name() const;
};

/// @throws SetupError  naming what is expected.
NamedFilter ParseFilter(std::string_view text);

/// Filters equally spaced values in both directions of time, so that nothing is delayed. The ends
/// are continued by their point reflection. Each pass has half of the order; its own cut-off is
/// raised so that the whole filter has the wanted one (Winter 2009, 2.2.4.4.2). Coefficients follow
/// from the bilinear transform.
/// @param rate_hz  of the values.
/// @return  the values themselves if the rate is too low for the cut-off.
std::vector<double> ZeroLagButterworth(std::span<const double> values, const NamedFilter& filter,
                                       double rate_hz);

}  // namespace mocap
