#include "daemon/service/service.h"

#include <malloc.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <utility>

#include "config/open_studio.h"
#include "daemon/base/free_memory.h"
#include "daemon/base/service_folders.h"
#include "daemon/control/control_socket.h"
#include "daemon/messages/channel_watch.h"
#include "daemon/messages/client_listener.h"
#include "daemon/messages/look_publisher.h"
#include "daemon/messages/pose_publisher.h"
#include "daemon/messages/preview_publisher.h"
#include "daemon/nodes/node_listener.h"
#include "daemon/nodes/silhouette_sender.h"
#include "daemon/nodes/studio_listener.h"
#include "daemon/pipeline/node_path.h"
#include "daemon/pipeline/pipeline.h"
#include "daemon/recording/recorder.h"
#include "daemon/service/live_config.h"
#include "daemon/service/live_view.h"
#include "daemon/service/service_control.h"
#include "daemon/service/service_log.h"
#include "daemon/service/service_manager.h"
#include "daemon/service/service_setup.h"
#include "daemon/service/stop_signals.h"
#include "daemon/service/watch.h"
#include "drivers/clock.h"
#include "drivers/printable_text.h"

namespace mocap {
namespace {

constexpr std::chrono::milliseconds kTick{200};
/// Time limits for shutdown: waiting only for cameras, and completing a take. systemd waits a
/// little longer.
constexpr std::chrono::seconds kEndPatience{5};
constexpr std::chrono::seconds kTakePatience{15};
constexpr std::chrono::seconds kGrace{5};
/// Write rate of the slowest acceptable disk, per second.
constexpr double kSlowDisk_mb = 20;

/// Makes glibc return large blocks to the system when they are freed. By default, it keeps such
/// blocks in the heap after the first is freed, where a small block behind them pins their memory
/// for ever. Backgrounds and recorded frames come and go for days. The same applies to free memory
/// at the end of a heap; each coding thread has its own heap.
void ReturnLargeBlocks() {
  constexpr int kLarge = 768 << 10;
  constexpr int kMostFreeAtTheEnd = 128 << 10;
  mallopt(M_MMAP_THRESHOLD, kLarge);
  mallopt(M_TRIM_THRESHOLD, kMostFreeAtTheEnd);
}

/// Passes tracked sets to all recipients.
class Outlet : public PoseSink {
 public:
  Outlet(PosePublisher& publisher, LiveView& view, PreviewPublisher& preview, LookPublisher& looks)
      : publisher_(publisher), view_(view), preview_(preview), looks_(looks) {}
  void OnSet(const TrackedSet& set) override {
    publisher_.OnSet(set);
    view_.OnSet(set);
    preview_.OnSet(set);
    looks_.OnSet(set);
  }

 private:
  PosePublisher& publisher_;
  LiveView& view_;
  PreviewPublisher& preview_;
  LookPublisher& looks_;
};

/// Answers from the start; the object that handles requests comes later.
class ControlDesk {
 public:
  explicit ControlDesk(const std::filesystem::path& socket) {
    if (socket.empty()) return;
    server_ = std::make_unique<ControlServer>(
        socket, [this](const ControlRequest& request) { return Answer(request); });
  }
  void Open(ServiceControl& control) { control_.store(&control); }
  /// Waits for the request in progress. @pre  the object given to Open still exists.
  void Close() { server_.reset(); }

 private:
  ControlReply Answer(const ControlRequest& request) const {
    ServiceControl* control = control_.load();
    if (control) return control->Answer(request);
    throw std::runtime_error(
        "mocapd is starting: it opens its cameras and learns the background; ask "
        "again");
  }

  std::atomic<ServiceControl*> control_{nullptr};
  std::unique_ptr<ControlServer> server_;
};

/// Closes the desk before its target is destroyed, also on an exception.
class OpenDesk {
 public:
  OpenDesk(ControlDesk& desk, ServiceControl& control) : desk_(desk) { desk_.Open(control); }
  ~OpenDesk() { desk_.Close(); }
  OpenDesk(const OpenDesk&) = delete;
  OpenDesk& operator=(const OpenDesk&) = delete;

 private:
  ControlDesk& desk_;
};

/// Time limit for completing a take, here and at nodes.
std::chrono::seconds TakePatience(const Config& config) {
  const double buffer_mb = config.service.recording.buffer_mb;
  const auto here = kTakePatience + std::chrono::seconds(std::lround(buffer_mb / kSlowDisk_mb));
  return config.nodes.empty() ? here : std::max(here, ServiceControl::kNodePatience);
}

/// A node's own statuses use a separate prefix, so that they do not pass for the studio's.
LcmConfig OwnChannels(const Config& config) {
  LcmConfig lcm = config.lcm;
  if (config.role == Role::kNode) lcm.prefix += config.node.name + "_";
  return lcm;
}

std::vector<std::string> NamesOf(const std::vector<CameraCalibration>& cameras) {
  std::vector<std::string> names;
  for (const CameraCalibration& camera : cameras) names.push_back(camera.name);
  return names;
}

/// Runs until there is nothing left to do.
/// @return  why it ends.
std::string RunUntilStopped(FramePath& path, Watch& watch, StopSignals& signals,
                            std::optional<double> seconds) {
  const std::int64_t end_ns = seconds ? SteadyNs() + std::llround(*seconds * 1e9)
                                      : std::numeric_limits<std::int64_t>::max();
  while (!path.finished() && SteadyNs() < end_ns) {
    signals.Wait(kTick);
    if (signals.stop().load()) return "on a signal";
    if (signals.TakeReload()) watch.Reload();
    watch.Tick();
  }
  return path.finished() ? "at the end of the source" : "after the time of --seconds";
}

/// Who gets what is captured: clients on LCM, recordings and viewers.
struct Recipients {
  Recipients(const Config& config, const PreparedService& prepared, const std::string& config_text)
      : lcm(OwnChannels(config)),
        publisher(*prepared.lcm, lcm, static_cast<int>(prepared.studio.cameras.size()),
                  prepared.studio.times),
        channels(lcm, publisher.sender()),
        known(KnownBackgroundsOf(prepared.studio)),
        recorder(RecordedStudioOf(prepared.studio, known, config_text)),
        view(TruthFor(config.source)),
        cameras(CalibrationsOf(prepared.studio)) {
    publisher.Watch(channels);
    publisher.Tap(recorder.taps().messages);
    publisher.Describe(prepared.studio.name, cameras);
    if (prepared.preview_lcm) beside.emplace(*prepared.preview_lcm, LcmProvider::kMulticast);
    // Pictures of nodes go to the studio's viewers.
    preview.emplace(beside ? *beside : publisher.sender(), config.lcm, cameras,
                    prepared.studio.times);
    const std::vector<CameraCalibration> local(
        cameras.begin(),
        cameras.begin() + static_cast<std::ptrdiff_t>(prepared.studio.cameras.size()));
    looks.emplace(beside ? *beside : publisher.sender(), config.lcm, local, prepared.studio.times);
    outlet.emplace(publisher, view, *preview, *looks);
  }

  const LcmConfig lcm;
  PosePublisher publisher;
  ChannelWatch channels;
  KnownBackgrounds known;
  Recorder recorder;
  LiveView view;
  const std::vector<CameraCalibration> cameras;
  std::optional<LcmSender> beside;
  std::optional<PreviewPublisher> preview;
  std::optional<LookPublisher> looks;
  std::optional<Outlet> outlet;
};

/// What a node and its studio send each other, which is empty where all cameras are local, and what
/// clients send.
struct Partners {
  Partners(const Config& config, const Studio& studio, Recipients& recipients) {
    if (config.role == Role::kStudio) nodes.emplace(config, recipients.cameras);
    if (config.role != Role::kNode) {
      clients.emplace(
          config.lcm, recipients.cameras, studio.times, keypoints,
          recipients.recorder.taps().received, recipients.recorder.taps().keypoints,
          [&looks = *recipients.looks](const look_request_t& request) { looks.Ask(request); });
      return;
    }
    silhouettes.emplace(recipients.publisher.sender(), config, recipients.cameras);
    studio_listener.emplace(config.lcm, NamesOf(recipients.cameras), studio.person);
  }

  void Listen() {
    if (nodes) nodes->Listen();
    if (clients) clients->Listen();
    if (studio_listener) studio_listener->Listen();
  }

  KeypointInbox keypoints;
  std::optional<ClientListener> clients;          ///< Not of a node.
  std::optional<NodeListener> nodes;              ///< Of a studio.
  std::optional<SilhouetteSender> silhouettes;    ///< Of a node.
  std::optional<StudioListener> studio_listener;  ///< Of a node.
};

/// What looks at the frames of each camera.
struct LearningTaps {
  explicit LearningTaps(std::size_t cameras) : background(cameras), furniture(cameras) {}

  std::deque<FrameTap> background, furniture;
};

PipelineOptions OptionsFor(const Config& config, Recipients& recipients, LearningTaps& taps,
                           Partners& partners, const StopSignals& signals) {
  PipelineOptions options =
      PipelineOptionsFor(config, {&recipients.recorder.taps().frames, &taps.background,
                                  &taps.furniture, &recipients.looks->taps()});
  options.previews = &recipients.preview->taps();
  options.keypoints = &partners.keypoints;
  options.stop = &signals.stop();
  if (partners.nodes) {
    options.elsewhere = [&partners](const auto& camera, int rays) {
      return partners.nodes->Open(camera, rays);
    };
  }
  return options;
}

void Announce(const Studio& studio, ServiceManager& manager) {
  manager.Say("learning the empty studio");
  spdlog::info("learning the background: {}, {}", studio.name,
               Counted(studio.cameras.size(), "camera"));
  for (const std::string& remark : studio.remarks) spdlog::warn("{}", remark);
}

template <typename T>
T* PointerTo(std::optional<T>& part) {
  return part ? &*part : nullptr;
}

/// Completes the take that is being recorded, and stops all threads.
void Finish(const ServiceParts& parts, ServiceControl& control, ControlDesk& desk,
            ServiceManager& manager, StopSignals& signals) {
  const std::chrono::seconds patience = TakePatience(control.config());
  const auto allow = [&](bool has_take) {
    signals.Allow(has_take ? patience : kEndPatience, has_take);
  };
  allow(control.IsRecording());
  manager.Stopping(patience + kGrace);
  parts.background.RequestStop();
  parts.occupied.RequestStop();
  // A recording may be starting or ending.
  desk.Close();
  allow(control.IsRecording());
  if (control.IsRecording()) control.EndRecording();
  allow(false);
  parts.path.RequestStop();
  parts.path.Join();
}

void Run(LiveConfig& live, const ServiceLog& log, StopSignals& signals,
         std::optional<double> seconds) {
  const Config config = live.config();
  // Whoever asks while cameras are opened hears that mocapd is starting.
  ControlDesk desk(ControlPlaceOf(config));
  PreparedService prepared = PrepareService(config);
  Studio& studio = prepared.studio;
  ServiceManager manager;
  Announce(studio, manager);
  const ServiceReport about = ReportAbout(config, studio);
  const LearningPlace learning = LearningPlaceFor(config, studio);
  Recipients to(config, prepared, live.text());
  LearningTaps taps(studio.cameras.size());
  Partners partners(config, studio, to);
  const PipelineOptions options = OptionsFor(config, to, taps, partners, signals);
  std::unique_ptr<FramePath> path;
  Pipeline* pipeline = nullptr;
  if (partners.silhouettes) {
    path = std::make_unique<NodePath>(std::move(studio), options, *partners.silhouettes);
  } else {
    auto tracking =
        std::make_unique<Pipeline>(std::move(studio), options, prepared.body, *to.outlet);
    pipeline = tracking.get();
    path = std::move(tracking);
  }
  BackgroundLearner learner(*path, taps.background, to.known, learning);
  OccupiedLearner occupied(*path, taps.background, to.known, learning);
  const ServiceParts parts{live,    *path,       pipeline, to.publisher, *to.preview,
                           to.view, to.recorder, learner,  occupied};
  ServiceControl control(parts, Subjects(StateFolder() / "subjects"));
  FurnitureLooks furniture(*path, taps.furniture, to.known, learning.cameras);
  Watch watch(
      parts,
      {control, manager, to.channels, log, furniture, partners.keypoints, PointerTo(partners.nodes),
       PointerTo(partners.silhouettes), PointerTo(partners.studio_listener)},
      about);
  const OpenDesk open_desk(desk, control);
  spdlog::info("publishing on {}", config.lcm.url);
  signals.Allow(kEndPatience, false);
  partners.Listen();
  // Learning the background has taken much.
  GiveBackFreeMemory();
  path->Start();
  spdlog::info("stopping {}", RunUntilStopped(*path, watch, signals, seconds));
  Finish(parts, control, desk, manager, signals);
  watch.Conclude();
}

}  // namespace

void RunService(const std::optional<std::filesystem::path>& file, std::optional<double> seconds) {
  ReturnLargeBlocks();
  StopSignals signals;
  LiveConfig live(file);
  const ServiceLog log;
  try {
    Run(live, log, signals, seconds);
  } catch (const LearningStopped&) {
    spdlog::info("stopped while starting");
  }
}

}  // namespace mocap
