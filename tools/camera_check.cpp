#include "tools/camera_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <future>
#include <limits>
#include <utility>

#include "core/errors.h"
#include "daemon/pipeline/synchronizer.h"
#include "drivers/clock.h"
#include "drivers/printable_text.h"

namespace mocap {
namespace {

constexpr std::chrono::milliseconds kCheckGrabTimeout{100};
/// Time for exposure and buffers to settle.
constexpr std::int64_t kCheckSettle_ns = 500'000'000;
constexpr double kFullRate = 0.95;
constexpr double kMostMissedFrames = 0.005;
/// Usable share of a bus's nominal bandwidth.
constexpr double kUsableLink = 0.8;
/// Largest offset between synchronized cameras, as a share of the period.
constexpr double kInStep = 0.15;
constexpr double kMostIncomplete = 0.02;

// Losses count from the start: they do not settle.
void WatchFrames(CameraDriver& driver, double seconds, CameraRun& run) {
  const std::int64_t settled_ns = SteadyNs() + kCheckSettle_ns;
  const std::int64_t end_ns = settled_ns + std::llround(seconds * 1e9);
  bool was_lost = false;
  for (std::int64_t now_ns = SteadyNs(); now_ns < end_ns; now_ns = SteadyNs()) {
    Frame frame;
    const GrabStatus status = driver.Grab(frame, kCheckGrabTimeout);
    run.times_lost += status == GrabStatus::kLost && !was_lost;
    was_lost = status == GrabStatus::kLost;
    if (now_ns < settled_ns) continue;
    run.torn += status == GrabStatus::kTorn;
    if (status != GrabStatus::kFrame) continue;
    run.times_ns.push_back(frame.capture_ns);
    run.sequences.push_back(frame.sequence);
  }
}

CameraRun WatchCamera(LiveCamera& camera, double seconds) {
  CameraRun run;
  run.name = camera.name;
  run.request = camera.request;
  run.waits_for = camera.waits_for;
  try {
    camera.driver->Start();
  } catch (const SetupError& error) {
    run.error = error.what();
    return run;
  }
  WatchFrames(*camera.driver, seconds, run);
  run.facts = camera.driver->Facts();
  camera.driver->Stop();
  return run;
}

double AskedFps(const CameraRun& run) {
  return run.facts.fps > 0 ? std::min(run.facts.fps, run.request.fps) : run.request.fps;
}

const BusLoad* FindLoad(const std::vector<BusLoad>& loads, const CameraRun& run) {
  const auto load = std::ranges::find(loads, run.facts.bus, &BusLoad::bus);
  return load == loads.end() ? nullptr : &*load;
}

std::string WhyMissed(const BusLoad* load) {
  if (load && load->share() > kUsableLink) {
    return fmt::format("{} is full to {:.0f} %: set a lower fps or another format", load->bus,
                       100 * load->share());
  }
  return "this machine or its link to the camera is too slow: stop other programs, or set a lower "
         "fps";
}

// Whether frames lost by some camera, which are reported with it, explain incomplete sets.
bool IsExplained(const std::vector<CameraRun>& runs) {
  double slowest = std::numeric_limits<double>::infinity(), fastest = 0;
  bool loses = false;
  for (const CameraRun& run : runs) {
    loses |= !run.error.empty() || run.torn > 0 || run.times_lost > 0 || run.MissedFrames() > 0;
    if (run.IsSilent()) continue;
    slowest = std::min(slowest, run.TakenFps());
    fastest = std::max(fastest, run.TakenFps());
  }
  return loses && slowest > kFullRate * fastest;
}

}  // namespace

std::int64_t CameraRun::MissedFrames() const {
  if (sequences.empty()) return 0;
  const auto taken = static_cast<std::int64_t>(sequences.back() - sequences.front()) + 1;
  return std::max<std::int64_t>(taken - static_cast<std::int64_t>(sequences.size()) - torn, 0);
}

double CameraRun::Fps() const {
  if (IsSilent()) return 0;
  const double seconds = static_cast<double>(times_ns.back() - times_ns.front()) / 1e9;
  return seconds > 0 ? static_cast<double>(times_ns.size() - 1) / seconds : 0;
}

double CameraRun::TakenFps() const {
  if (times_ns.empty()) return 0;
  const auto whole = static_cast<double>(times_ns.size());
  return Fps() * (whole + torn + static_cast<double>(MissedFrames())) / whole;
}

std::vector<CameraRun> WatchCameras(std::vector<LiveCamera>& cameras, double seconds) {
  std::vector<std::future<CameraRun>> watching;
  for (LiveCamera& camera : cameras) {
    watching.push_back(std::async(std::launch::async,
                                  [&camera, seconds] { return WatchCamera(camera, seconds); }));
  }
  std::vector<CameraRun> runs;
  for (auto& watched : watching) runs.push_back(watched.get());
  return runs;
}

std::vector<BusLoad> LoadsOf(const std::vector<CameraRun>& runs) {
  std::vector<BusLoad> loads;
  for (const CameraRun& run : runs) {
    if (run.facts.bus.empty()) continue;
    auto load = std::ranges::find(loads, run.facts.bus, &BusLoad::bus);
    if (load == loads.end()) load = loads.insert(loads.end(), BusLoad{run.facts.bus, 0, 0, {}});
    load->used_mbit_s += 8e-6 * run.facts.bytes_per_frame * run.Fps();
    load->link_mbit_s = std::max(load->link_mbit_s, run.facts.link_mbit_s);
    load->cameras.push_back(run.name);
  }
  return loads;
}

SetSummary SummarizeSets(const std::vector<CameraRun>& runs) {
  SetSummary summary;
  const auto running = [](const CameraRun& run) { return !run.IsSilent(); };
  const auto cameras = static_cast<int>(std::ranges::count_if(runs, running));
  if (cameras < 2) return summary;
  double fps = 0;
  for (const CameraRun& run : runs) fps = std::max(fps, AskedFps(run));
  Synchronizer synchronizer(static_cast<int>(runs.size()), std::llround(1e9 / fps),
                            Synchronizer::kWaitForever);
  std::vector<std::size_t> next(runs.size());
  std::vector<double> spreads_ms;
  for (auto decision = Synchronizer::Decision::kLetGo; decision != Synchronizer::Decision::kWait;) {
    bool any = false;
    for (std::size_t i = 0; i < runs.size(); ++i) {
      const int camera = static_cast<int>(i);
      while (!synchronizer.has_front(camera) && next[i] < runs[i].times_ns.size()) {
        synchronizer.Offer(camera, runs[i].times_ns[next[i]], runs[i].sequences[next[i]]);
        ++next[i];
      }
      if (!synchronizer.has_front(camera)) synchronizer.Expect(camera, Expectation::kNone);
      any |= synchronizer.has_front(camera);
    }
    if (!any) break;
    decision = synchronizer.Decide();
    if (decision != Synchronizer::Decision::kSet) continue;
    ++summary.sets;
    if (std::ranges::count(synchronizer.members(), true) < cameras) continue;
    ++summary.complete;
    spreads_ms.push_back(static_cast<double>(synchronizer.spread_ns()) / 1e6);
  }
  if (spreads_ms.empty()) return summary;
  std::ranges::sort(spreads_ms);
  summary.median_spread_ms = spreads_ms[spreads_ms.size() / 2];
  summary.p99_spread_ms = spreads_ms[spreads_ms.size() * 99 / 100];
  return summary;
}

std::vector<std::string> TroublesOf(const CameraRun& run, const std::vector<BusLoad>& loads) {
  if (!run.error.empty()) return {run.error};
  std::vector<std::string> troubles = run.facts.remarks;
  if (run.times_lost > 0) {
    troubles.push_back(
        fmt::format("was lost {}: check its cable and power",
                    run.times_lost == 1 ? "once" : fmt::format("{} times", run.times_lost)));
  }
  if (run.IsSilent()) {
    if (run.waits_for.empty()) {
      troubles.push_back("delivers no frames: if it waits for a trigger, check that there is one");
    }
    return troubles;
  }
  if (run.torn > 0) {
    troubles.push_back(fmt::format("{} arrived damaged: {}", Counted(run.torn, "frame"),
                                   run.facts.damage.empty()
                                       ? "try another cable, or a socket without a hub"
                                       : run.facts.damage));
  }
  // The missing frames are from the outage.
  if (run.times_lost > 0) return troubles;
  const std::int64_t missed = run.MissedFrames();
  const double taken = static_cast<double>(run.times_ns.size()) + static_cast<double>(missed);
  if (static_cast<double>(missed) > kMostMissedFrames * taken) {
    troubles.push_back(fmt::format("{} of {:.0f} frames were lost: {}", missed, taken,
                                   WhyMissed(FindLoad(loads, run))));
  }
  if (run.TakenFps() < kFullRate * AskedFps(run)) {
    troubles.push_back(
        fmt::format("takes {:.1f} frames a second instead of {:g}, as cameras do in the dark: set "
                    "exposure_us below {:.0f}; if it is already, lower fps or size_px",
                    run.TakenFps(), AskedFps(run), 1e6 / AskedFps(run)));
  }
  return troubles;
}

std::vector<std::string> TriggerTroublesOf(const std::vector<CameraRun>& runs) {
  std::vector<std::string> troubles;
  for (const CameraRun& master : runs) {
    std::vector<std::string> silent;
    for (const CameraRun& run : runs) {
      const bool waits = run.waits_for == master.name && run.error.empty() && run.IsSilent();
      if (waits) silent.push_back(run.name);
    }
    if (silent.empty()) continue;
    troubles.push_back(
        master.IsSilent()
            ? fmt::format("waiting for the trigger of {}, which delivers no frames: {}",
                          master.name, fmt::join(silent, ", "))
            : fmt::format("no trigger from {} reaches {}: check the wire, the strobe of {} and "
                          "their trigger",
                          master.name, fmt::join(silent, ", "), master.name));
  }
  return troubles;
}

std::vector<std::string> TroublesOf(const BusLoad& load) {
  if (load.share() <= kUsableLink || load.cameras.size() < 2) return {};
  return {fmt::format("{} carries {:.0f} of {:.0f} Mbit/s: move one of {} to another controller",
                      load.bus, load.used_mbit_s, load.link_mbit_s, fmt::join(load.cameras, ", "))};
}

std::vector<std::string> TroublesOf(const SetSummary& sets, const std::vector<CameraRun>& runs) {
  std::vector<std::string> troubles;
  if (sets.sets == 0) return troubles;
  double fps = 0;
  for (const CameraRun& run : runs) fps = std::max(fps, AskedFps(run));
  if (sets.median_spread_ms > kInStep * 1000 / fps) {
    troubles.push_back(
        fmt::format("the cameras are not synchronized, {:.1f} ms apart: fast movements blur; "
                    "trigger them by hardware",
                    sets.median_spread_ms));
  }
  if (sets.complete < (1 - kMostIncomplete) * sets.sets && !IsExplained(runs)) {
    troubles.push_back(fmt::format("{} of {} sets lack a camera: give all the same fps",
                                   sets.sets - sets.complete, sets.sets));
  }
  return troubles;
}

}  // namespace mocap
