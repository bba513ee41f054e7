#include "daemon/status/diagnostics.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <ctime>

#include "daemon/status/camera_diagnostics.h"
#include "daemon/status/node_diagnostics.h"
#include "drivers/printable_text.h"

namespace mocap {
namespace {

/// Exposures further apart than this share of a period blur moving people.
constexpr double kWideSpread = 0.25;

/// An older report is out of date.
constexpr std::int64_t kOld = 5'000'000'000;
/// Maximum response time of a disk.
constexpr std::int64_t kDiskStall = 5'000'000'000;
/// A silence is reported after this time.
constexpr std::int64_t kSilence = 2'500'000'000;
/// A camera that misses sets more often than this is reported.
constexpr double kMostLate = 0.2;

using List = std::vector<std::string>;

/// Faults that make all other lines doubtful.
void ComplainOfReport(const ServiceReport& report, List& list) {
  if (report.age_ns > kOld) {
    list.push_back(fmt::format(
        "mocapd's main thread has not responded for {}: this status is just as old; restart mocapd",
        Duration(report.age_ns)));
  }
  if (report.now.status.cameras.empty()) {
    list.push_back("no status yet: mocapd has just started; ask again");
  }
}

void ComplainOfDelivery(const ServiceReport& report, List& list) {
  const Delivery& delivery = report.delivery;
  if (!delivery.problem.empty()) {
    list.push_back(
        fmt::format("poses cannot be sent to {}: {}: check the network, its multicast route or the "
                    "LCM server; mocap doctor helps",
                    report.lcm_url, delivery.problem));
  } else if (!delivery.channel.receive_fault.empty()) {
    list.push_back(fmt::format("nothing can be received here on {}: {}", report.lcm_url,
                               delivery.channel.receive_fault));
  } else if (delivery.channel.silent_ns > 0) {
    list.push_back(
        fmt::format("mocapd has received none of its own messages on {} for {}: check the "
                    "firewall, and whether the network changed",
                    report.lcm_url, Duration(delivery.channel.silent_ns)));
  }
  if (delivery.channel.other_sender) {
    list.push_back(
        fmt::format("another mocapd, or a log that is being played, also sends on {}: clients "
                    "receive both in turns; use another lcm.prefix or port",
                    report.lcm_url));
  }
  if (delivery.channel.reaches_nobody) {
    list.push_back(
        fmt::format("poses are not sent to other programs: lcm.url is {}; expected one like "
                    "udpm://239.255.76.67:7667?ttl=0",
                    report.lcm_url));
  }
}

void ComplainOfDisk(const ServiceReport& report, List& list) {
  if (report.disk_stall_ns > kDiskStall) {
    list.push_back(fmt::format("the disk has not responded for {}: check {}",
                               Duration(report.disk_stall_ns), report.takes.string()));
  }
  if (!report.takes_problem.empty()) {
    list.push_back(fmt::format("takes cannot be written to {}: {}", report.takes.string(),
                               report.takes_problem));
  }
  if (!report.metrics_problem.empty()) {
    list.push_back("metrics cannot be written to " + report.metrics_problem);
  }
  if (report.log_fails) {
    list.push_back("the log cannot be written: check the free space on its disk");
  }
}

void ComplainOfRecording(const ServiceReport& report, List& list) {
  const RecordingStatus& recording = report.recording;
  if (recording.state == RecordingStatus::State::kFailed) {
    list.push_back("the recording failed: " + recording.problem);
  }
  if (recording.state == RecordingStatus::State::kComplete && !recording.problem.empty()) {
    list.push_back("the recording " + recording.problem);
  }
  if (recording.state == RecordingStatus::State::kRunning && recording.dropped > 0) {
    list.push_back(fmt::format("{} dropped from the recording: {}",
                               Counted(recording.dropped, "frame"),
                               TextOf(recording.cause.value_or(LossCause::kUnknown))));
  }
  for (const CutOffTake& take : report.cut_off) {
    list.push_back(
        fmt::format("the recording {} was cut off at {:%H:%M:%S} UTC after {:.1f} s: it can be "
                    "opened as it is; rename {} to keep it",
                    take.folder.stem().string(),
                    fmt::gmtime(static_cast<std::time_t>(take.last_ns / 1'000'000'000)),
                    static_cast<double>(take.duration_ns) / 1e9, take.folder.string()));
  }
  if (static_cast<double>(report.bytes_free) < 1e6 * report.keep_free_mb) {
    list.push_back(fmt::format(
        "the disk for takes has {:.0f} MB left: nothing can be recorded; free some space in {}",
        static_cast<double>(report.bytes_free) / 1e6, report.takes_place.string()));
  }
}

/// All connected cameras are silent: something that they share is to blame.
void ComplainOfSilence(const ServiceReport& report, List& list) {
  for (std::size_t i = 0; i < report.now.status.cameras.size(); ++i) {
    const bool is_there = report.now.status.cameras[i].state == CameraState::kStreaming;
    if (!is_there || WaitsForTrigger(report, i)) continue;
    list.push_back(
        "no camera delivers frames: check their trigger (pulse generator or PTP), their power and "
        "their network; tracking is paused");
    return;
  }
}

/// Carving needs two cameras, whether there are sets or not.
void ComplainOfOneAlone(const ServiceReport& report, List& list) {
  if (report.now.window_ns < kSilence) return;
  const auto& rates = report.now.frames_per_second;
  const auto gives = [](double rate) { return rate > 0; };
  if (std::ranges::count_if(rates, gives) != 1) return;
  const auto only = std::ranges::find_if(rates, gives) - rates.begin();
  list.push_back(
      fmt::format("only {} delivers frames: tracking needs at least two cameras, and four for good "
                  "poses; tracking is paused",
                  report.now.status.cameras[static_cast<std::size_t>(only)].name));
}

void ComplainOfSets(const ServiceReport& report, List& list) {
  // Nothing can be said of the first seconds.
  if (report.now.window_ns < kSilence) return;
  // Sets that were dropped had been formed; ComplainOfTime reports them.
  if (report.now.sets_per_second > 0 || report.now.sets_dropped_lately > 0) return;
  const PipelineStatus& status = report.now.status;
  if (status.sets_complete + status.sets_partial > status.sets_tracked) {
    list.push_back(
        "processing a frame set takes several seconds: the processor is too slow for this voxel "
        "size, or is busy with other programs");
    return;
  }
  const auto& rates = report.now.frames_per_second;
  const auto delivering = std::ranges::count_if(rates, [](double rate) { return rate > 0; });
  if (delivering == 0) return ComplainOfSilence(report, list);
  if (delivering == 1) return;
  list.push_back(
      fmt::format("no frame sets are formed, although {} of {} cameras deliver frames: check their "
                  "trigger and their clocks; tracking is paused",
                  delivering, rates.size()));
}

/// Every camera delivers, but sets are incomplete.
void ComplainOfMatching(const ServiceReport& report, List& list) {
  const StatusReport& now = report.now;
  if (now.late_per_second.size() != now.status.cameras.size()) return;
  List late;
  bool all_deliver = true;
  bool some_is_blind = false;
  for (std::size_t i = 0; i < now.status.cameras.size(); ++i) {
    const double rate = now.frames_per_second[i];
    all_deliver &= rate > 0 && HasGoodRate(report, i);
    some_is_blind |= now.status.cameras[i].is_blind;
    if (rate > 0 && now.late_per_second[i] > kMostLate * rate) {
      late.push_back(now.status.cameras[i].name);
    }
  }
  if (!late.empty()) {
    list.push_back(
        fmt::format("frames arrive too late for their sets: {}: check their clocks, their trigger, "
                    "and their bus or network",
                    fmt::join(late, ", ")));
  } else if (all_deliver && !some_is_blind && now.sets_complete_lately == 0 &&
             now.sets_partial_lately > 0) {
    list.push_back(
        "no frame set is complete, although every camera delivers frames: check their trigger and "
        "their clocks");
  }
}

/// Cameras fall silent with the one that triggers them: one line reports all.
void ComplainOfTriggers(const ServiceReport& report, List& list) {
  const auto& cameras = report.now.status.cameras;
  for (std::size_t m = 0; m < cameras.size(); ++m) {
    const CameraStatus& master = cameras[m];
    List silent;
    for (std::size_t i = 0; i < cameras.size(); ++i) {
      const bool is_its = cameras[i].waits_for == master.name;
      if (is_its && WaitsForTrigger(report, i)) silent.push_back(cameras[i].name);
    }
    if (silent.empty()) continue;
    if (master.state == CameraState::kLost || master.state == CameraState::kStarting) {
      const bool is_lost = master.state == CameraState::kLost;
      list.push_back(fmt::format("waiting for the trigger of {}, which {}: {}", master.name,
                                 is_lost ? "is lost" : "has not delivered a frame yet",
                                 fmt::join(silent, ", ")));
    } else if (report.now.frames_per_second[m] > 0) {
      list.push_back(fmt::format(
          "no trigger from {} reaches {}: check the wire, the strobe of {} and their trigger",
          master.name, fmt::join(silent, ", "), master.name));
    }
  }
}

/// Names the camera that disagrees most: a bumped one makes the others disagree a little.
void ComplainOfPlace(const PipelineStatus& status, List& list) {
  const auto off_px = [](const CameraStatus& camera) {
    return IsCompared(camera) ? camera.health.shift_px.norm() : 0.0;
  };
  const auto worst = std::ranges::max_element(status.cameras, {}, off_px);
  if (worst == status.cameras.end() || off_px(*worst) < kMostShift_px) return;
  list.push_back(fmt::format(
      "{} sees the person {:.1f} px away from where the other cameras do: it was moved since it "
      "was calibrated; record a take of a person who walks about, then run mocap calibrate refine",
      worst->name, off_px(*worst)));
}

/// A calibration that is wrong by itself explains whatever follows.
void ComplainOfCalibration(const ServiceReport& report, List& list) {
  if (report.calibration_fault.empty()) return;
  list.push_back(fmt::format("{}: {}", report.calibration.where, report.calibration_fault));
}

/// Somebody walks before the cameras and is not found. In an empty room nothing is wrong, and
/// without sets nothing is known.
void ComplainOfNobody(const ServiceReport& report, List& list) {
  const SeenPeople& people = report.now.status.people;
  const std::int64_t missed_ns = std::min(report.nobody_ns, people.seen_for_ns);
  if (report.now.sets_per_second == 0 || missed_ns < PeopleWatch::kWindow_ns) return;
  list.push_back(fmt::format(
      "a person is moving in most pictures, but has not been found for {}: {}", Duration(missed_ns),
      people.fault
          ? people.fault->text
          : "check in mocap view that at least three cameras see the whole person and that nothing "
            "else is taken for a person; mocap subject new starts the search again"));
}

void ComplainOfLight(const ServiceReport& report, List& list) {
  if (!report.light_change) return;
  const LightChange& change = *report.light_change;
  list.push_back(
      fmt::format("the light changed suddenly, by {:+.0f} % in {}: this is compensated, but check "
                  "that the poses are still good",
                  100 * (change.factor - 1), fmt::join(change.cameras, ", ")));
}

void ComplainOfFurniture(const ServiceReport& report, List& list) {
  for (const MovedFurniture& thing : report.moved) {
    list.push_back(fmt::format(
        "{} has something else than its background at the {} ({} of the picture), for {}: put it "
        "back, or run mocap background learn --occupied --accept {}",
        thing.camera, thing.place, ShareText(thing.share), Duration(thing.age_ns), thing.camera));
  }
}

void ComplainOfKeypoints(const ServiceReport& report, List& list) {
  for (const KeypointSender& sender : report.keypoints.senders) {
    if (sender.agreement.value_or(1) >= kLeastAgreement) continue;
    list.push_back(fmt::format(
        "keypoints of {} disagree with the poses (agreement {:.0f} %): check its times, "
        "its cameras, and which side it calls left",
        sender.name, 100 * *sender.agreement));
  }
}

void ComplainOfTime(const ServiceReport& report, List& list) {
  if (report.now.sets_dropped_lately > 0) {
    list.push_back(
        fmt::format("{} frame sets were dropped recently: the processor is too slow for this rate "
                    "and voxel size, or is busy with other programs",
                    report.now.sets_dropped_lately));
  }
  const double spread_ms = report.now.recent[Stage::kSpread].p99_ms;
  if (report.fps_nominal > 0 && spread_ms > kWideSpread * 1000 / report.fps_nominal) {
    list.push_back(fmt::format(
        "the cameras' exposures are {:.1f} ms apart: check the trigger or the clocks", spread_ms));
  }
}

}  // namespace

std::vector<std::string> Diagnostics(const ServiceReport& report) {
  if (report.told) return *report.told;
  List list;
  ComplainOfReport(report, list);
  ComplainOfDelivery(report, list);
  ComplainOfRecording(report, list);
  ComplainOfDisk(report, list);
  if (report.node.empty()) ComplainOfSets(report, list);
  std::ranges::move(NodeDiagnostics(report.nodes, report.lcm_url), std::back_inserter(list));
  // Without reception no studio can be heard.
  if (report.link && report.delivery.channel.receive_fault.empty()) {
    std::ranges::move(
        LinkDiagnostics(*report.link, report.now.status.cameras, report.recording, report.lcm_url),
        std::back_inserter(list));
  }
  std::ranges::move(CameraDiagnostics(report), std::back_inserter(list));
  if (report.node.empty()) ComplainOfOneAlone(report, list);
  ComplainOfTriggers(report, list);
  ComplainOfMatching(report, list);
  ComplainOfCalibration(report, list);
  ComplainOfNobody(report, list);
  ComplainOfPlace(report.now.status, list);
  ComplainOfLight(report, list);
  ComplainOfFurniture(report, list);
  ComplainOfKeypoints(report, list);
  ComplainOfTime(report, list);
  return list;
}

std::string Duration(std::int64_t ns) {
  const std::int64_t seconds = ns / 1'000'000'000;
  if (seconds < 120) return fmt::format("{} s", seconds);
  if (seconds < 7200) return fmt::format("{} min", seconds / 60);
  if (seconds < 172'800) return fmt::format("{} h", seconds / 3600);
  return fmt::format("{} days", seconds / 86'400);
}

}  // namespace mocap
