#include "daemon/service/watch.h"

#include <spdlog/spdlog.h>

#include <chrono>
#include <cstdio>
#include <cstring>
#include <exception>
#include <utility>

#include "daemon/recording/cut_off_takes.h"
#include "daemon/recording/recorder.h"
#include "daemon/service/metrics_file.h"
#include "daemon/status/diagnostics.h"
#include "drivers/clock.h"
#include "drivers/printable_text.h"

namespace mocap {
namespace {

constexpr double kStatusHz = 1;
constexpr double kMetricsHz = 0.2;
/// How long the first report waits for the disk.
constexpr std::int64_t kDiskPatienceNs = 1'000'000'000;
/// How long a failed message is reported.
constexpr std::int64_t kLatelyNs = 3'000'000'000;

}  // namespace

Watch::Watch(const ServiceParts& parts, const WatchParts& around, ServiceReport about)
    : parts_(parts),
      around_(around),
      report_(std::move(about)),
      start_ns_(SteadyNs()),
      found_ns_(start_ns_),
      status_pacer_(kStatusHz),
      metrics_pacer_(kMetricsHz) {
  report_.cut_off = FindCutOffTakes(TakesFolder(around_.control.config().service.recording));
  LookAtDisk();
  disk_.WaitForFindings(kDiskPatienceNs);
  LookAtDisk();
  around_.control.SetReport(report_);
}

void Watch::Tick() {
  const PipelineStatus status = parts_.path.Status();
  ClearLine();
  log_.Add(status);
  if (status_pacer_.IsDue(SteadyNs())) Report(status);
  if (status.sets_tracked > 0 && !around_.manager.is_ready()) {
    if (parts_.publisher.sender().Status().failed == 0)
      spdlog::info("publishing {}", parts_.pipeline ? "poses" : "silhouettes");
    around_.manager.Ready();
  }
  if (around_.silhouettes) around_.silhouettes->Tell(status.cameras, told_);
  if (progress_.HasMoved(parts_.path.Progress())) around_.manager.FeedWatchdog();
  if (on_terminal_) {
    std::printf("%s", parts_.view.Line(report_.now).c_str());
    std::fflush(stdout);
  }
}

void Watch::Reload() {
  const bool is_read_already =
      reload_.valid() && reload_.wait_for(std::chrono::seconds(0)) != std::future_status::ready;
  if (is_read_already) return;
  reload_ = std::async(std::launch::async, [this] {
    around_.manager.BeginReload();
    try {
      around_.control.Reload();
    } catch (const std::exception& error) {
      spdlog::error("the configuration is unchanged: {}", error.what());
    }
    around_.manager.EndReload();
  });
}

void Watch::Conclude() {
  Tick();
  ClearLine();
  const PipelineStatus status = parts_.path.Status();
  if (!status.tracks) {
    spdlog::info("{}", Counted(status.sets_tracked, "silhouette"));
    return;
  }
  const LatencyHistogram& latency = status.stages[Stage::kLatency];
  spdlog::info("{}, {} of them incomplete, {} dropped; latency {:.0f} ms, 99 % below {:.0f} ms",
               Counted(status.sets_tracked, "set"), status.sets_partial, status.sets_dropped,
               latency.PercentileMs(0.5), latency.PercentileMs(0.99));
}

void Watch::Report(const PipelineStatus& status) {
  report_.now = window_.Add(status, SteadyNs());
  report_.fit = parts_.view.fit();
  report_.people = parts_.view.people();
  report_.people_ns = SteadyNs();
  report_.recording = parts_.recorder.Status();
  report_.up_ns = SteadyNs() - start_ns_;
  report_.epoch_s = TimeOfDayS();
  report_.log_fails = around_.log.Fails(SteadyNs());
  if (around_.nodes) report_.nodes = around_.nodes->Report();
  if (around_.studio) report_.link = around_.studio->Link(SteadyNs());
  report_.keypoints = around_.keypoints.Report(SteadyNs());
  report_.moved = around_.furniture.Moved();
  LookAtClock();
  LookAtStudio(status);
  LookAtDelivery();
  LookAtDisk();
  parts_.publisher.PublishStatus(report_);
  around_.control.SetReport(report_);
  told_ = Diagnostics(report_);
  complaints_.Add(told_, SteadyNs());
  around_.manager.Say(ReportLine(report_));
}

void Watch::LookAtClock() {
  const std::string step = clock_.Add(TheHostClock().OffsetNs());
  if (!step.empty()) spdlog::warn("{}", step);
}

void Watch::LookAtStudio(const PipelineStatus& status) {
  // A hull that is none may be acquired again and again.
  const bool is_found = status.state == CaptureState::kTracking || !Tracked(report_.people).empty();
  if (is_found || status.sets_tracked == 0) found_ns_ = SteadyNs();
  report_.nobody_ns = is_found ? 0 : SteadyNs() - found_ns_;
  const std::optional<LightChange> change = light_.Add(status, SteadyNs());
  const bool is_new =
      change && (!report_.light_change || change->time_ns != report_.light_change->time_ns);
  report_.light_change = change;
  if (!is_new) return;
  spdlog::warn("the light changed suddenly, by {:+.0f} % in {}", 100 * (change->factor - 1),
               change->cameras.front());
}

void Watch::LookAtDelivery() {
  const SendStatus sent = parts_.publisher.sender().Status();
  report_.delivery.channel = around_.channels.Status();
  const bool fails = sent.failed > 0 && SteadyNs() - sent.last_failed_ns < kLatelyNs;
  report_.delivery.problem = fails ? std::strerror(sent.error) : "";
}

void Watch::LookAtDisk() {
  const Config config = around_.control.config();
  const RecordingConfig& recording = config.service.recording;
  const std::filesystem::path& metrics = config.service.metrics.file;
  report_.takes = TakesFolder(recording);
  report_.disk_stall_ns = disk_.UnderWayNs(SteadyNs());
  if (const std::optional<DiskFindings> found = disk_.Findings()) {
    report_.keep_free_mb = recording.keep_free_mb;
    report_.bytes_free = found->bytes_free;
    report_.takes_place = found->takes_place;
    report_.takes_problem = found->takes_problem;
    report_.background.made_s = found->background_made_s;
    report_.cut_off = found->cut_off;
    report_.metrics_problem = found->could_write_metrics ? "" : metrics.string();
  }
  DiskErrand errand{.takes = report_.takes,
                    .background = IsLive(config.source) ? config.background : "",
                    .cut_off = report_.cut_off,
                    .metrics = {},
                    .metrics_text = {}};
  if (!metrics.empty() && metrics_pacer_.IsDue(SteadyNs())) {
    errand.metrics = metrics;
    errand.metrics_text = MetricsText(report_);
  }
  disk_.Send(std::move(errand));
}

void Watch::ClearLine() const {
  if (on_terminal_) std::printf("\r\x1b[K");
  std::fflush(stdout);
}

}  // namespace mocap
