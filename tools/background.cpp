#include "tools/background.h"

#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <future>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "config/camera_files.h"
#include "config/load_config.h"
#include "core/errors.h"
#include "core/reconstruction/background/change_meter.h"
#include "daemon/base/number_option.h"
#include "drivers/printable_text.h"
#include "drivers/take/unfinished_folder.h"
#include "tools/background_recorder.h"
#include "tools/control.h"
#include "tools/stop_on_signals.h"

namespace mocap {
namespace {

struct LearnOptions {
  std::filesystem::path config;
  std::filesystem::path socket;
  bool anyway = false;
  double seconds = 4;
};

/// Records all cameras at the same time. If several fail, the first camera's error is thrown.
std::vector<BackgroundRecord> RecordAll(std::vector<LiveCamera>& cameras,
                                        const std::filesystem::path& folder, double seconds) {
  std::vector<std::future<BackgroundRecord>> recordings;
  for (LiveCamera& camera : cameras) {
    recordings.push_back(std::async(std::launch::async, [&camera, &folder, seconds] {
      return RecordBackground(camera, folder, seconds);
    }));
  }
  std::vector<BackgroundRecord> records;
  for (auto& recording : recordings) records.push_back(recording.get());
  return records;
}

void RequireStillRoom(const std::vector<LiveCamera>& cameras,
                      const std::vector<BackgroundRecord>& records) {
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    if (records[i].changed <= kMostChange) continue;
    std::ostringstream text;
    text.precision(2);
    text << cameras[i].name << ": " << 100 * records[i].changed
         << " % of its picture changed meanwhile; check that nobody is in the room and that its "
            "exposure is fixed. The previous background is kept";
    throw std::runtime_error(text.str());
  }
}

void Learn(const LearnOptions& options) {
  StopOnSignals();
  const Config config = LoadConfig(options.config);
  std::vector<LiveCamera> cameras = OpenLiveCameras(config);
  const std::filesystem::path partial = BeginBackground(config.background);
  UnfinishedFolder unfinished(partial);
  if (isatty(STDERR_FILENO)) {
    std::fprintf(stderr, "recording the background for %g s\n", options.seconds);
  }
  const std::vector<BackgroundRecord> records = RecordAll(cameras, partial, options.seconds);
  RequireStillRoom(cameras, records);
  ReplaceBackground(config.background, partial);
  unfinished.Finish();
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    std::printf("%s: %s\n", cameras[i].name.c_str(), Counted(records[i].frames, "frame").c_str());
  }
}

}  // namespace

void AddBackgroundCommand(CLI::App& app) {
  CLI::App* background =
      app.add_subcommand("background", "Learn the background or show its status");
  background->require_subcommand(1);
  CLI::App* learn = background->add_subcommand(
      "learn", "Learn the background from the empty studio; nobody may be in view");
  auto options = std::make_shared<LearnOptions>();
  auto* config =
      learn->add_option("--config", options->config,
                        "mocapd configuration file in TOML: learn from its cameras while no mocapd "
                        "uses them (default: the running mocapd learns)");
  learn
      ->add_option("--seconds", options->seconds,
                   "recording time of cameras without a pan-tilt head [s]")
      ->check(NumberFrom(1, 600))
      ->capture_default_str()
      ->needs(config);
  learn
      ->add_flag("--anyway", options->anyway,
                 "learn even if a person is tracked, such as a chair that is taken for one")
      ->excludes(config);
  CLI::App* status = background->add_subcommand(
      "status", "Show the age of the background and the light in which it is valid");
  for (CLI::App* command : {learn, status}) {
    command->add_option("--socket", options->socket,
                        "mocapd control socket (default: the system's, else the user's own)");
  }
  learn->callback([options] {
    if (!options->config.empty()) return Learn(*options);
    AskAndPrint(options->socket, options->anyway ? "background learn anyway" : "background learn");
  });
  status->callback([options] { AskAndPrint(options->socket, "background status"); });
}

}  // namespace mocap
