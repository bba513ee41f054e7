// Who keeps this computer's clock right.
#pragma once

#include <string>
#include <vector>

namespace mocap {

/// How well the time of day is kept.
struct ClockCare {
  std::string keeper;    ///< "ptp4l", "phc2sys", "chronyd", ...; empty: nobody who is known.
  bool is_kept = false;  ///< The kernel takes its clock for synchronized.
  double error_ms = 0;   ///< By which it may be off, at most, as the kernel has it.
};

/// Asks the kernel, and looks which of the programs that set clocks runs.
ClockCare LookAtClockCare();

/// The first of `programs` that sets clocks, the most exact kind first; empty: none.
/// @param programs  names of processes, or of units of systemd such as "ptp4l@eth0.service".
std::string FindClockKeeper(const std::vector<std::string>& programs);

/// The kernel's name for this start of this computer, 32 hexadecimal digits; empty where it has
/// none. Programs that read the same one have the same clock. Where the kernel's file is hidden,
/// MOCAPD_BOOT_ID of the environment tells it.
std::string BootName();

}  // namespace mocap
