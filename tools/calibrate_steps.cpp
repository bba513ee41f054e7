#include "tools/calibrate_steps.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "config/load_config.h"
#include "core/errors.h"
#include "daemon/base/json.h"
#include "drivers/nearest_name.h"
#include "drivers/printable_text.h"
#include "drivers/quoted.h"
#include "drivers/take/calibration_file.h"
#include "drivers/take/input_file.h"
#include "drivers/take/text_file.h"
#include "tools/calibration/floor.h"
#include "tools/calibration/footage.h"
#include "tools/calibration/still_board.h"

namespace mocap {
namespace {

constexpr double kDistanceTolerance = 0.01;

LensModel ModelOf(const std::string& name) {
  if (name == "tsai") return LensModel::kTsai;
  return name == "fisheye" ? LensModel::kFisheye : LensModel::kOpenCv;
}

/// Progress on a terminal: a line that is overwritten.
class Progress {
 public:
  ~Progress() { Write("\r\x1b[K"); }
  void Show(const std::string& line) { Write('\r' + Printable(line) + "\x1b[K"); }

 private:
  void Write(const std::string& text) const {
    if (is_terminal_) std::fputs(text.c_str(), stderr);
  }

  const bool is_terminal_ = isatty(STDERR_FILENO) != 0;
};

BoardDetections Collect(const Footage& footage, const CalibrateArguments& arguments, bool still,
                        bool all_must_see) {
  for (const std::string& note : footage.notes) std::fprintf(stderr, "mocap: %s\n", note.c_str());
  Progress progress;
  DetectionOptions options;
  options.still = still;
  options.all_must_see = all_must_see;
  options.most_frames = arguments.most_frames;
  const std::string step = "searching " + footage.folder.string() + " for the board";
  progress.Show(step);
  options.progress = [&](const std::string& camera, int done, int total, int found,
                         const std::string& hint) {
    progress.Show(fmt::format("{}: {}, frame {} of {}, {} views{}{}", step, camera, done, total,
                              found, hint.empty() ? "" : "; ", hint));
  };
  return CollectDetections(footage, ParseBoard(arguments.board), options);
}

// Opens footage of cameras that the floor points and the tape know.
Footage OpenWithWorld(const CalibrateArguments& arguments) {
  Footage footage = OpenFootage(arguments.footage);
  std::vector<CameraCalibration> named;
  for (const FootageCamera& camera : footage.cameras) named.emplace_back().name = camera.name;
  if (!arguments.floor_points.empty()) ReadFloorPoints(arguments.floor_points.string(), named);
  if (!arguments.distance.empty()) DistanceMm(ParseDistance(arguments.distance), named);
  return footage;
}

// Two lights hardly constrain the intrinsics.
void RefuseWand(const CalibrateArguments& arguments) {
  if (ParseBoard(arguments.board).kind == BoardKind::kWand)
    throw SetupError("--board " + arguments.board +
                     ": a wand does not determine intrinsics; use a board for mocap calibrate "
                     "intrinsics, then the wand for mocap calibrate extrinsics --intrinsics");
}

// Intrinsics from a file, in the order of the footage.
std::vector<CameraCalibration> LensesFor(const BoardDetections& detections,
                                         const std::filesystem::path& file) {
  const std::vector<CameraCalibration> all = LoadCalibration(file);
  std::vector<CameraCalibration> lenses;
  for (const DetectionCamera& camera : detections.cameras) {
    const auto lens = std::find_if(
        all.begin(), all.end(), [&](const CameraCalibration& c) { return c.name == camera.name; });
    if (lens == all.end())
      throw SetupError(fmt::format("{}: has no camera {}, but there is footage of it; {}",
                                   file.string(), Quoted(camera.name),
                                   ExpectedNames(camera.name, CameraNames(all))));
    if (lens->width_px != camera.width_px || lens->height_px != camera.height_px)
      throw SetupError(fmt::format(
          "{}: {} is calibrated for {} x {}; its footage is {} x {}: record it in that resolution, "
          "or calibrate its lens in this one",
          file.string(), camera.name, lens->width_px, lens->height_px, camera.width_px,
          camera.height_px));
    lenses.push_back(*lens);
  }
  return lenses;
}

std::vector<LensFit> FitLenses(const BoardDetections& detections,
                               const CalibrateArguments& arguments) {
  Progress progress;
  LensFitOptions options;
  options.model = ModelOf(arguments.lens);
  options.pitch_mm = {arguments.pitch_mm[0], arguments.pitch_mm[1]};
  std::vector<LensFit> fits;
  for (std::size_t c = 0; c < detections.cameras.size(); ++c) {
    progress.Show("fitting the lens of " + detections.cameras[c].name);
    fits.push_back(FitLens(detections, static_cast<int>(c), options));
  }
  return fits;
}

std::vector<CameraCalibration> CamerasWith(const BoardDetections& detections,
                                           const std::vector<LensFit>& lenses) {
  std::vector<CameraCalibration> cameras;
  for (std::size_t c = 0; c < lenses.size(); ++c) {
    const DetectionCamera& camera = detections.cameras[c];
    cameras.push_back({camera.name, camera.width_px, camera.height_px, lenses[c].lens, {}, {}});
  }
  return cameras;
}

StudioFit FitPoses(const BoardDetections& detections, const std::vector<CameraCalibration>& lenses,
                   const CalibrateArguments& arguments) {
  Progress progress;
  progress.Show("adjusting all cameras together");
  if (arguments.still)
    return FitToStillBoard(detections, lenses, detections.still_pictures, arguments.thickness_mm);
  ExtrinsicsOptions options;
  options.refine_lenses = !arguments.keep_lenses && detections.board.kind != BoardKind::kWand;
  return FitExtrinsics(detections, lenses, options);
}

}  // namespace

void RequireInputs(const CalibrateArguments& arguments) {
  RequireWritable(arguments.out);
  if (!arguments.report.empty()) {
    RequireSuffix(arguments.report, ".html");
    RequireWritable(arguments.report);
  }
  if (!arguments.intrinsics.empty()) LoadCalibration(arguments.intrinsics);
  if (!arguments.floor_points.empty())
    RequireFile(arguments.floor_points, "a table of floor points");
  if (!arguments.distance.empty()) ParseDistance(arguments.distance);
  if (arguments.board.empty()) return;
  const bool is_wand = ParseBoard(arguments.board).kind == BoardKind::kWand;
  if (is_wand && (arguments.still || !arguments.floor.empty()))
    throw SetupError(
        "--floor: a wand does not determine the floor; set it with mocap calibrate floor, from a "
        "board or --floor-points");
  if (!arguments.floor.empty() && arguments.config.empty()) OpenFootage(arguments.floor);
}

StudioFit CalibrateIntrinsics(const CalibrateArguments& arguments) {
  RefuseWand(arguments);
  const Footage footage = OpenFootage(arguments.footage);
  StudioFit fit;
  fit.has_poses = false;
  fit.detections = Collect(footage, arguments, false, true);
  const std::vector<LensFit> lenses = FitLenses(fit.detections, arguments);
  fit.bundle.cameras = CamerasWith(fit.detections, lenses);
  fit.bundle.X_WB.assign(static_cast<std::size_t>(fit.detections.moments), std::nullopt);
  MeasureFit(fit);
  for (std::size_t c = 0; c < lenses.size(); ++c) {
    fit.cameras[c].lens_rms_px = lenses[c].rms_px;
    fit.cameras[c].focal_sigma_share = lenses[c].focal_sigma_share;
    fit.rms_px = std::max(fit.rms_px, lenses[c].rms_px);
  }
  return fit;
}

StudioFit CalibrateExtrinsics(const CalibrateArguments& arguments) {
  const Footage footage = OpenWithWorld(arguments);
  const BoardDetections detections = Collect(footage, arguments, arguments.still, true);
  StudioFit fit = FitPoses(detections, LensesFor(detections, arguments.intrinsics), arguments);
  SetWorld(arguments, fit);
  return fit;
}

StudioFit CalibrateStudio(const CalibrateArguments& arguments) {
  RefuseWand(arguments);
  const Footage footage = OpenWithWorld(arguments);
  const BoardDetections detections = Collect(footage, arguments, false, true);
  const std::vector<LensFit> lenses = FitLenses(detections, arguments);
  StudioFit fit = FitPoses(detections, CamerasWith(detections, lenses), arguments);
  for (std::size_t c = 0; c < lenses.size(); ++c) {
    fit.cameras[c].lens_rms_px = lenses[c].rms_px;
    fit.cameras[c].focal_sigma_share = lenses[c].focal_sigma_share;
  }
  SetWorld(arguments, fit);
  return fit;
}

void SetWorld(const CalibrateArguments& arguments, StudioFit& fit) {
  if (arguments.set_scale) {
    const KnownDistance distance = ParseDistance(arguments.distance);
    ScaleWorld(distance.mm / DistanceMm(distance, fit.bundle.cameras), fit.bundle);
  }
  if (!arguments.floor.empty()) {
    const Footage footage = OpenFootage(arguments.floor);
    BoardDetections still = Collect(footage, arguments, true, false);
    // The floor's footage may lack cameras or have another order.
    for (BoardDetection& s : still.detections) {
      const std::string& name = still.cameras[s.camera].name;
      const auto camera = std::find_if(fit.bundle.cameras.begin(), fit.bundle.cameras.end(),
                                       [&](const CameraCalibration& c) { return c.name == name; });
      if (camera == fit.bundle.cameras.end())
        throw SetupError(arguments.floor.string() + ": has a camera " + Quoted(name) +
                         " that is not calibrated; the calibration has " +
                         ListedNames(CameraNames(fit.bundle.cameras)));
      s.camera = static_cast<int>(camera - fit.bundle.cameras.begin());
    }
    const RigidTransform X_WB = FindStillBoard(still, fit.bundle.cameras);
    MoveWorld(WorldOnBoard(X_WB, fit.bundle.cameras, arguments.thickness_mm), fit.bundle);
    fit.has_floor = true;
  } else if (!arguments.floor_points.empty()) {
    const std::vector<FloorPoint> points =
        ReadFloorPoints(arguments.floor_points.string(), fit.bundle.cameras);
    MoveWorld(WorldOnPoints(points, fit.bundle.cameras), fit.bundle);
    fit.has_floor = true;
  }
}

std::vector<Finding> CheckAll(const CalibrateArguments& arguments, const StudioFit& fit) {
  std::vector<Finding> findings = CheckFit(fit);
  if (!arguments.distance.empty()) {
    const KnownDistance distance = ParseDistance(arguments.distance);
    const double found_mm = DistanceMm(distance, fit.bundle.cameras);
    std::string text = fmt::format("{} and {} are {:.0f} mm apart here and {:.0f} mm by the tape",
                                   distance.from, distance.to, found_mm, distance.mm);
    const bool is_wrong = std::abs(found_mm / distance.mm - 1) > kDistanceTolerance;
    if (is_wrong)
      text += fmt::format(": the board's squares are {:.2f} times as large as --board says",
                          distance.mm / found_mm);
    findings.insert(is_wrong ? findings.begin() : findings.end(),
                    {is_wrong ? Severity::kWrong : Severity::kNote, std::move(text)});
  }
  return findings;
}

std::string FindingsText(const std::vector<Finding>& findings) {
  std::string text;
  for (const Finding& finding : findings)
    text += std::string(NameOf(finding.severity)) + ": " + finding.text + '\n';
  return text + Conclusion(findings) + '\n';
}

void RequireUsable(const std::filesystem::path& file, const std::vector<Finding>& findings) {
  const std::ptrdiff_t errors = CountOf(Severity::kWrong, findings);
  if (errors > 0)
    throw std::runtime_error(file.string() + ": has " + Counted(errors, "error") + ", see above");
}

namespace {

/// What was measured is above 0.
std::string Measured(double value, int decimals) {
  return value > 0 ? fmt::format("{:.{}f}", value, decimals) : "-";
}

}  // namespace

std::string FitText(const StudioFit& fit, const std::vector<Finding>& findings) {
  const Vector3 middle_W = MiddleOfRoom(fit.bundle.cameras);
  std::string text =
      fmt::format("board: {}\n{:<10}{:>7}{:>9}{:>9}{:>12}{:>10}\n", fit.detections.board.Text(),
                  "camera", "views", "lens px", "px", "mm (person)", "covered");
  for (std::size_t c = 0; c < fit.cameras.size(); ++c) {
    const CameraFit& camera = fit.cameras[c];
    const double rms_mm = camera.rms_px * MillimetresPerPixel(fit.bundle.cameras[c], middle_W);
    text += fmt::format("{:<10}{:>7}{:>9}{:>9}{:>12}{:>9.0f}%\n", camera.name, camera.views,
                        Measured(camera.lens_rms_px, 3), Measured(camera.rms_px, 3),
                        Measured(rms_mm, 2), 100 * camera.coverage.share);
  }
  for (std::size_t c = 1; c < fit.bundle.lateness_s.size(); ++c) {
    if (std::abs(fit.bundle.lateness_s[c]) < 0.0005) continue;
    text += fmt::format("{} exposes {:+.1f} ms relative to {}\n", fit.cameras[c].name,
                        1000 * fit.bundle.lateness_s[c], fit.cameras[0].name);
  }
  text += fmt::format("overall {:.3f} px\n", fit.rms_px);
  return text + FindingsText(findings);
}

std::string FitJson(const StudioFit& fit, const std::vector<Finding>& findings) {
  const Vector3 middle_W = MiddleOfRoom(fit.bundle.cameras);
  Json json = Json::object(), cameras = Json::object();
  json["rms_px"] = Rounded(fit.rms_px, 4);
  for (std::size_t c = 0; c < fit.cameras.size(); ++c) {
    const CameraFit& camera = fit.cameras[c];
    Json one = Json::object();
    one["views"] = camera.views;
    if (camera.lens_rms_px > 0) one["lens_rms_px"] = Rounded(camera.lens_rms_px, 4);
    if (camera.rms_px > 0) {
      one["rms_px"] = Rounded(camera.rms_px, 4);
      one["rms_mm"] =
          Rounded(camera.rms_px * MillimetresPerPixel(fit.bundle.cameras[c], middle_W), 3);
    }
    one["coverage"] = Rounded(camera.coverage.share, 3);
    cameras[camera.name] = one;
  }
  json["cameras"] = cameras;
  Json list = Json::object();
  for (std::size_t i = 0; i < findings.size(); ++i)
    list[std::to_string(i + 1)] =
        std::string(NameOf(findings[i].severity)) + ": " + findings[i].text;
  json["findings"] = list;
  json["verdict"] = Conclusion(findings);
  return JsonText(json) + '\n';
}

}  // namespace mocap
