#include "daemon/service.h"

#include <signal.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <limits>
#include <string>

#include "config/load_config.h"
#include "config/open_studio.h"
#include "daemon/change_log.h"
#include "daemon/clock.h"
#include "daemon/live_view.h"
#include "daemon/pipeline.h"
#include "daemon/pose_publisher.h"
#include "daemon/status_window.h"
#include "daemon/truth_error.h"

namespace mocap {
namespace {

constexpr std::int64_t kTickNs = 200'000'000;
constexpr double kStatusHz = 1;

sigset_t StopSignals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  return signals;
}

/// Sleeps for a tick. @return whether a signal asked to stop.
bool WaitForStop() {
  const sigset_t signals = StopSignals();
  const timespec tick{0, kTickNs};
  return sigtimedwait(&signals, nullptr, &tick) > 0;
}

PipelineOptions OptionsFrom(const Config& config) {
  // A recording that is read as fast as it can be has old times, and can wait.
  const bool can_wait = config.source.driver == "take" && config.source.rate == ReplayRate::kFast;
  return {.segmentation = config.segmentation,
          .voxel_mm = config.voxel_mm,
          .overflow = can_wait ? Overflow::kWait : Overflow::kDropOldest,
          .latency_origin = can_wait ? LatencyOrigin::kArrival : LatencyOrigin::kCapture};
}

/// The truth is known where the person is simulated.
TruthError TruthFor(const SourceConfig& source) {
  if (source.driver != "simulated") return {};
  return SimulatedTruthError(LiveSimulation(source));
}

/// Everything that becomes of a tracked set.
class Outlet : public PoseSink {
 public:
  Outlet(PosePublisher& publisher, LiveView& view) : publisher_(publisher), view_(view) {}
  void OnSet(const TrackedSet& set) override {
    publisher_.OnSet(set);
    view_.OnSet(set);
  }

 private:
  PosePublisher& publisher_;
  LiveView& view_;
};

/// The main thread's part while the pipeline runs: status, log, the line on the terminal.
class Watch {
 public:
  Watch(Pipeline& pipeline, PosePublisher& publisher, LiveView& view)
      : pipeline_(pipeline), publisher_(publisher), view_(view) {}

  void Tick() {
    const PipelineStatus status = pipeline_.Status();
    ClearLine();
    log_.Add(status);
    if (status_pacer_.IsDue(SteadyNs())) {
      report_ = window_.Add(status, SteadyNs());
      publisher_.PublishStatus(report_);
    }
    if (on_terminal_) {
      std::printf("%s", view_.Line(report_).c_str());
      std::fflush(stdout);
    }
  }

  /// Says what has come of it all.
  void Conclude() {
    Tick();
    ClearLine();
    const PipelineStatus status = pipeline_.Status();
    const LatencyHistogram& latency = status.stages[Stage::kLatency];
    spdlog::info(
        "{} sets, {} of them without some camera, {} dropped; latency {:.0f} ms, 99 % below {:.0f} "
        "ms",
        status.sets_tracked, status.sets_partial, status.sets_dropped, latency.PercentileMs(0.5),
        latency.PercentileMs(0.99));
  }

 private:
  void ClearLine() const {
    if (on_terminal_) std::printf("\r\x1b[K");
    std::fflush(stdout);
  }

  Pipeline& pipeline_;
  PosePublisher& publisher_;
  LiveView& view_;
  const bool on_terminal_ = isatty(STDOUT_FILENO) == 1;
  ChangeLog log_;
  StatusWindow window_;
  StatusReport report_;
  Pacer status_pacer_{kStatusHz};
};

}  // namespace

void HoldSignals() {
  const sigset_t signals = StopSignals();
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
}

void CheckConfig(const Config& config) {
  LoadBodyTable(config.body);
  OpenStudio(config);
}

void RunService(const Config& config, std::optional<double> seconds) {
  spdlog::set_default_logger(spdlog::stderr_color_mt("mocapd"));
  spdlog::set_pattern("%n: %^%l%$: %v");
  const std::unique_ptr<lcm::LCM> lcm = OpenLcm(config.lcm.url);
  Studio studio = OpenStudio(config);
  spdlog::info("learning the empty studio: {}, {} cameras", studio.name, studio.cameras.size());
  PosePublisher publisher(*lcm, config.lcm, static_cast<int>(studio.cameras.size()));
  LiveView view(TruthFor(config.source));
  Outlet outlet(publisher, view);
  Pipeline pipeline(std::move(studio), OptionsFrom(config), LoadBodyTable(config.body), outlet);
  Watch watch(pipeline, publisher, view);
  const std::int64_t end_ns = seconds ? SteadyNs() + std::llround(*seconds * 1e9)
                                      : std::numeric_limits<std::int64_t>::max();
  spdlog::info("publishing on {}", config.lcm.url);
  pipeline.Start();
  while (!pipeline.finished() && SteadyNs() < end_ns && !WaitForStop()) watch.Tick();
  pipeline.RequestStop();
  pipeline.Join();
  watch.Conclude();
}

}  // namespace mocap
