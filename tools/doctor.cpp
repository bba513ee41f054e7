#include "tools/doctor.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <vector>

#include "config/load_config.h"
#include "daemon/recording/recorder.h"
#include "drivers/printable_text.h"
#include "drivers/take/input_file.h"
#include "tools/chosen_config.h"
#include "tools/doctor_checks.h"

namespace mocap {
namespace {

constexpr const char* kSystemTakes = "/var/lib/mocapd/takes";

struct DoctorOptions {
  std::filesystem::path config;
  std::filesystem::path socket;
};

const char* MarkOf(Grade grade) {
  switch (grade) {
    case Grade::kGood:
      return "good  ";
    case Grade::kAdvice:
      return "advice";
    case Grade::kBad:
      return "BAD   ";
  }
  return "";
}

/// Without other options, the daemon is the system's, if installed.
bool IsOfSystem(const DoctorOptions& options) {
  return options.config.empty() && IsThere(SystemConfig());
}

/// The system's daemon has its own folder, whichever user asks.
std::filesystem::path TakesFor(const DoctorOptions& options, const RecordingConfig& recording) {
  return IsOfSystem(options) && recording.folder.empty() ? kSystemTakes : TakesFolder(recording);
}

void Doctor(const DoctorOptions& options) {
  const Config config = LoadChosenConfig(options.config);
  const Starter starter = IsOfSystem(options) ? Starter::kSystemd : Starter::kCaller;
  std::vector<Diagnosis> diagnoses = {CheckMessages(config.lcm.url),
                                      CheckSocketBuffers(),
                                      CheckLimits(config.service.realtime, starter),
                                      CheckClock(),
                                      CheckProcessor(),
                                      CheckDisk(TakesFor(options, config.service.recording),
                                                config.service.recording.keep_free_mb)};
  std::ranges::move(CheckCalibration(config), std::back_inserter(diagnoses));
  std::ranges::move(CheckDevices(config), std::back_inserter(diagnoses));
  diagnoses.push_back(CheckControl(
      options.socket.empty() ? config.service.control.socket : options.socket, starter));
  std::ranges::move(CheckNodes(config), std::back_inserter(diagnoses));
  for (const Diagnosis& diagnosis : diagnoses) {
    std::printf("%s  %s\n", MarkOf(diagnosis.grade), Printable(diagnosis.what).c_str());
    if (!diagnosis.fix.empty()) std::printf("        -> %s\n", Printable(diagnosis.fix).c_str());
  }
  const auto bad = std::ranges::count(diagnoses, Grade::kBad, &Diagnosis::grade);
  if (bad > 0) throw std::runtime_error(Counted(bad, "problem") + " must be fixed");
}

}  // namespace

void AddDoctorCommand(CLI::App& app) {
  auto options = std::make_shared<DoctorOptions>();
  CLI::App* command = app.add_subcommand(
      "doctor", "Check network, limits, clock, disk, devices and permissions, and suggest fixes");
  command->add_option("--config", options->config,
                      "mocapd configuration file in TOML (default: the system's)");
  command->add_option("--socket", options->socket,
                      "mocapd control socket (default: from the configuration)");
  command->callback([options] { Doctor(*options); });
}

}  // namespace mocap
