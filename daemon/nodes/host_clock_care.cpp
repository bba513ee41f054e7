#include "daemon/nodes/host_clock_care.h"

#include <sys/timex.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>

namespace mocap {
namespace {

// The most exact first: where PTP runs, it is what counts.
constexpr std::array<const char*, 6> kKeepers = {"phc2sys", "ptp4l",   "chronyd",
                                                 "ntpd",    "ntpd-rs", "systemd-timesyn"};

std::string FirstLine(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  return line;
}

std::string FindKeeper() {
  std::size_t best = kKeepers.size();
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator("/proc", error)) {
    const std::string name = FirstLine(entry.path() / "comm");
    const auto found = std::ranges::find(kKeepers, name);
    best = std::min(best, static_cast<std::size_t>(found - kKeepers.begin()));
  }
  return best < kKeepers.size() ? kKeepers[best] : "";
}

}  // namespace

ClockCare LookAtClockCare() {
  timex state{};
  ClockCare care;
  care.is_kept = adjtimex(&state) != TIME_ERROR && (state.status & STA_UNSYNC) == 0;
  care.error_ms = static_cast<double>(state.maxerror) / 1000;
  care.keeper = FindKeeper();
  return care;
}

std::string BootName() { return FirstLine("/proc/sys/kernel/random/boot_id"); }

}  // namespace mocap
