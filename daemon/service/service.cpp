#include "daemon/service/service.h"

#include <malloc.h>
#include <signal.h>
#include <spdlog/sinks/rotating_file_sink.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "config/load_config.h"
#include "config/open_studio.h"
#include "core/errors.h"
#include "daemon/control/control_socket.h"
#include "daemon/control/live_config.h"
#include "daemon/control/service_control.h"
#include "daemon/messages/pose_publisher.h"
#include "daemon/pipeline/frame_progress.h"
#include "daemon/pipeline/pipeline.h"
#include "daemon/pipeline/realtime.h"
#include "daemon/recording/cut_off_takes.h"
#include "daemon/recording/disk_space.h"
#include "daemon/recording/recorder.h"
#include "daemon/service/change_log.h"
#include "daemon/service/light_watch.h"
#include "daemon/service/live_view.h"
#include "daemon/service/metrics_file.h"
#include "daemon/service/printable_log.h"
#include "daemon/service/service_folders.h"
#include "daemon/service/service_manager.h"
#include "daemon/service/service_setup.h"
#include "daemon/service/status_window.h"
#include "drivers/clock.h"
#include "drivers/printable_text.h"

namespace mocap {
namespace {

constexpr std::int64_t kTickNs = 200'000'000;
constexpr double kStatusHz = 1;
constexpr double kMetricsHz = 0.2;
constexpr std::size_t kLogBytes = 4'000'000;
constexpr std::size_t kLogFiles = 4;

sigset_t HeldSignals() {
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&signals, signal);
  return signals;
}

/// Sleeps for a tick. @return the signal that came, or -1.
int WaitForSignal() {
  const sigset_t signals = HeldSignals();
  const timespec tick{0, kTickNs};
  return sigtimedwait(&signals, nullptr, &tick);
}

/// Large blocks go back to the system when they are freed. By default glibc takes the first of them
/// for a sign to keep such blocks in the heap, where a small one behind them holds their memory for
/// ever: pictures of the empty studio and the frames of recordings come and go for days. So does
/// what lies free at the end of a heap, of which each thread that codes a recording has its own.
void ReturnLargeBlocks() {
  constexpr int kLarge = 768 << 10;
  constexpr int kMostFreeAtTheEnd = 128 << 10;
  mallopt(M_MMAP_THRESHOLD, kLarge);
  mallopt(M_TRIM_THRESHOLD, kMostFreeAtTheEnd);
}

/// To standard error, which is the journal under systemd, and to a file where there is a place.
void OpenLog() {
  std::vector<spdlog::sink_ptr> sinks = {std::make_shared<spdlog::sinks::stderr_color_sink_mt>()};
  sinks[0]->set_formatter(PrintableLogFormat("%n: %^%l%$: %*"));
  if (const std::filesystem::path folder = LogsFolder(); !folder.empty()) {
    sinks.push_back(std::make_shared<spdlog::sinks::rotating_file_sink_mt>(folder / "mocapd.log",
                                                                           kLogBytes, kLogFiles));
    sinks[1]->set_formatter(PrintableLogFormat("%Y-%m-%d %T.%e %l: %*"));
  }
  auto logger = std::make_shared<spdlog::logger>("mocapd", sinks.begin(), sinks.end());
  logger->flush_on(spdlog::level::info);
  spdlog::set_default_logger(std::move(logger));
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

/// The main thread's part while the pipeline runs: status, log, systemd, the line on the terminal.
class Watch {
 public:
  Watch(const ServiceParts& parts, ServiceControl& control, ServiceManager& manager,
        ServiceReport about)
      : parts_(parts), control_(control), manager_(manager), report_(std::move(about)) {
    report_.cut_off = FindCutOffTakes(TakesFolder(control_.config().service.recording));
    for (const CutOffTake& take : report_.cut_off) {
      spdlog::warn("{} was cut off after {:.1f} s; it opens as it is", take.folder.c_str(),
                   static_cast<double>(take.duration_ns) / 1e9);
    }
    control_.SetReport(report_);
  }

  void Tick() {
    const PipelineStatus status = parts_.pipeline.Status();
    ClearLine();
    log_.Add(status);
    if (status_pacer_.IsDue(SteadyNs())) Report(status);
    if (status.sets_tracked > 0 && !manager_.is_ready()) {
      spdlog::info("poses flow");
      manager_.Ready();
    }
    if (progress_.HasMoved(parts_.pipeline.Progress())) manager_.FeedWatchdog();
    if (on_terminal_) {
      std::printf("%s", parts_.view.Line(report_.now).c_str());
      std::fflush(stdout);
    }
  }

  void Reload() {
    manager_.BeginReload();
    try {
      control_.Reload();
    } catch (const SetupError& error) {
      spdlog::error("the configuration stays as it was: {}", error.what());
    }
    manager_.EndReload();
  }

  /// Says what has come of it all.
  void Conclude() {
    Tick();
    ClearLine();
    const PipelineStatus status = parts_.pipeline.Status();
    const LatencyHistogram& latency = status.stages[Stage::kLatency];
    spdlog::info(
        "{}, {} of them without some camera, {} dropped; latency {:.0f} ms, 99 % below {:.0f} "
        "ms",
        Counted(status.sets_tracked, "set"), status.sets_partial, status.sets_dropped,
        latency.PercentileMs(0.5), latency.PercentileMs(0.99));
  }

 private:
  void Report(const PipelineStatus& status) {
    report_.now = window_.Add(status, SteadyNs());
    report_.fit = parts_.view.fit();
    report_.recording = parts_.recorder.Status();
    report_.up_ns = SteadyNs() - start_ns_;
    report_.epoch_s = EpochS();
    LookAtStudio(status);
    LookAtDisk();
    parts_.publisher.PublishStatus(report_);
    control_.SetReport(report_);
    manager_.Say(ReportLine(report_));
    const std::filesystem::path metrics = control_.config().service.metrics.file;
    if (metrics.empty() || !metrics_pacer_.IsDue(SteadyNs())) return;
    const bool could_write = WriteMetrics(metrics, report_);
    if (could_write_metrics_ && !could_write)
      spdlog::warn("{}: cannot be written", metrics.c_str());
    could_write_metrics_ = could_write;
  }

  void LookAtStudio(const PipelineStatus& status) {
    report_.background = BackgroundOf(control_.config());
    const std::optional<LightChange> change = light_.Add(status, SteadyNs());
    const bool is_new =
        change && (!report_.light_change || change->time_ns != report_.light_change->time_ns);
    report_.light_change = change;
    if (!is_new) return;
    spdlog::warn("the light changed all of a sudden, by {:+.0f} % in {}",
                 100 * (change->factor - 1), change->cameras.front());
  }

  void LookAtDisk() {
    const RecordingConfig recording = control_.config().service.recording;
    report_.takes = TakesFolder(recording);
    report_.keep_free_mb = recording.keep_free_mb;
    report_.bytes_free = BytesFree(report_.takes);
    std::erase_if(report_.cut_off,
                  [](const CutOffTake& take) { return !std::filesystem::exists(take.folder); });
  }

  void ClearLine() const {
    if (on_terminal_) std::printf("\r\x1b[K");
    std::fflush(stdout);
  }

  const ServiceParts parts_;
  ServiceControl& control_;
  ServiceManager& manager_;
  ServiceReport report_;
  const std::int64_t start_ns_ = SteadyNs();
  const bool on_terminal_ = isatty(STDOUT_FILENO) == 1;
  bool could_write_metrics_ = true;
  ProgressWatch progress_;
  ChangeLog log_;
  StatusWindow window_;
  LightWatch light_;
  Pacer status_pacer_{kStatusHz};
  Pacer metrics_pacer_{kMetricsHz};
};

/// Runs until there is nothing more to do.
void RunUntilStopped(Pipeline& pipeline, Watch& watch, std::optional<double> seconds) {
  const std::int64_t end_ns = seconds ? SteadyNs() + std::llround(*seconds * 1e9)
                                      : std::numeric_limits<std::int64_t>::max();
  while (!pipeline.finished() && SteadyNs() < end_ns) {
    const int signal = WaitForSignal();
    if (signal == SIGINT || signal == SIGTERM) return;
    if (signal == SIGHUP) watch.Reload();
    watch.Tick();
  }
}

}  // namespace

void HoldSignals() {
  const sigset_t signals = HeldSignals();
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
}

void CheckConfig(const Config& config) {
  LoadBodyTable(config.body);
  OpenStudio(config);
}

void RunService(const std::optional<std::filesystem::path>& file, std::optional<double> seconds) {
  ReturnLargeBlocks();
  LiveConfig live(file);
  const Config config = live.config();
  OpenLog();
  PrepareRealtime(config.service.realtime);
  const std::unique_ptr<lcm::LCM> lcm = OpenLcm(config.lcm.url);
  Studio studio = OpenStudio(config);
  ServiceManager manager;
  manager.Say("learning the empty studio");
  spdlog::info("learning the empty studio: {}, {}", studio.name,
               Counted(studio.cameras.size(), "camera"));
  for (const std::string& remark : studio.remarks) spdlog::warn("{}", remark);
  const ServiceReport about = ReportAbout(config, studio);
  const LearningPlace learning = LearningPlaceFor(config, studio);
  PosePublisher publisher(*lcm, config.lcm, static_cast<int>(studio.cameras.size()));
  KnownBackgrounds known = KnownBackgroundsOf(studio);
  Recorder recorder(RecordedStudioOf(studio, known, live.text()));
  publisher.Tap(recorder.taps().messages);
  LiveView view(TruthFor(config.source));
  Outlet outlet(publisher, view);
  std::deque<FrameTap> learning_taps(studio.cameras.size());
  Pipeline pipeline(std::move(studio),
                    PipelineOptionsFor(config, {&recorder.taps().frames, &learning_taps}),
                    LoadBodyTable(config.body), outlet);
  BackgroundLearner learner(pipeline, learning_taps, known, learning);
  const ServiceParts parts{live, pipeline, publisher, view, recorder, learner};
  ServiceControl control(parts, Subjects(StateFolder() / "subjects"));
  Watch watch(parts, control, manager, about);
  std::optional<ControlServer> server;
  if (const auto socket = ControlSocketOf(config.service.control.socket); !socket.empty()) {
    server.emplace(socket, [&control](const ControlRequest& r) { return control.Answer(r); });
  }
  spdlog::info("publishing on {}", config.lcm.url);
  pipeline.Start();
  RunUntilStopped(pipeline, watch, seconds);
  manager.Stopping();
  learner.RequestStop();
  server.reset();
  if (recorder.Status().state == RecordingStatus::State::kRunning) recorder.Stop();
  pipeline.RequestStop();
  pipeline.Join();
  watch.Conclude();
}

}  // namespace mocap
