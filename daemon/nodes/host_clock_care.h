// Who keeps this computer's clock right.
#pragma once

#include <string>

namespace mocap {

/// How well the time of day is kept.
struct ClockCare {
  std::string keeper;    ///< "ptp4l", "phc2sys", "chronyd", ...; empty: nobody who is known.
  bool is_kept = false;  ///< The kernel takes its clock for synchronized.
  double error_ms = 0;   ///< By which it may be off, at most, as the kernel has it.
};

/// Asks the kernel, and looks which of the programs that set clocks runs.
ClockCare LookAtClockCare();

/// The kernel's name for this start of this computer; empty where it has none. Programs that read
/// the same one have the same clock.
std::string BootName();

}  // namespace mocap
