#include "tools/doctor_checks.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/statvfs.h>
#include <sys/timex.h>
#include <systemd/sd-bus.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <fstream>
#include <lcm/lcm-cpp.hpp>
#include <memory>
#include <optional>

#include "config/load_config.h"
#include "core/calibration/camera_places.h"
#include "core/errors.h"
#include "daemon/base/disk_space.h"
#include "daemon/control/control_socket.h"
#include "daemon/control/remote_control.h"
#include "daemon/messages/pose_publisher.h"
#include "daemon/pipeline/realtime.h"
#include "daemon/status/diagnostics.h"
#include "drivers/clock.h"
#include "drivers/take/input_file.h"

namespace mocap {
namespace {

constexpr std::int64_t kLeastSocketBuffer = 2 * 1024 * 1024;
constexpr std::int64_t kLeastUsbMegabytes = 1000;
/// Six cameras of 640 x 480 pixels at 30 Hz, lossless, in a second.
constexpr double kUsualRecording_mb = 90;
constexpr double kLeastRecording_s = 300;
constexpr std::size_t kTrialBytes = 64 << 20;
constexpr const char* kEchoChannel = "MOCAP_DOCTOR";
constexpr int kEchoTimeoutMs = 1000;

std::optional<std::string> FirstLine(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::string line;
  if (!std::getline(in, line)) return {};
  return line;
}

std::optional<std::int64_t> NumberIn(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::int64_t value = 0;
  if (!(in >> value)) return {};
  return value;
}

/// Returns a limit of the systemd unit, by its sd-bus name; empty if systemd does not run.
std::optional<std::uint64_t> UnitLimit(const char* name) {
  sd_bus* opened = nullptr;
  if (sd_bus_open_system(&opened) < 0) return {};
  const std::unique_ptr<sd_bus, decltype(&sd_bus_unref)> bus(opened, &sd_bus_unref);
  std::uint64_t limit = 0;
  const bool is_told =
      sd_bus_get_property_trivial(
          bus.get(), "org.freedesktop.systemd1", "/org/freedesktop/systemd1/unit/mocapd_2eservice",
          "org.freedesktop.systemd1.Service", name, nullptr, 't', &limit) >= 0;
  return is_told ? std::optional(limit) : std::nullopt;
}

/// Returns the caller's limit.
std::uint64_t OwnLimit(__rlimit_resource resource) {
  rlimit limit{};
  getrlimit(resource, &limit);
  return geteuid() == 0 ? RLIM_INFINITY : limit.rlim_cur;
}

/// Writes and syncs a file; returns megabytes per second, empty without write permission.
std::optional<double> DiskSpeed(const std::filesystem::path& folder) {
  std::string name = (folder / ".mocap-doctor-XXXXXX").string();
  const FileDescriptor file(mkostemp(name.data(), O_CLOEXEC));
  if (!file.valid()) return {};
  unlink(name.c_str());
  const std::string block(1 << 20, '\x5a');
  const std::int64_t begin_ns = SteadyNs();
  for (std::size_t written = 0; written < kTrialBytes; written += block.size()) {
    if (write(file.get(), block.data(), block.size()) != static_cast<ssize_t>(block.size())) {
      return {};
    }
  }
  if (fdatasync(file.get()) != 0) return {};
  return kTrialBytes / 1e6 / (static_cast<double>(SteadyNs() - begin_ns) / 1e9);
}

Diagnosis CheckDevice(const std::string& name, const std::filesystem::path& device) {
  if (!std::filesystem::exists(device)) {
    return {Grade::kBad, fmt::format("{}: {} not found", name, device.string()),
            "plug the camera in; ls /dev/v4l/by-id lists what is connected"};
  }
  if (access(device.c_str(), R_OK | W_OK) != 0) {
    return {Grade::kBad, fmt::format("{}: no permission to use {}", name, device.string()),
            "as root: adduser USER video, then log in again"};
  }
  return {Grade::kGood, fmt::format("{}: {} is there", name, device.string()), ""};
}

}  // namespace

Diagnosis CheckMessages(const std::string& url) {
  try {
    const LcmProvider provider = ParseLcmUrl(url).provider;
    if (provider == LcmProvider::kMemory) {
      return {Grade::kBad, "messages on " + url + " do not leave mocapd",
              "set lcm.url to one like udpm://239.255.76.67:7667?ttl=0"};
    }
    if (provider == LcmProvider::kFile) {
      CheckLcm(url);
      return {Grade::kGood, "the log " + url + " can be written", ""};
    }
    const std::unique_ptr<lcm::LCM> receiver = OpenLcmToListen(url);
    const std::unique_ptr<lcm::LCM> sender = OpenLcm(url);
    bool heard = false;
    receiver->subscribeFunction(
        kEchoChannel,
        +[](const lcm::ReceiveBuffer*, const std::string&, bool* flag) { *flag = true; }, &heard);
    const char greeting[] = "hello";
    sender->publish(kEchoChannel, greeting, sizeof greeting);
    const std::int64_t end_ns = SteadyNs() + std::int64_t{kEchoTimeoutMs} * 1'000'000;
    while (!heard && SteadyNs() < end_ns) receiver->handleTimeout(kEchoTimeoutMs / 10);
    if (heard) return {Grade::kGood, "messages on " + url + " arrive", ""};
  } catch (const SetupError& error) {
    return {Grade::kBad, error.what(), ""};
  }
  return {Grade::kBad, "messages on " + url + " do not arrive",
          "check the firewall: UDP to that address has to pass"};
}

Diagnosis CheckSocketBuffers() {
  const std::int64_t most = NumberIn("/proc/sys/net/core/rmem_max").value_or(0);
  const std::string what = fmt::format("sockets may buffer {} kB", most / 1024);
  if (most >= kLeastSocketBuffer) return {Grade::kGood, what, ""};
  return {Grade::kAdvice, what + "; voxels and network cameras lose packets",
          fmt::format("as root: sysctl -w net.core.rmem_max={}; the package keeps it in "
                      "/usr/lib/sysctl.d/60-mocapd.conf",
                      kLeastSocketBuffer)};
}

Diagnosis CheckLimits(const RealtimeConfig& config, Starter starter) {
  const bool by_systemd = starter == Starter::kSystemd;
  const auto unit_limit = [by_systemd](const char* name) {
    return by_systemd ? UnitLimit(name) : std::nullopt;
  };
  const int priority = config.priority.value_or(kUsualPriority);
  const std::optional<std::uint64_t> highest = unit_limit("LimitRTPRIO");
  const bool may_go_first =
      highest ? *highest >= static_cast<std::uint64_t>(priority) : MayTakePriority(priority);
  const std::uint64_t locked = unit_limit("LimitMEMLOCK").value_or(OwnLimit(RLIMIT_MEMLOCK));
  const bool may_lock = !config.lock_memory || locked == RLIM_INFINITY;
  if (may_go_first && may_lock) {
    return {Grade::kGood, "limits allow real-time priority and the settings of [realtime]", ""};
  }
  const std::string fix =
      by_systemd
          ? "systemctl edit mocapd: [Service] LimitRTPRIO=49 LimitMEMLOCK=infinity"
          : "rtprio 49 and memlock unlimited in /etc/security/limits.conf, then log in again";
  if (may_lock && !config.priority) {
    return {Grade::kAdvice,
            "limits do not allow real-time priority; recordings and other programs delay poses",
            fix};
  }
  return {Grade::kBad, "limits do not allow the settings of [realtime]", fix};
}

Diagnosis CheckClock() {
  timex state{};
  if (adjtimex(&state) != TIME_ERROR && (state.status & STA_UNSYNC) == 0) {
    return {Grade::kGood,
            fmt::format("the clock is synchronized, within {:.1f} ms",
                        static_cast<double>(state.esterror) / 1000),
            ""};
  }
  return {Grade::kAdvice,
          "the clock is not synchronized; capture times cannot be compared across computers",
          "as root: apt install chrony, or timedatectl set-ntp true"};
}

Diagnosis CheckProcessor() {
  const std::optional<std::string> governor =
      FirstLine("/sys/devices/system/cpu/cpu0/cpufreq/scaling_governor");
  if (!governor || *governor == "performance") {
    return {Grade::kGood, fmt::format("{} processors", sysconf(_SC_NPROCESSORS_ONLN)), ""};
  }
  return {Grade::kAdvice,
          fmt::format("the processor's speed follows its load ({}), which makes latency uneven",
                      *governor),
          "as root: cpupower frequency-set -g performance"};
}

Diagnosis CheckDisk(const std::filesystem::path& folder, double keep_free_mb) {
  const std::filesystem::path place = NearestFolder(folder);
  struct statvfs space {};
  if (statvfs(place.c_str(), &space) != 0) {
    return {Grade::kBad, place.string() + ": " + std::strerror(errno), "choose another folder"};
  }
  const double free_mb =
      static_cast<double>(space.f_bavail) * static_cast<double>(space.f_frsize) / 1e6;
  return JudgeSpace(folder.string(), free_mb, keep_free_mb, DiskSpeed(place));
}

Diagnosis JudgeSpace(const std::string& disk, double free_mb, double keep_free_mb,
                     std::optional<double> speed_mb) {
  const std::string free = fmt::format("{}: {:.1f} GB free", disk, free_mb / 1000);
  if (free_mb < keep_free_mb) {
    return {Grade::kBad,
            fmt::format("{}, and recording.keep_free_mb is {:.0f}: nothing can be recorded", free,
                        keep_free_mb),
            "free some space, or set recording.folder to a folder on another disk"};
  }
  const double room_s = (free_mb - keep_free_mb) / kUsualRecording_mb;
  std::string what = fmt::format("{}, room for about {} of takes of six cameras (640 x 480, 30 Hz)",
                                 free, Duration(static_cast<std::int64_t>(room_s * 1e9)));
  if (speed_mb) what += fmt::format("; the disk writes {:.0f} MB/s", *speed_mb);
  constexpr double kNeeded_mb = 1.5 * kUsualRecording_mb;
  if (speed_mb && *speed_mb < kNeeded_mb) {
    return {
        Grade::kBad, what,
        fmt::format("use a disk that writes at least {:.0f} MB/s, or recording.codec = \"ffv1\"",
                    kNeeded_mb)};
  }
  if (room_s < kLeastRecording_s) {
    return {Grade::kAdvice, what,
            "free some space, or set recording.folder to a folder on another disk"};
  }
  return {Grade::kGood, what, ""};
}

std::vector<Diagnosis> CheckCalibration(const Config& config) {
  if (!IsThere(config.calibration)) return {};
  const std::string where = config.calibration.string();
  std::vector<CameraCalibration> cameras;
  try {
    cameras = LoadCalibration(config.calibration);
  } catch (const SetupError& error) {
    return {{Grade::kBad, error.what(), "calibrate again: mocap calibrate studio"}};
  }
  std::vector<Diagnosis> diagnoses;
  for (const Finding& finding : CheckPlaces(cameras, true)) {
    diagnoses.push_back({finding.severity == Severity::kWrong ? Grade::kBad : Grade::kAdvice,
                         where + ": " + finding.text,
                         "for details: mocap calibrate check " + where});
  }
  if (diagnoses.empty())
    diagnoses.push_back(
        {Grade::kGood, where + ": the extrinsics of its cameras are plausible", ""});
  return diagnoses;
}

std::vector<Diagnosis> CheckDevices(const Config& config) {
  std::vector<Diagnosis> diagnoses;
  if (config.source.driver == "v4l2") {
    for (const CameraConfig& camera : config.cameras) {
      // A bus or serial number is checked by `mocap cameras --check`.
      if (!camera.device.starts_with('/')) continue;
      diagnoses.push_back(CheckDevice(camera.name, camera.device));
    }
  }
  const auto usb_mb = NumberIn("/sys/module/usbcore/parameters/usbfs_memory_mb");
  if (config.source.driver == "aravis" && usb_mb && *usb_mb > 0 && *usb_mb < kLeastUsbMegabytes) {
    diagnoses.push_back({Grade::kAdvice, fmt::format("USB cameras may buffer {} MB", *usb_mb),
                         fmt::format("as root: echo {} > "
                                     "/sys/module/usbcore/parameters/usbfs_memory_mb",
                                     kLeastUsbMegabytes)});
  }
  return diagnoses;
}

Diagnosis CheckControl(const std::filesystem::path& socket, Starter starter) {
  try {
    AskDaemon(socket, "status");
    return {Grade::kGood, "mocapd runs and answers", ""};
  } catch (const SetupError& error) {
    return {Grade::kBad, "mocapd runs, but you may not control it", error.what()};
  } catch (const std::exception& error) {
    const bool is_service = starter == Starter::kSystemd;
    return {Grade::kAdvice, error.what(),
            is_service ? "journalctl -u mocapd shows why it stopped" : ""};
  }
}

std::vector<Diagnosis> CheckNodes(const Config& config) {
  constexpr std::chrono::seconds kPatience{10};
  std::vector<Diagnosis> diagnoses;
  for (const StudioNode& node : config.nodes) {
    const std::string name = "node " + node.name;
    if (node.control.empty()) {
      diagnoses.push_back({Grade::kAdvice, name + " has no control command in [[nodes]]",
                           "see docs/nodes.md: recordings at the studio need it"});
      continue;
    }
    const RemoteAnswer answer = RemoteControl(name, node.control).Ask("status", kPatience);
    const bool is_good = answer.reply && answer.reply->outcome == ControlOutcome::kDone;
    if (is_good) {
      diagnoses.push_back({Grade::kGood, name + " answers", ""});
    } else {
      diagnoses.push_back({Grade::kBad,
                           answer.reply ? name + ": " + answer.reply->text : answer.problem,
                           "see docs/operating.md, Nodes: requests"});
    }
  }
  return diagnoses;
}

}  // namespace mocap
