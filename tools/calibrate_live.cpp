#include "tools/calibrate_live.h"

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <utility>

#include "config/load_config.h"
#include "config/open_studio.h"
#include "tools/board_recording.h"

namespace mocap {
namespace {

constexpr double kFloorSeconds = 3;

/// Opens the cameras of the configuration, live or not.
std::vector<LiveCamera> OpenCameras(const Config& config) {
  if (IsLive(config.source)) return OpenLiveCameras(config);
  std::vector<LiveCamera> cameras;
  for (StudioCamera& camera : OpenStudio(config).cameras) {
    LiveCamera& live = cameras.emplace_back();
    live.name = camera.calibration.name;
    live.request.device = config.source.driver;
    live.driver = std::move(camera.driver);
  }
  return cameras;
}

/// Whether Enter was pressed since the last call; never without a terminal.
class EnterKey {
 public:
  bool WasPressed() {
    pollfd input{STDIN_FILENO, POLLIN, 0};
    if (is_closed_ || poll(&input, 1, 0) <= 0) return false;
    Wait();
    return !is_closed_;
  }

  void Wait() {
    std::string line;
    is_closed_ = !std::getline(std::cin, line);
  }

 private:
  bool is_closed_ = false;
};

/// Lines that overwrite the previous ones.
class Screen {
 public:
  void Draw(const std::string& text) {
    if (!shown_) return;
    if (lines_ > 0) std::fprintf(stderr, "\x1b[%dA", lines_);
    lines_ = static_cast<int>(std::count(text.begin(), text.end(), '\n'));
    for (const char c : text) {
      if (c == '\n') std::fputs("\x1b[K", stderr);
      std::fputc(c, stderr);
    }
  }

 private:
  const bool shown_ = isatty(STDERR_FILENO) != 0;
  int lines_ = 0;
};

}  // namespace

std::string HintText(const std::vector<CameraHint>& hints) {
  std::string text;
  for (const CameraHint& hint : hints)
    text += fmt::format("{:<12}{:>4} views{:>5.0f} %  {}\n", hint.camera, hint.views,
                        100 * hint.covered, hint.missing.empty() ? "enough" : hint.missing);
  return text;
}

void RecordFootage(const CalibrateArguments& arguments) {
  for (const std::filesystem::path& folder : {arguments.footage, arguments.floor})
    if (!folder.empty()) RequireNew(folder);
  std::vector<LiveCamera> cameras = OpenCameras(LoadConfig(arguments.config));
  BoardRecordingOptions options;
  options.board = ParseBoard(arguments.board);
  options.folder = arguments.footage;
  options.most_seconds = arguments.most_seconds;
  EnterKey enter;
  Screen screen;
  bool is_begun = false;
  RecordBoard(cameras, options, [&](const std::vector<CameraHint>& hints) {
    // Cameras that do not deliver have been named by now.
    if (!std::exchange(is_begun, true))
      std::fputs(
          "Carry the board through the room: near each camera, in all parts of its picture, "
          "tilted;\nthen where several cameras see it at once. Enter ends it.\n",
          stderr);
    screen.Draw(HintText(hints));
    return enter.WasPressed() ||
           std::ranges::all_of(hints, [](const CameraHint& hint) { return hint.missing.empty(); });
  });
  if (arguments.floor.empty()) return;
  std::fputs("Lay the board on the floor where the cameras see it, step aside, and press Enter.\n",
             stderr);
  enter.Wait();
  options.folder = arguments.floor;
  options.most_seconds = kFloorSeconds;
  RecordBoard(cameras, options, [](const std::vector<CameraHint>&) { return false; });
}

}  // namespace mocap
