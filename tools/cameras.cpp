#include "tools/cameras.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "config/load_config.h"
#include "config/open_live.h"
#include "core/errors.h"
#include "daemon/base/number_option.h"
#include "drivers/aravis/aravis_directory.h"
#include "drivers/camera_listing.h"
#include "drivers/printable_text.h"
#include "drivers/usb/usb_bus.h"
#include "drivers/usb/uvc_heads.h"
#include "drivers/v4l2/v4l2_devices.h"
#include "drivers/v4l2/video_kernel.h"
#include "tools/camera_check.h"

namespace mocap {
namespace {

struct CamerasOptions {
  std::filesystem::path config;
  double seconds = 5;
};

/// Prints one line, without line breaks.
void PrintLine(const std::string& line) { std::puts(Printable(line).c_str()); }

void PrintListed(const ListedCamera& camera) {
  std::string line = fmt::format("{}  {}, {}", camera.device, camera.model, camera.bus);
  if (!camera.serial.empty()) line += fmt::format(", serial {}", camera.serial);
  if (camera.link_mbit_s > 0) line += fmt::format(", {:g} Mbit/s", camera.link_mbit_s);
  PrintLine(line + fmt::format(" ({})", camera.driver));
  for (const std::string& format : camera.formats) PrintLine("    " + format);
  for (const std::string& remark : camera.remarks) PrintLine("  ! " + remark);
}

/// Lists heads controlled separately from their cameras.
void ListHeads() {
  try {
    for (const UvcHead& head : FindUvcHeads(UsbBus())) {
      PrintLine(fmt::format("{}  {}, port {}, serial {}, {:g} Mbit/s (head = \"uvc\")",
                            head.usb.bus, head.usb.model, head.usb.port, head.usb.serial,
                            head.usb.link_mbit_s));
    }
  } catch (const SetupError& error) {
    PrintLine(fmt::format("  ! {}", error.what()));
  }
}

void List() {
  std::vector<ListedCamera> cameras = ListV4l2Cameras(*SystemVideoKernel());
  std::ranges::move(ListAravisCameras(), std::back_inserter(cameras));
  for (const ListedCamera& camera : cameras) PrintListed(camera);
  if (cameras.empty()) PrintLine("no camera is connected");
  ListHeads();
}

/// @return  the number of troubles.
std::size_t PrintTroubles(const std::vector<std::string>& troubles) {
  for (const std::string& trouble : troubles) PrintLine("  ! " + trouble);
  return troubles.size();
}

void PrintRun(const CameraRun& run) {
  if (!run.error.empty()) {
    PrintLine(run.name);
    return;
  }
  PrintLine(fmt::format(
      "{}  {}, {}: asked for {:g} frames a second, got {:.2f}; {} lost, {} damaged of {}; "
      "times: {}",
      run.name, run.facts.device, run.facts.format, run.request.fps, run.Fps(), run.MissedFrames(),
      run.torn, run.sequences.size(), run.facts.time_source));
}

void Check(const CamerasOptions& options) {
  const Config config = LoadConfig(options.config);
  std::vector<LiveCamera> cameras = OpenLiveCameras(config);
  if (isatty(STDERR_FILENO)) {
    std::fprintf(stderr, "watching %s for %g s\n", Counted(cameras.size(), "camera").c_str(),
                 options.seconds);
  }
  const std::vector<CameraRun> runs = WatchCameras(cameras, options.seconds);
  const std::vector<BusLoad> loads = LoadsOf(runs);
  std::size_t troubles = 0;
  for (const CameraRun& run : runs) {
    PrintRun(run);
    troubles += PrintTroubles(TroublesOf(run, loads));
  }
  troubles += PrintTroubles(TriggerTroublesOf(runs));
  for (const BusLoad& load : loads) {
    if (load.link_mbit_s <= 0) continue;
    PrintLine(
        fmt::format("{}: {:.0f} of {:g} Mbit/s", load.bus, load.used_mbit_s, load.link_mbit_s));
    troubles += PrintTroubles(TroublesOf(load));
  }
  const SetSummary sets = SummarizeSets(runs);
  if (sets.sets > 0) {
    PrintLine(
        fmt::format("sets: {} of {} complete; their times lie {:.1f} ms apart, 99 % within {:.1f}",
                    sets.complete, sets.sets, sets.median_spread_ms, sets.p99_spread_ms));
    troubles += PrintTroubles(TroublesOf(sets, runs));
  }
  if (troubles > 0) {
    throw std::runtime_error(fmt::format("{}, marked with ! above", Counted(troubles, "problem")));
  }
}

}  // namespace

void AddCamerasCommand(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "cameras", "List the connected cameras, or check those of a configuration");
  auto options = std::make_shared<CamerasOptions>();
  command->add_option(
      "--check", options->config,
      "mocapd configuration file in TOML: stream from its cameras and report what to change");
  command->add_option("--seconds", options->seconds, "streaming time of the check [s]")
      ->check(NumberFrom(1, 3600))
      ->capture_default_str();
  command->callback([options] {
    if (options->config.empty()) {
      List();
    } else {
      Check(*options);
    }
  });
}

}  // namespace mocap
