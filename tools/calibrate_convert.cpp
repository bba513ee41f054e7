#include "tools/calibrate_convert.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "core/errors.h"
#include "daemon/base/choice_option.h"
#include "daemon/base/number_option.h"
#include "drivers/printable_text.h"
#include "drivers/quoted.h"
#include "drivers/take/calibration_file.h"
#include "tools/calibrate_steps.h"
#include "tools/calibration/exchange.h"
#include "tools/calibration/studio_check.h"

namespace mocap {
namespace {

// No unit of length is larger.
constexpr double kLargestUnit_mm = 1e6;

struct ConvertArguments {
  std::filesystem::path in, out;
  std::string from = "mocap", to = "mocap", size;
  ImportOptions options;
};

// Parses "1280x720".
std::array<int, 2> ParseSize(const std::string& text) {
  std::array<int, 2> size_px{};
  const char* end = text.data() + text.size();
  const auto width = std::from_chars(text.data(), end, size_px[0]);
  if (width.ec == std::errc() && width.ptr != end && (*width.ptr == 'x' || *width.ptr == 'X')) {
    const auto height = std::from_chars(width.ptr + 1, end, size_px[1]);
    const auto is_side = [](int side) { return side >= 1 && side <= kLargestPicture_px; };
    if (height.ec == std::errc() && height.ptr == end && is_side(size_px[0]) && is_side(size_px[1]))
      return size_px;
  }
  throw SetupError("--size " + Quoted(text) +
                   ": expected WIDTHxHEIGHT in pixels, such as 1280x720");
}

Imported Import(const ConvertArguments& a) {
  try {
    return ImportCameras(a.from, a.in, a.options);
  } catch (const SetupError& error) {
    if (a.from != "mocap") throw;
    throw SetupError(std::string(error.what()) +
                     "; if another program wrote it, name the program: "
                     "--from FORMAT");
  }
}

// What the files say is not overruled.
void RequireSize(const ConvertArguments& a, const std::vector<CameraCalibration>& cameras) {
  if (!a.options.size_px) return;
  for (const CameraCalibration& camera : cameras) {
    if (std::array{camera.width_px, camera.height_px} == *a.options.size_px) continue;
    throw SetupError(
        fmt::format("--size {}: {} says that the pictures of {} have {}x{}; leave "
                    "--size out",
                    a.size, a.in.string(), camera.name, camera.width_px, camera.height_px));
  }
}

void RunConvert(ConvertArguments a) {
  if (!a.size.empty()) a.options.size_px = ParseSize(a.size);
  const Imported imported = Import(a);
  for (const std::string& note : imported.notes) std::fprintf(stderr, "mocap: %s\n", note.c_str());
  if (imported.are_lenses_alone && a.to != "mocap")
    throw SetupError("--to " + a.to +
                     ": needs poses, which the input does not have; intrinsics without poses can "
                     "be written --to mocap");
  RequireSize(a, imported.cameras);
  std::vector<Finding> findings;
  if (!imported.are_lenses_alone) findings = CheckCameras(imported.cameras, a.from != "kalibr");
  if (a.to == "mocap" && CountOf(Severity::kWrong, findings) > 0) a.out += ".rejected";
  ExportCameras(a.to, a.out, imported.cameras, a.options);
  for (const Finding& finding : findings)
    std::printf("%s: %s\n", NameOf(finding.severity), finding.text.c_str());
  if (a.from == "kalibr" && !imported.are_lenses_alone)
    std::puts("note: the world is the first camera's; set the floor with mocap calibrate floor");
  std::printf("written: %s\n", Printable(a.out.string()).c_str());
  RequireUsable(a.out, findings);
}

}  // namespace

void AddConvert(CLI::App* parent) {
  const auto a = std::make_shared<ConvertArguments>();
  CLI::App* command = parent->add_subcommand(
      "convert", "Convert calibrations from and to the formats of other programs");
  command->add_option("IN", a->in, "input file, or folder for easymocap, opencv, ros and willson")
      ->required();
  command->add_option("--from", a->from, "input format")
      ->capture_default_str()
      ->check(OneOf(ImportFormats()));
  command->add_option("--to", a->to, "output format")
      ->capture_default_str()
      ->check(OneOf(ExportFormats()));
  command->add_option("--out", a->out, "output file or folder")->required();
  command
      ->add_option("--unit", a->options.unit_mm,
                   "unit of length of a pose2sim file [mm]; for aniposelib, the unit of its board")
      ->capture_default_str()
      ->check(NumberFrom(1e-6, kLargestUnit_mm));
  command->add_option("--size", a->size, "picture size WIDTHxHEIGHT [px], if IN lacks it");
  command->add_flag("--lenses", a->options.lenses_alone,
                    "also keep cameras without a pose, at the identity, for mocap calibrate "
                    "extrinsics --intrinsics");
  command->callback([a] { RunConvert(*a); });
}

}  // namespace mocap
