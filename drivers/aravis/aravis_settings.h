// What can be set of a GigE Vision or USB3 Vision camera. What is not set stays as it is, unless it
// is said otherwise.
#pragma once

#include <optional>
#include <string>

namespace mocap {

struct AravisSettings {
  /// GenICam's name, as "BayerRG8" or "BGR8"; empty: the one that needs the least bandwidth and
  /// has colour.
  std::string format;
  /// Given, these switch the camera's automatic off.
  std::optional<double> exposure_us;
  std::optional<double> gain;  ///< [the camera's units].
  /// What starts an exposure: empty for the camera's own clock, "software" for this host's at
  /// whole multiples of the period, "ptp" for these by the clock that cameras share over the
  /// network, else the name of the input, as "Line1".
  std::string trigger;
  /// The output that tells when this camera exposes, as "Line2": wired to the others' inputs it
  /// triggers them. Empty: outputs stay as they are.
  std::string strobe;
  bool ptp = true;  ///< Switches PTP on where the camera has it.
  // For GigE Vision:
  std::optional<int> packet_bytes;        ///< Empty: the largest that comes through.
  std::optional<double> packet_delay_us;  ///< Pause between packets.
  /// Whether to read packets past the kernel's UDP sockets. Empty: where their buffers are too
  /// small for two frames and it is allowed.
  std::optional<bool> packet_socket;

  /// Something else than this program and the camera itself starts its exposures.
  bool waits_for_line() const {
    return !trigger.empty() && trigger != "software" && !is_scheduled();
  }
  /// Exposures are asked for ahead, at times of the cameras' clock.
  bool is_scheduled() const { return trigger == "ptp"; }
};

}  // namespace mocap
