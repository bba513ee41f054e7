#include "tools/calibration/exchange.h"

#include <fmt/format.h>
#include <stdlib.h>

#include <algorithm>

#include "config/load_config.h"
#include "core/errors.h"
#include "drivers/quoted.h"
#include "drivers/take/calibration_file.h"
#include "drivers/take/text_file.h"

namespace mocap {
namespace {

namespace fs = std::filesystem;

// Larger than the residual of fitting another lens model.
constexpr double kWorstLens_px = 0.5;
constexpr double kWorstTurn = 1e-6;
constexpr double kWorstShift_mm = 0.01;

/// A temporary folder, deleted with the object.
class ScratchFolder {
 public:
  ScratchFolder() {
    std::string path = (fs::temp_directory_path() / "mocap-XXXXXX").string();
    if (mkdtemp(path.data()) == nullptr)
      throw std::runtime_error(path + ": cannot be created; expected a folder for temporary files");
    path_ = path;
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  ~ScratchFolder() {
    std::error_code error;
    fs::remove_all(path_, error);
  }

  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

std::vector<ForeignCamera> ReadForeign(const std::string& format, const fs::path& in,
                                       double unit_mm) {
  if (format == "pose2sim") return ReadPose2Sim(in, unit_mm);
  if (format == "easymocap") return ReadEasyMocap(in / "intri.yml", in / "extri.yml");
  if (format == "opencv" || format == "ros") return ReadOpenCv(in);
  if (format == "kalibr") return ReadKalibr(in);
  if (format == "willson") return ReadWillson(in);
  if (format == "qualisys") return ReadQualisys(in);
  if (format == "vicon") return ReadVicon(in);
  throw SetupError("--from " + Quoted(format) + ": is not a format that can be read");
}

std::vector<TextFile> TextsOf(const std::string& format, const fs::path& out,
                              const Cameras& cameras, double unit_mm) {
  if (format == "pose2sim") return Pose2SimText(cameras, unit_mm);
  if (format == "easymocap") return EasyMocapText(cameras);
  if (format == "opencv") return OpenCvText(cameras);
  if (format == "willson") return WillsonText(cameras);
  if (format == "qualisys") return QualisysText(cameras);
  if (format == "vicon") return ViconText(cameras);
  if (format == "mocap") return {{"", CalibrationText(out, cameras)}};
  throw SetupError("--to " + Quoted(format) + ": is not a format that can be written");
}

bool IsFolderFormat(const std::string& format) {
  return format == "easymocap" || format == "opencv" || format == "willson";
}

Cameras ReadAgain(const std::string& format, const fs::path& written, const Cameras& cameras,
                  double unit_mm) {
  if (format == "mocap") return LoadCalibration(written);
  std::vector<ForeignCamera> found = ReadForeign(format, written, unit_mm);
  // Data that the format does not contain.
  for (ForeignCamera& camera : found) {
    const auto same = std::find_if(cameras.begin(), cameras.end(),
                                   [&](const auto& c) { return c.name == camera.name; });
    if (camera.size_px.values.size() < 2 && same != cameras.end())
      camera.size_px.values = {static_cast<double>(same->width_px),
                               static_cast<double>(same->height_px)};
  }
  return CheckForeignCameras(written.string(), found, {}).cameras;
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

const std::vector<std::string>& ImportFormats() {
  static const std::vector<std::string> formats = {
      "mocap", "pose2sim", "easymocap", "opencv", "ros", "kalibr", "willson", "qualisys", "vicon"};
  return formats;
}

const std::vector<std::string>& ExportFormats() {
  static const std::vector<std::string> formats = {"mocap",   "pose2sim", "easymocap", "opencv",
                                                   "willson", "qualisys", "vicon"};
  return formats;
}

Imported ImportCameras(const std::string& format, const fs::path& in,
                       const ImportOptions& options) {
  if (format == "mocap") return {LoadCalibration(in), false, {}};
  const std::string source = Printable(in.string());
  const std::vector<ForeignCamera> found = ReadForeign(format, in, options.unit_mm);
  // OpenCV's own calibration and ROS write intrinsics only.
  const bool are_lenses = (format == "opencv" || format == "ros") &&
                          std::none_of(found.begin(), found.end(), [](const ForeignCamera& camera) {
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
  for (const CameraCalibration& camera : cameras) {
    if (camera.head && format != "mocap")
      throw SetupError("--to " + format + ": does not support pan-tilt heads, and " + camera.name +
                       " has one; use --to mocap");
  }
  // A name becomes part of file names and of texts, whose syntax it must not break.
  static_cast<void>(CalibrationText(out, cameras));
  if (!IsFolderFormat(format)) RequireWritable(out);
  const std::vector<TextFile> files = TextsOf(format, out, cameras, options.unit_mm);
  const ScratchFolder scratch;
  for (const TextFile& file : files)
    WriteText(scratch.path() / (file.name.empty() ? "calibration" : file.name), file.text);
  const fs::path written = IsFolderFormat(format) ? scratch.path() : scratch.path() / "calibration";
  Cameras read;
  try {
    read = ReadAgain(format, written, cameras, options.unit_mm);
  } catch (const SetupError& error) {
    throw SetupError(
        "--to " + format +
        ": cannot hold these cameras: the output could not be read again: " + error.what());
  }
  RequireSame(format, cameras, read);
  if (IsFolderFormat(format)) MakeFolder(out);
  for (const TextFile& file : files)
    ReplaceText(file.name.empty() ? out : out / file.name, file.text);
}

}  // namespace mocap
