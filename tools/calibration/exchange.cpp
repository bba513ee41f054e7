#include "tools/calibration/exchange.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "config/load_config.h"
#include "core/errors.h"
#include "drivers/lowered.h"
#include "drivers/printable_text.h"
#include "drivers/quoted.h"
#include "drivers/take/input_file.h"
#include "drivers/take/take_layout.h"
#include "drivers/take/text_file.h"
#include "tools/calibration/foreign_program.h"
#include "tools/calibration/lens_conversion.h"

namespace mocap {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLargestFile = 32 << 20;
// Larger than the residual of fitting another lens model.
constexpr double kWorstLens_px = 0.5;
constexpr double kWorstTurn = 1e-6;
constexpr double kWorstShift_mm = 0.01;

ForeignProgram ProgramOf(const std::string& format, const ImportOptions& options) {
  const auto place = std::ranges::find(ForeignPrograms(), format, &ForeignProgram::name);
  if (place == ForeignPrograms().end()) throw SetupError(Quoted(format) + ": is not a format");
  ForeignProgram program = *place;
  if (program.has_own_unit) program.unit_mm = options.unit_mm;
  return program;
}

bool HasOneFileEach(const ForeignProgram& program) {
  return !program.files.empty() && program.files[0].starts_with('.');
}

// Files of a folder with one for each camera, sorted by name, or a single file.
std::vector<fs::path> CameraFiles(const fs::path& in, const std::vector<std::string>& extensions) {
  std::error_code error;
  if (!fs::is_directory(in, error)) return {in};
  std::vector<fs::path> files;
  fs::directory_iterator entry(in, error);
  if (error) throw SetupError(Printable(in.string()) + ": cannot be listed: " + error.message());
  for (; entry != fs::directory_iterator() && !error; entry.increment(error)) {
    const std::string extension = Lowered(entry->path().extension().string());
    if (std::ranges::count(extensions, extension) > 0 && !IsHidden(entry->path()))
      files.push_back(entry->path());
  }
  std::sort(files.begin(), files.end());
  if (files.empty())
    throw SetupError(fmt::format("{}: contains no file NAME{}; expected one for each camera",
                                 Printable(in.string()), fmt::join(extensions, " or ")));
  return files;
}

TextFiles ReadFiles(const ForeignProgram& program, const fs::path& in) {
  std::vector<fs::path> paths = {in};
  if (HasOneFileEach(program)) {
    paths = CameraFiles(in, program.files);
  } else if (!program.files.empty()) {
    paths.clear();
    for (const std::string& name : program.files) paths.push_back(in / name);
  }
  TextFiles files;
  for (const fs::path& path : paths)
    files.push_back({Printable(path.string()), ReadWholeFile(path, "a calibration", kLargestFile)});
  return files;
}

Cameras ReadAgain(const ForeignProgram& program, const TextFiles& files, const Cameras& cameras) {
  std::vector<ForeignCamera> found = program.read(files, program);
  // Data that the format does not contain.
  for (ForeignCamera& camera : found) {
    const auto same = std::ranges::find(cameras, camera.name, &CameraCalibration::name);
    if (camera.size_px.values.size() < 2 && same != cameras.end())
      camera.size_px.values = {static_cast<double>(same->width_px),
                               static_cast<double>(same->height_px)};
  }
  return CheckForeignCameras(program.name, found, {}).cameras;
}

void RequireSame(const std::string& format, const Cameras& written, const Cameras& read) {
  for (const CameraCalibration& camera : written) {
    const auto fail = [&](const std::string& what) {
      throw SetupError("--to " + format + ": cannot hold camera " + Quoted(camera.name) + ": " +
                       what);
    };
    const auto same = std::find_if(read.begin(), read.end(), [&](const CameraCalibration& c) {
      return c.name == camera.name;
    });
    if (same == read.end()) fail("its name would change");
    if (same->width_px != camera.width_px || same->height_px != camera.height_px)
      fail("the size of its picture would change");
    if (!((same->X_CW.R - camera.X_CW.R).norm() < kWorstTurn) ||
        !((same->X_CW.p - camera.X_CW.p).norm() < kWorstShift_mm))
      fail("its pose would change");
    if (const double apart_px = LensDifferencePx(camera, same->lens); !(apart_px < kWorstLens_px))
      fail(fmt::format("its lens would change by {:.2f} px", apart_px));
  }
  if (read.size() != written.size())
    throw SetupError("--to " + format + ": cannot hold these cameras: their number would change");
}

}  // namespace

std::vector<std::string> ImportFormats() {
  std::vector<std::string> formats = {"mocap"};
  for (const ForeignProgram& program : ForeignPrograms()) formats.push_back(program.name);
  return formats;
}

std::vector<std::string> ExportFormats() {
  std::vector<std::string> formats = {"mocap"};
  for (const ForeignProgram& program : ForeignPrograms()) {
    if (program.write != nullptr) formats.push_back(program.name);
  }
  return formats;
}

Imported ImportCameras(const std::string& format, const fs::path& in,
                       const ImportOptions& options) {
  if (format == "mocap") return {LoadCalibration(in), false, {}};
  const std::string source = Printable(in.string());
  const ForeignProgram program = ProgramOf(format, options);
  const std::vector<ForeignCamera> found = program.read(ReadFiles(program, in), program);
  const bool are_lenses =
      program.may_lack_poses && std::ranges::none_of(found, [](const ForeignCamera& camera) {
        return camera.rotation || camera.translation_mm;
      });
  if (!are_lenses) return CheckForeignCameras(source, found, options);
  ImportOptions lenses = options;
  lenses.lenses_alone = true;
  Imported imported = CheckForeignCameras(source, found, lenses);
  for (const CameraCalibration& camera : imported.cameras)
    imported.notes.push_back(source + ": " + camera.name +
                             " is a lens without a pose; mocap calibrate extrinsics --intrinsics "
                             "finds it");
  return imported;
}

void ExportCameras(const std::string& format, const fs::path& out, const Cameras& cameras,
                   const ImportOptions& options) {
  // A name becomes part of file names and of texts, whose syntax it must not break.
  const std::string own_text = CalibrationText(out, cameras);
  if (format == "mocap") {
    RequireWritable(out);
    RequireSame(format, cameras, ParseCalibration(own_text, out.string()));
    return ReplaceText(out, own_text);
  }
  for (const CameraCalibration& camera : cameras) {
    if (camera.head)
      throw SetupError("--to " + format + ": does not support pan-tilt heads, and " + camera.name +
                       " has one; use --to mocap");
  }
  const ForeignProgram program = ProgramOf(format, options);
  if (program.files.empty()) RequireWritable(out);
  const TextFiles files = program.write(cameras, program);
  Cameras read;
  try {
    read = ReadAgain(program, files, cameras);
  } catch (const SetupError& error) {
    throw SetupError(
        "--to " + format +
        ": cannot hold these cameras: the output could not be read again: " + error.what());
  }
  RequireSame(format, cameras, read);
  if (!program.files.empty()) MakeFolder(out);
  for (const TextFile& file : files)
    ReplaceText(file.name.empty() ? out : out / file.name, file.text);
}

}  // namespace mocap
