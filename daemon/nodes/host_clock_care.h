// Which program synchronizes this computer's clock.
#pragma once

#include <string>
#include <vector>

namespace mocap {

/// How well the time of day is kept.
struct ClockCare {
  std::string keeper;    ///< "ptp4l", "phc2sys", "chronyd", ...; empty: none known.
  bool is_kept = false;  ///< The kernel considers its clock synchronized.
  double error_ms = 0;   ///< Maximum error, as the kernel estimates it.
};

/// Asks the kernel, and looks for running programs that set clocks.
ClockCare LookAtClockCare();

/// The first of `programs` that sets clocks, the most accurate kind first; empty: none.
/// @param programs  names of processes, or of systemd units such as "ptp4l@eth0.service".
std::string FindClockKeeper(const std::vector<std::string>& programs);

/// The kernel's identifier of this boot, 32 hexadecimal digits; empty if it has none. Programs that
/// read the same one share a clock. If the kernel's file is hidden, the environment's
/// MOCAPD_BOOT_ID provides it.
std::string BootName();

}  // namespace mocap
