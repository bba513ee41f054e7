#include "tools/take_import.h"

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/errors.h"
#include "daemon/base/choice_option.h"
#include "daemon/base/json.h"
#include "daemon/base/number_option.h"
#include "drivers/printable_text.h"
#include "tools/calibration/exchange.h"
#include "tools/import/import_take.h"
#include "tools/import/import_text.h"
#include "tools/remarks.h"
#include "tools/stop_on_signals.h"

namespace mocap {
namespace {

// No unit of length is larger.
constexpr double kLargestImportUnit_mm = 1e6;
const std::vector<std::string> kSyncChoices = {"auto",  "given", "timecode",
                                               "clock", "sound", "motion"};

struct ImportArguments {
  ImportRequest request;
  std::string from = "mocap", sync = "auto";
  ImportOptions options;
  bool json = false;
};

std::optional<SyncMethod> MethodOf(const std::string& name) {
  for (const SyncMethod method : {SyncMethod::kGiven, SyncMethod::kTimecode, SyncMethod::kClock,
                                  SyncMethod::kSound, SyncMethod::kMotion}) {
    if (kSyncNames[static_cast<int>(method)] == name) return method;
  }
  return std::nullopt;
}

void RunImport(ImportArguments& a) {
  StopOnSignals();
  const Imported imported = ImportCameras(a.from, a.request.calibration, a.options);
  TellRemarks("take import", imported.notes);
  if (imported.are_lenses_alone)
    throw SetupError(a.request.calibration.string() +
                     ": has intrinsics without poses; expected a calibration of the whole studio");
  a.request.cameras = imported.cameras;
  a.request.sync.method = MethodOf(a.sync);
  const ImportedTake take = ImportTake(a.request);
  TellRemarks("take import", take.remarks);
  if (a.json)
    std::puts(JsonText(ImportJson(take)).c_str());
  else
    std::printf("%swritten: %s\n", PrintableLines(ImportText(take)).c_str(),
                Printable(a.request.out.string()).c_str());
}

}  // namespace

void AddTakeImportCommand(CLI::App* take) {
  const auto a = std::make_shared<ImportArguments>();
  CLI::App* command = take->add_subcommand(
      "import", "Make a take of videos of phones and other cameras, and synchronize them");
  ImportRequest& request = a->request;
  command
      ->add_option("VIDEO", request.videos,
                   "one video of each camera; the camera's name is in the file's name or in its "
                   "folder's, or NAME=VIDEO")
      ->required();
  command->add_option("--calibration", request.calibration, "calibration of the cameras")
      ->required();
  command->add_option("--from", a->from, "format of the calibration, as of mocap calibrate convert")
      ->capture_default_str()
      ->check(OneOf(ImportFormats()));
  command
      ->add_option("--unit", a->options.unit_mm,
                   "unit of length of a pose2sim calibration [mm]; for aniposelib, of its board")
      ->capture_default_str()
      ->check(NumberFrom(1e-6, kLargestImportUnit_mm));
  command->add_option("--background", request.backgrounds,
                      "videos of the empty room, matched with cameras likewise (default: found in "
                      "each camera's video)");
  command
      ->add_option("--sync", a->sync,
                   "how to synchronize (default: given offsets, timecodes, sound, motion, as far "
                   "as there are)")
      ->check(OneOf(kSyncChoices));
  command->add_option("--offsets", request.offsets,
                      "seconds that make each video's times those of a common clock: "
                      "cam2=0.35,cam3=-1.2 or a TOML file");
  command->add_option("--out", request.out, "output take folder")->required();
  command->add_flag("--json", a->json, "print one JSON object");
  command->callback([a] { RunImport(*a); });
}

}  // namespace mocap
