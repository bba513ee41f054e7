#include "tools/background.h"

#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <future>
#include <memory>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "config/camera_files.h"
#include "config/load_config.h"
#include "core/errors.h"
#include "core/reconstruction/background/change_meter.h"
#include "daemon/base/number_option.h"
#include "daemon/control/control_request.h"
#include "drivers/printable_text.h"
#include "drivers/take/unfinished_folder.h"
#include "tools/background_occupied.h"
#include "tools/background_recorder.h"
#include "tools/control.h"
#include "tools/stop_on_signals.h"

namespace mocap {
namespace {

struct LearnOptions {
  std::filesystem::path config;
  std::filesystem::path socket;
  bool anyway = false;
  bool is_occupied = false;
  std::filesystem::path take;
  std::optional<double> seconds;
  std::vector<std::string> accepted;
};

constexpr double kEmptySeconds = 4;

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
            "exposure is fixed, or learn with --occupied. The previous background is kept";
    throw std::runtime_error(text.str());
  }
}

void Learn(const LearnOptions& options) {
  StopOnSignals();
  const double seconds = options.seconds.value_or(kEmptySeconds);
  const Config config = LoadConfig(options.config);
  std::vector<LiveCamera> cameras = OpenLiveCameras(config);
  const std::filesystem::path partial = BeginBackground(config.background);
  UnfinishedFolder unfinished(partial);
  if (isatty(STDERR_FILENO)) {
    std::fprintf(stderr, "recording the background for %g s\n", seconds);
  }
  const std::vector<BackgroundRecord> records = RecordAll(cameras, partial, seconds);
  RequireStillRoom(cameras, records);
  ReplaceBackground(config.background, partial);
  unfinished.Finish();
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    std::printf("%s: %s\n", cameras[i].name.c_str(), Counted(records[i].frames, "frame").c_str());
  }
}

void LearnWhileOccupied(const LearnOptions& options) {
  OccupiedOptions occupied{.accepted = options.accepted};
  if (options.seconds) occupied.seconds = *options.seconds;
  if (!options.take.empty()) return LearnFromOccupiedTake(options.take, options.config, occupied);
  if (!options.config.empty()) return LearnFromOccupiedStudio(options.config, occupied);
  AskToLearn(options.socket, occupied);
}

}  // namespace

void AddBackgroundCommand(CLI::App& app) {
  CLI::App* background =
      app.add_subcommand("background", "Learn the background or show its status");
  background->require_subcommand(1);
  CLI::App* learn = background->add_subcommand(
      "learn",
      "Learn the background from the empty studio, or with --occupied from people who move "
      "about in it");
  auto options = std::make_shared<LearnOptions>();
  auto* config =
      learn->add_option("--config", options->config,
                        "mocapd configuration file in TOML: learn from its cameras while no mocapd "
                        "uses them (default: the running mocapd learns)");
  learn
      ->add_option("--seconds", options->seconds,
                   "recording time of cameras without a pan-tilt head [s] (default: 4; 60 with "
                   "--occupied); without --occupied, needs --config")
      ->check(NumberFrom(1, kLongestOccupied_s));
  auto* occupied = learn->add_flag(
      "--occupied", options->is_occupied,
      "learn while people move about: each pixel, where its wall is seen often enough");
  learn
      ->add_option("--take", options->take,
                   "take folder: learn from its pictures, and replace its background, or with "
                   "--config that of the studio which recorded it")
      ->needs(occupied);
  learn
      ->add_option("--accept", options->accepted,
                   "cameras, such as cam1,cam2, in which furniture that was moved becomes part of "
                   "the background")
      ->delimiter(',')
      ->needs(occupied);
  learn
      ->add_flag("--anyway", options->anyway,
                 "learn even if a person is tracked, such as a chair that is taken for one")
      ->excludes(config)
      ->excludes(occupied);
  CLI::App* status = background->add_subcommand(
      "status", "Show the age of the background and the light in which it is valid");
  for (CLI::App* command : {learn, status}) {
    command->add_option("--socket", options->socket,
                        "mocapd control socket (default: the system's, else the user's own)");
  }
  learn->callback([options] {
    if (options->is_occupied) return LearnWhileOccupied(*options);
    if (!options->config.empty()) return Learn(*options);
    if (options->seconds)
      throw SetupError("--seconds needs --config FILE or --occupied: the running mocapd decides");
    AskAndPrint(options->socket, options->anyway ? "background learn anyway" : "background learn");
  });
  status->callback([options] { AskAndPrint(options->socket, "background status"); });
}

}  // namespace mocap
