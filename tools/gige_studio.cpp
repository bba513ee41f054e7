#include "tools/gige_studio.h"

#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <new>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "config/open_studio.h"
#include "core/errors.h"
#include "daemon/base/number_option.h"
#include "drivers/simulation/simulated_studio.h"
#include "drivers/take/take_layout.h"
#include "drivers/take/text_file.h"
#include "drivers/take/toml_text.h"
#include "drivers/take/video_reader.h"
#include "tools/gige/gige_camera.h"
#include "tools/gige/loopback.h"
#include "tools/gige/own_config.h"
#include "tools/gige/studio_source.h"

namespace mocap {
namespace {

using std::chrono::steady_clock;

struct StudioOptions {
  std::filesystem::path take;  ///< Empty: the simulated studio.
  SimulatedStudioOptions simulation{.realtime = true};
  std::string first_ip = "127.0.0.11";
  bool has_ptp = false;
  GigeFaults faults;
  double return_after_s = 2;
  std::filesystem::path config;
};

/// Report to the parent process.
struct StudioPlan {
  std::vector<std::string> names, ips;
  double fps = 30;
};

std::string SerialOf(int camera) { return "MOCAP" + std::to_string(camera + 1); }

StudioPlan PlanFor(const StudioOptions& options) {
  StudioPlan plan;
  if (options.take.empty()) {
    for (const CameraCalibration& camera : SimulatedStudio(options.simulation).cameras()) {
      plan.names.push_back(camera.name);
    }
    plan.fps = options.simulation.fps;
  } else {
    const Studio studio = OpenTake(options.take, {});
    for (const StudioCamera& camera : studio.cameras) plan.names.push_back(camera.calibration.name);
    plan.fps = studio.fps_nominal;
  }
  if (plan.names.size() > StudioStage::kMostCameras) {
    throw SetupError(options.take.string() + ": has more than " +
                     std::to_string(StudioStage::kMostCameras) + " cameras");
  }
  for (std::size_t i = 0; i < plan.names.size(); ++i) {
    plan.ips.push_back(AddressAfter(options.first_ip, static_cast<int>(i)));
    if (!EnsureLoopbackAddress(plan.ips.back())) {
      throw SetupError(plan.ips.back() + ": is not an address of this host; as root, ip addr add " +
                       plan.ips.back() + "/8 dev lo");
    }
    if (IsServed(plan.ips.back())) {
      throw SetupError(plan.ips.back() +
                       ": a camera is served there already; end that program, or choose another "
                       "--address");
    }
  }
  return plan;
}

/// A picture of the empty studio.
Image<Bgr> EmptyStudio(const std::filesystem::path& take, const std::string& camera) {
  const std::filesystem::path file = TakeLayout{take}.BackgroundVideo(camera);
  VideoReader video(file);
  ImageView<const Bgr> view;
  if (video.Read(view) != VideoStatus::kFrame) throw SetupError(file.string() + ": has no picture");
  Image<Bgr> image(view.width(), view.height());
  for (int y = 0; y < view.height(); ++y) std::copy_n(view.row(y), view.width(), image.row(y));
  return image;
}

/// Opens the source of one served camera.
std::unique_ptr<CameraDriver> OpenSource(const StudioOptions& options, const StudioPlan& plan,
                                         int camera, StudioStage& stage,
                                         std::function<bool()> is_streaming) {
  if (options.take.empty()) return SimulatedStudio(options.simulation).OpenCamera(camera);
  // The whole take, since the cameras share a timeline.
  Studio studio =
      OpenTake(options.take,
               {.rate = ReplayRate::kRealtime, .loop = true, .cameras = {}, .begin_ns = [&stage] {
                  return stage.begin_ns.load();
                }});
  return std::make_unique<StudioSource>(stage, camera, static_cast<int>(plan.names.size()),
                                        plan.fps, EmptyStudio(options.take, plan.names[camera]),
                                        std::move(studio.cameras[camera].driver),
                                        std::move(is_streaming));
}

/// Main function of a camera's process.
[[noreturn]] void ServeCamera(const StudioOptions& options, const StudioPlan& plan, int camera,
                              StudioStage& stage) {
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGTERM);
  sigaddset(&signals, SIGINT);
  sigprocmask(SIG_UNBLOCK, &signals, nullptr);
  try {
    std::atomic<GigeCamera*> served{nullptr};
    auto source = OpenSource(options, plan, camera, stage, [&served] {
      const GigeCamera* gige = served.load();
      return gige && gige->is_streaming();
    });
    GigeFaults faults = options.faults;
    faults.seed += camera;
    GigeCamera gige({.ip = plan.ips[camera],
                     .name = plan.names[camera],
                     .serial = SerialOf(camera),
                     .has_ptp = options.has_ptp},
                    std::move(source), faults);
    served.store(&gige);
    std::printf("%s at %s, serial number %s, process %d\n", plan.names[camera].c_str(),
                plan.ips[camera].c_str(), SerialOf(camera).c_str(), getpid());
    std::fflush(stdout);
    while (true) pause();
  } catch (const SetupError& error) {
    std::fprintf(stderr, "mocap: %s\n", error.what());
    std::_Exit(2);
  }
}

/// The cameras' processes and their state.
class Cast {
 public:
  Cast(const StudioOptions& options, const StudioPlan& plan)
      : options_(options), plan_(plan), members_(plan.names.size()) {
    void* shared = mmap(nullptr, sizeof(StudioStage), PROT_READ | PROT_WRITE,
                        MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    MOCAP_CHECK(shared != MAP_FAILED);
    stage_ = new (shared) StudioStage;
    for (std::size_t i = 0; i < members_.size(); ++i) Begin(i);
  }
  ~Cast() {
    for (const Member& member : members_) {
      if (member.process > 0) kill(member.process, SIGTERM);
    }
    while (wait(nullptr) > 0) {
    }
    munmap(stage_, sizeof(StudioStage));
  }
  Cast(const Cast&) = delete;
  Cast& operator=(const Cast&) = delete;

  /// Detects processes that ended, and restarts them when due.
  void Tick() {
    int status = 0;
    for (pid_t gone = 0; (gone = waitpid(-1, &status, WNOHANG)) > 0;) NoteDeath(gone, status);
    for (std::size_t i = 0; i < members_.size(); ++i) {
      if (members_[i].process == 0 && steady_clock::now() >= members_[i].returns) Begin(i);
    }
    if (!told_ && stage_->begin_ns.load() > 0) {
      told_ = true;
      std::printf("all cameras stream; the take begins at %.6f s since the epoch; Ctrl-C ends it\n",
                  static_cast<double>(stage_->begin_ns.load()) * 1e-9);
      std::fflush(stdout);
    }
  }

 private:
  struct Member {
    pid_t process = 0;
    steady_clock::time_point returns;
  };

  void Begin(std::size_t i) {
    std::fflush(nullptr);
    const pid_t process = fork();
    MOCAP_CHECK(process >= 0);
    if (process == 0) ServeCamera(options_, plan_, static_cast<int>(i), *stage_);
    members_[i].process = process;
  }

  void NoteDeath(pid_t gone, int status) {
    for (std::size_t i = 0; i < members_.size(); ++i) {
      if (members_[i].process != gone) continue;
      if (WIFEXITED(status)) throw SetupError(plan_.names[i] + ": could not be served");
      members_[i].process = 0;
      members_[i].returns =
          steady_clock::now() + std::chrono::duration_cast<steady_clock::duration>(
                                    std::chrono::duration<double>(options_.return_after_s));
      std::printf("%s is gone and returns in %g s\n", plan_.names[i].c_str(),
                  options_.return_after_s);
      std::fflush(stdout);
    }
  }

  const StudioOptions& options_;
  const StudioPlan& plan_;
  StudioStage* stage_ = nullptr;
  std::vector<Member> members_;
  bool told_ = false;
};

/// Writes a configuration for mocapd to use the served studio.
void WriteConfig(const StudioOptions& options, const StudioPlan& plan) {
  std::ostringstream out;
  const std::filesystem::path take = std::filesystem::absolute(options.take);
  if (!options.take.empty()) {
    out << "calibration = " << TomlText((take / "calibration.toml").string()) << "\n"
        << "background = " << TomlText((take / "background").string()) << "\n";
  }
  out << "\n[source]\ndriver = \"aravis\"\nfps = " << plan.fps << "\n";
  for (std::size_t i = 0; i < plan.names.size(); ++i) {
    // The loopback allows larger packets than most networks.
    out << "\n[[cameras]]\nname = \"" << plan.names[i] << "\"\ndevice = \"" << plan.ips[i]
        << "\"\nformat = \"BGR8\"\npacket_bytes = 9000\n";
  }
  ReplaceText(options.config, SignedConfig(out.str()));
}

void ServeStudio(const StudioOptions& options) {
  if (!options.config.empty()) {
    RequireOwnConfig(options.config);
    RequireWritable(options.config);
  }
  const StudioPlan plan = PlanFor(options);
  if (!options.config.empty()) WriteConfig(options, plan);
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : {SIGINT, SIGTERM, SIGCHLD}) sigaddset(&signals, signal);
  sigprocmask(SIG_BLOCK, &signals, nullptr);
  Cast cast(options, plan);
  constexpr timespec kTick{0, 50'000'000};
  while (true) {
    const int signal = sigtimedwait(&signals, nullptr, &kTick);
    if (signal == SIGINT || signal == SIGTERM) return;
    cast.Tick();
  }
}

}  // namespace

void AddGigeStudioCommand(CLI::App& app) {
  const auto options = std::make_shared<StudioOptions>();
  CLI::App* command = app.add_subcommand(
      "gige-studio", "Serve a take or the simulated studio as GigE Vision cameras on this host");
  command->add_option("take", options->take,
                      "take folder to serve in a loop (default: the simulated studio)");
  command->add_option("--motion", options->simulation.motion, "motion of the simulated person")
      ->capture_default_str();
  command
      ->add_option("--stature", options->simulation.stature_mm,
                   "stature of the simulated person [mm]")
      ->check(NumberFrom(1000, 2100))
      ->capture_default_str();
  command
      ->add_option("--seed", options->simulation.seed,
                   "random seed for person, clothes, room, intrinsics and path")
      ->capture_default_str();
  command
      ->add_option("--address", options->first_ip,
                   "IP address of the first camera; the others follow")
      ->capture_default_str();
  command->add_option("--config", options->config,
                      "output mocapd configuration file in TOML, for these cameras");
  command->add_flag("--ptp", options->has_ptp, "support PTP clocks (TAI) and action commands");
  command->add_option("--lost-packets", options->faults.lost_packets, "share of packets to drop")
      ->check(NumberFrom(0, 1));
  command->add_option("--jitter", options->faults.jitter_ms, "maximum random delay of a frame [ms]")
      ->check(NumberFrom(0, 10000));
  command
      ->add_option(
          "--clock-offset",
          [options](const CLI::results_t& text) {
            options->faults.clock_offset_ns = std::llround(std::stod(text.front()) * 1e9);
            return true;
          },
          "clock offset of the cameras from the host [s]")
      ->check(NumberFrom(-1e9, 1e9));
  command
      ->add_option("--clock-drift", options->faults.clock_drift_ppm,
                   "clock drift of the cameras; positive: they gain [ppm]")
      ->check(NumberFrom(-1e5, 1e5));
  command
      ->add_option("--return-after", options->return_after_s,
                   "time until a camera whose process was killed returns [s]")
      ->capture_default_str()
      ->check(NumberFrom(0, 1e6));
  command->callback([options] { ServeStudio(*options); });
}

}  // namespace mocap
