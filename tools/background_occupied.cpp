#include "tools/background_occupied.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <future>
#include <optional>
#include <stdexcept>
#include <thread>
#include <utility>

#include "config/camera_files.h"
#include "config/load_config.h"
#include "config/take_header.h"
#include "core/errors.h"
#include "daemon/control/control_socket.h"
#include "daemon/service/occupied_learner.h"
#include "daemon/service/occupied_room.h"
#include "drivers/printable_text.h"
#include "drivers/quoted.h"
#include "drivers/take/input_file.h"
#include "drivers/take/take_layout.h"
#include "drivers/take/unfinished_folder.h"
#include "tools/background_recorder.h"
#include "tools/stop_on_signals.h"

namespace mocap {
namespace {

/// Between questions to the daemon.
constexpr std::chrono::milliseconds kProgressPause{500};

void RequireFixed(const std::string& camera, bool is_on_head) {
  if (!is_on_head) return;
  throw SetupError(
      camera +
      ": is on a pan-tilt head, and --occupied learns fixed cameras only; learn in the "
      "empty studio, without --occupied");
}

/// Whose background is learned, and where it is stored.
struct LearnedPlace {
  std::vector<std::string> cameras;
  std::filesystem::path folder;
};

/// @throws SetupError  unless the take has all cameras of the studio.
LearnedPlace StudioOfTake(const std::filesystem::path& file,
                          const std::vector<std::string>& recorded,
                          const std::filesystem::path& take) {
  const Config config = LoadConfig(file);
  if (!IsLive(config.source))
    throw SetupError(WhereOf(config, "source.driver") + " is " + Quoted(config.source.driver) +
                     ", which has its own pictures of the empty studio; expected live cameras");
  LearnedPlace place{{}, config.background};
  for (const CameraConfig& camera : config.cameras) {
    if (std::ranges::find(recorded, camera.name) == recorded.end())
      throw SetupError(take.string() + ": has no camera " + Quoted(camera.name) + " of " +
                       file.string() + "; expected a take of all of its cameras");
    place.cameras.push_back(camera.name);
  }
  return place;
}

/// Learns one camera after the other, and replaces the folder of the background.
/// @param partial  from BeginBackground.
void LearnAll(const std::vector<std::string>& cameras,
              const std::function<BackgroundSource(const std::string&)>& pictures,
              const std::filesystem::path& folder, const std::filesystem::path& partial,
              const OccupiedOptions& options) {
  std::vector<OccupiedRecord> records;
  for (const std::string& name : cameras) {
    OccupiedRoom room{name, pictures(name), std::nullopt,
                      std::ranges::count(options.accepted, name) > 0};
    const std::filesystem::path stored = folder / (name + ".mkv");
    if (IsThere(stored)) room.stored = PicturesOf(stored, 1, EndIfStopAsked);
    if (isatty(STDERR_FILENO)) std::fprintf(stderr, "learning %s\n", name.c_str());
    records.push_back(LearnInPlace(room, partial));
  }
  ReplaceBackground(folder, partial);
  for (const OccupiedRecord& record : records) {
    for (const std::string& line : TextOf(record)) std::printf("%s\n", line.c_str());
  }
}

}  // namespace

void LearnFromOccupiedStudio(const std::filesystem::path& file, const OccupiedOptions& options) {
  StopOnSignals();
  const Config config = LoadConfig(file);
  std::vector<LiveCamera> cameras = OpenLiveCameras(config);
  std::vector<std::string> names;
  for (const LiveCamera& camera : cameras) {
    names.push_back(camera.name);
    RequireFixed(camera.name, camera.head != nullptr);
  }
  RequireAccepted(options.accepted, names);
  const std::filesystem::path partial = BeginBackground(config.background);
  UnfinishedFolder unfinished(partial);
  if (isatty(STDERR_FILENO)) std::fprintf(stderr, "recording for %g s\n", options.seconds);
  std::vector<std::future<void>> recordings;
  for (LiveCamera& camera : cameras) {
    recordings.push_back(
        std::async(std::launch::async, [&] { RecordOccupied(camera, partial, options.seconds); }));
  }
  for (std::future<void>& recording : recordings) recording.wait();
  for (std::future<void>& recording : recordings) recording.get();
  LearnAll(
      names,
      [&](const std::string& name) {
        return PicturesOf(partial / (name + ".mkv"), 1, EndIfStopAsked);
      },
      config.background, partial, options);
  unfinished.Finish();
}

void LearnFromOccupiedTake(const std::filesystem::path& take, const std::filesystem::path& config,
                           const OccupiedOptions& options) {
  StopOnSignals();
  const TakeHeader header = ReadTakeHeader(take);
  const TakeLayout layout{take};
  for (const CameraCalibration& camera : LoadCalibration(layout.Calibration()))
    RequireFixed(camera.name, camera.head.has_value());
  const LearnedPlace place = config.empty() ? LearnedPlace{header.cameras, layout.Background()}
                                            : StudioOfTake(config, header.cameras, take);
  RequireAccepted(options.accepted, place.cameras);
  const std::filesystem::path partial = BeginBackground(place.folder);
  UnfinishedFolder unfinished(partial);
  LearnAll(
      place.cameras,
      [&](const std::string& name) {
        const std::size_t frames = ReadTakeTable(layout.Table(name)).rows.size();
        const double apart = std::max(header.fps_nominal / kOccupiedFps,
                                      static_cast<double>(frames) / kMostOccupiedPictures);
        return PicturesOf(layout.Video(name), std::max(1, static_cast<int>(std::ceil(apart))),
                          EndIfStopAsked);
      },
      place.folder, partial, options);
  unfinished.Finish();
}

void AskToLearn(const std::filesystem::path& socket, const OccupiedOptions& options) {
  StopOnSignals();
  const auto ask = [&socket](const std::string& request) {
    const ControlReply reply = AskDaemon(socket, request);
    if (reply.outcome == ControlOutcome::kFailed) throw std::runtime_error(reply.text);
    if (reply.outcome == ControlOutcome::kWrong) throw SetupError(reply.text);
    return reply.text;
  };
  std::string request = fmt::format("background occupied {:g}", options.seconds);
  for (std::size_t i = 0; i < options.accepted.size(); ++i)
    request += (i == 0 ? ' ' : ',') + options.accepted[i];
  std::string said = ask(request), before;
  while (said.starts_with(OccupiedLearner::kUnderWay)) {
    if (isatty(STDERR_FILENO) && said != before)
      std::fprintf(stderr, "%s", PrintableLines(said).c_str());
    before = said;
    std::this_thread::sleep_for(kProgressPause);
    EndIfStopAsked();
    said = ask("background result");
  }
  std::fputs(PrintableLines(said).c_str(), stdout);
}

}  // namespace mocap
