#include "daemon/nodes/host_clock_care.h"

#include <sys/timex.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace mocap {
namespace {

// Prefixes of their processes and systemd units, the most accurate first: where PTP runs, it
// decides.
constexpr std::array<const char*, 5> kKeepers = {"phc2sys", "ptp4l", "chrony", "ntp",
                                                 "systemd-timesyn"};

// Units count too, because a service may not be allowed to see other users' processes.
constexpr const char* kUnits = "/sys/fs/cgroup/system.slice";

std::string FirstLine(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  return line;
}

/// The names of all visible processes and services.
std::vector<std::string> RunningPrograms() {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator("/proc", error))
    names.push_back(FirstLine(entry.path() / "comm"));
  const std::filesystem::recursive_directory_iterator end;
  for (std::filesystem::recursive_directory_iterator at(kUnits, error); !error && at != end;
       at.increment(error)) {
    const std::filesystem::path& unit = at->path();
    if (unit.extension() == ".service") names.push_back(unit.filename());
    // The instances of a template, such as ptp4l@eth0.service, are in its slice.
    if (unit.extension() != ".slice") at.disable_recursion_pending();
  }
  return names;
}

}  // namespace

ClockCare LookAtClockCare() {
  timex state{};
  ClockCare care;
  const int found = adjtimex(&state);
  care.is_kept = found >= 0 && found != TIME_ERROR && (state.status & STA_UNSYNC) == 0;
  care.error_ms = static_cast<double>(state.maxerror) / 1000;
  care.keeper = FindClockKeeper(RunningPrograms());
  return care;
}

std::string FindClockKeeper(const std::vector<std::string>& programs) {
  for (const char* keeper : kKeepers) {
    const auto found = std::ranges::find_if(
        programs, [&](const std::string& program) { return program.starts_with(keeper); });
    if (found != programs.end()) return found->substr(0, found->find_first_of("@."));
  }
  return {};
}

std::string BootName() {
  std::string name = FirstLine("/proc/sys/kernel/random/boot_id");
  if (const char* told = std::getenv("MOCAPD_BOOT_ID"); name.empty() && told != nullptr)
    name = told;
  std::erase(name, '-');
  return name;
}

}  // namespace mocap
