// Settings of a GigE Vision or USB3 Vision camera. Unset ones stay as they are unless stated
// otherwise.
#pragma once

#include <optional>
#include <string>

namespace mocap {

struct AravisSettings {
  /// GenICam name, such as "BayerRG8" or "BGR8"; empty: the colour format that needs the least
  /// bandwidth.
  std::string format;
  /// If set, these disable the camera's automatic control.
  std::optional<double> exposure_us;
  std::optional<double> gain;  ///< [the camera's units].
  /// What starts an exposure. Empty: the camera's clock; "software": this host, at whole multiples
  /// of the period; "ptp": the same by the clock that cameras share over the network; otherwise the
  /// name of an input, such as "Line1".
  std::string trigger;
  /// Output that signals this camera's exposures, such as "Line2"; wired to other cameras' inputs,
  /// it triggers them. Empty: outputs stay as they are.
  std::string strobe;
  bool ptp = true;  ///< Enables PTP if the camera has it.
  // For GigE Vision:
  std::optional<int> packet_bytes;        ///< Empty: the largest that gets through.
  std::optional<double> packet_delay_us;  ///< Pause between packets.
  /// Whether to read packets past the kernel's UDP sockets. Empty: if these have no room for two
  /// frames and it is permitted.
  std::optional<bool> packet_socket;

  /// Exposures are started by something other than this program and the camera.
  bool waits_for_line() const {
    return !trigger.empty() && trigger != "software" && !is_scheduled();
  }
  /// Exposures are requested in advance, by the cameras' clock.
  bool is_scheduled() const { return trigger == "ptp"; }
};

}  // namespace mocap
