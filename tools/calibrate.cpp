#include "tools/calibrate.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <memory>
#include <sstream>
#include <stdexcept>

#include "config/load_config.h"
#include "core/calibration/tsai.h"
#include "core/errors.h"
#include "daemon/base/choice_option.h"
#include "daemon/base/number_option.h"
#include "drivers/clock.h"
#include "drivers/printable_text.h"
#include "drivers/take/calibration_file.h"
#include "drivers/take/input_file.h"
#include "drivers/take/text_file.h"
#include "tools/calibrate_board.h"
#include "tools/calibrate_check.h"
#include "tools/calibrate_convert.h"
#include "tools/calibrate_live.h"
#include "tools/calibrate_steps.h"
#include "tools/calibrate_takes.h"
#include "tools/report/calibration_report.h"

namespace mocap {
namespace {

using Arguments = std::shared_ptr<CalibrateArguments>;

/// Writes a calibration. One that should not be used gets another name, and replaces none.
/// Says what it wrote, unless as JSON.
/// @throws std::runtime_error  if it should not be used, after `report`.
void Conclude(const CalibrateArguments& arguments, const StudioFit& fit,
              const CalibrationRecord& record, const std::vector<Finding>& findings,
              const std::function<void()>& report) {
  std::filesystem::path out = arguments.out;
  const bool is_usable = CountOf(Severity::kWrong, findings) == 0;
  if (!is_usable) out += ".rejected";
  WriteCalibration(out, fit.bundle.cameras, record);
  report();
  if (!arguments.json) {
    std::printf("written: %s\n", Printable(out.string()).c_str());
    if (!arguments.report.empty())
      std::printf("written: %s\n", Printable(arguments.report.string()).c_str());
  }
  RequireUsable(out, findings);
}

void Finish(const CalibrateArguments& arguments, const StudioFit& fit) {
  const std::vector<Finding> findings = CheckAll(arguments, fit);
  CalibrationRecord record;
  record.made_s = TimeOfDayS();
  record.reprojection_px = fit.rms_px;
  Conclude(arguments, fit, record, findings, [&] {
    if (!arguments.report.empty())
      WriteText(arguments.report,
                CalibrationReportHtml("Calibration of " + arguments.footage.filename().string(),
                                      record.made_s, fit, findings));
    const std::string text = arguments.json ? FitJson(fit, findings) : FitText(fit, findings);
    std::fputs(text.c_str(), stdout);
  });
}

void AddFootage(CLI::App* command, const Arguments& a) {
  command
      ->add_option("FOOTAGE", a->footage,
                   "take, or folder with one video or one folder of pictures per camera")
      ->required();
  command
      ->add_option("--board", a->board,
                   "board: chess:COLUMNSxROWS:MM (inner corners), "
                   "charuco:COLUMNSxROWS:MM[:DICTIONARY][:MARKER_SHARE][:inverted] (squares), "
                   "aprilgrid:COLUMNSxROWS:TAG_MM:SPACING (tags, as Kalibr prints them; gap over "
                   "tag) or, for extrinsics, wand:MM (two lights)")
      ->required();
  command
      ->add_option("--most-frames", a->most_frames, "maximum number of frames to search per camera")
      ->capture_default_str()
      ->check(NumberFrom(1, 100000));
}

void AddLive(CLI::App* command, const Arguments& a) {
  CLI::Option* config =
      command->add_option("--config", a->config,
                          "mocapd configuration file in TOML: first record FOOTAGE, and the "
                          "footage of --floor, from its cameras");
  command->add_option("--seconds", a->most_seconds, "maximum recording time of FOOTAGE [s]")
      ->needs(config)
      ->capture_default_str()
      ->check(NumberFrom(1, 3600));
}

/// Runs a step that uses footage.
void Run(const CalibrateArguments& a, StudioFit (*step)(const CalibrateArguments&)) {
  RequireInputs(a);
  if (!a.config.empty()) RecordFootage(a);
  Finish(a, step(a));
}

void AddOutput(CLI::App* command, const Arguments& a) {
  command->add_option("--out", a->out, "output calibration.toml")->required();
  command->add_flag("--json", a->json, "print one JSON object");
}

void AddReport(CLI::App* command, const Arguments& a) {
  command->add_option("--report", a->report,
                      "output HTML report: errors, coverage, floor plan, conclusion");
}

void AddLens(CLI::App* command, const Arguments& a) {
  command->add_option("--lens", a->lens, "lens model: tsai, opencv or fisheye")
      ->capture_default_str()
      ->check(OneOf({"tsai", "opencv", "fisheye"}));
  command->add_option("--pitch", a->pitch_mm, "pixel size dx dy, for the lens model tsai [mm]")
      ->expected(2);
}

/// @return  the option --floor.
CLI::Option* AddWorld(CLI::App* command, const Arguments& a) {
  CLI::Option* floor = command->add_option(
      "--floor", a->floor, "footage of the board on the floor, which sets origin and axes");
  command
      ->add_option("--floor-points", a->floor_points,
                   "CSV file of three floor points, instead of --floor: origin|x|y,CAMERA,X,Y")
      ->excludes(floor);
  command->add_option("--thickness", a->thickness_mm,
                      "height of the board's printed side above the floor [mm]");
  CLI::Option* distance =
      command->add_option("--distance", a->distance,
                          "distance between two cameras, measured with a tape: CAMERA:CAMERA:MM");
  command
      ->add_flag("--set-scale", a->set_scale,
                 "scale the world to match --distance, instead of checking against it")
      ->needs(distance);
  return floor;
}

void AddStudio(CLI::App* parent) {
  const auto a = std::make_shared<CalibrateArguments>();
  CLI::App* command = parent->add_subcommand(
      "studio", "Calibrate all cameras, from a board carried through the room");
  AddFootage(command, a);
  AddOutput(command, a);
  AddReport(command, a);
  AddLens(command, a);
  AddWorld(command, a);
  AddLive(command, a);
  command->callback([a] { Run(*a, CalibrateStudio); });
}

void AddIntrinsics(CLI::App* parent) {
  const auto a = std::make_shared<CalibrateArguments>();
  CLI::App* command = parent->add_subcommand("intrinsics", "Calibrate the intrinsics only");
  AddFootage(command, a);
  AddOutput(command, a);
  AddLens(command, a);
  AddLive(command, a);
  command->callback([a] { Run(*a, CalibrateIntrinsics); });
}

void AddExtrinsics(CLI::App* parent) {
  const auto a = std::make_shared<CalibrateArguments>();
  CLI::App* command = parent->add_subcommand(
      "extrinsics", "Calibrate the extrinsics of cameras with known intrinsics");
  AddFootage(command, a);
  AddOutput(command, a);
  AddReport(command, a);
  AddWorld(command, a);
  command->add_option("--intrinsics", a->intrinsics, "calibration.toml with the intrinsics")
      ->required();
  command->add_flag(
      "--still", a->still,
      "the board lies still on the floor in view of all cameras, and defines the world frame");
  command->add_flag("--keep-lenses", a->keep_lenses, "do not refine the intrinsics");
  AddLive(command, a);
  command->callback([a] { Run(*a, CalibrateExtrinsics); });
}

void AddFloor(CLI::App* parent) {
  const auto a = std::make_shared<CalibrateArguments>();
  CLI::App* command =
      parent->add_subcommand("floor", "Set floor, origin, axes and scale of a calibration");
  command->add_option("CALIBRATION", a->calibration, "input calibration.toml")->required();
  CLI::Option* board =
      command->add_option("--board", a->board, "board on the floor, as for mocap calibrate studio");
  AddOutput(command, a);
  AddWorld(command, a)->needs(board);
  command->callback([a] {
    if (a->floor.empty() && a->floor_points.empty() && !a->set_scale)
      throw SetupError("expected --floor, --floor-points, or --distance with --set-scale");
    RequireInputs(*a);
    StudioFit fit;
    fit.bundle.cameras = LoadCalibration(a->calibration);
    fit.has_floor = true;
    SetWorld(*a, fit);
    const std::vector<Finding> findings = CheckAll(*a, fit);
    Conclude(*a, fit, LoadCalibrationRecord(a->calibration), findings, [&] {
      const std::string text = FindingsText(findings);
      std::fputs(text.c_str(), stdout);
    });
  });
}

struct TsaiArguments {
  std::filesystem::path points, out;
  std::vector<double> pitch_mm, center_px;
  std::vector<int> size_px;
  double sx = 1;
  bool fixed_center = false;
};

constexpr std::size_t kLargestTable = 32 << 20;

std::vector<PointDetection> ReadPoints(const std::filesystem::path& file) {
  std::istringstream in(ReadWholeFile(file, "a table of xw yw zw Xf Yf", kLargestTable));
  std::vector<PointDetection> points;
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    PointDetection p;
    if (std::sscanf(line.c_str(), "%lf %lf %lf %lf %lf", &p.p_W.x(), &p.p_W.y(), &p.p_W.z(),
                    &p.pixel.x(), &p.pixel.y()) != 5)
      throw SetupError(file.string() + ":" + std::to_string(number) +
                       ": is not five numbers: xw yw zw Xf Yf");
    if (!p.p_W.allFinite() || !p.pixel.allFinite())
      throw SetupError(file.string() + ":" + std::to_string(number) +
                       ": has a number that is not finite");
    points.push_back(p);
  }
  return points;
}

void CheckTsaiArguments(const TsaiArguments& a) {
  const auto is_length = [](double length) { return std::isfinite(length) && length > 0; };
  if (!std::all_of(a.pitch_mm.begin(), a.pitch_mm.end(), is_length))
    throw SetupError("--pitch: expected lengths above 0, in mm");
  if (!is_length(a.sx)) throw SetupError("--sx: expected a number above 0");
  for (const double center_px : a.center_px) {
    if (!std::isfinite(center_px)) throw SetupError("--center: expected pixels");
  }
  for (const int side_px : a.size_px) {
    if (side_px < 1 || side_px > kLargestPicture_px)
      throw SetupError("--size: " + std::to_string(side_px) +
                       " is not the side of a picture; expected 1 to " +
                       std::to_string(kLargestPicture_px) + " pixels");
  }
}

void RunTsai(const TsaiArguments& a) {
  CheckTsaiArguments(a);
  TsaiSensor sensor;
  sensor.pitch_mm = {a.pitch_mm[0], a.pitch_mm[1]};
  const Vector2 size(a.size_px[0], a.size_px[1]);
  sensor.center_px = a.center_px.empty() ? Vector2((size - Vector2::Ones()) / 2)
                                         : Vector2(a.center_px[0], a.center_px[1]);
  sensor.sx = a.sx;
  sensor.refine_center = !a.fixed_center;
  const std::vector<PointDetection> points = ReadPoints(a.points);
  TsaiCalibration result;
  try {
    result = CalibrateTsai(points, sensor);
  } catch (const SetupError& error) {
    throw SetupError(a.points.string() + ": " + error.what());
  }
  const CameraCalibration camera{"cam1", a.size_px[0], a.size_px[1], result.lens, result.X_CW, {}};
  WriteCalibration(a.out, std::vector<CameraCalibration>{camera});
  std::fprintf(stdout,
               "%s points: mean %.4f px, rms %.4f px, worst %.4f px; f %.4f mm, Tz %.2f mm\n",
               result.coplanar ? "coplanar" : "spatial", result.mean_px, result.rms_px,
               result.worst_px, result.lens.focal_mm, result.X_CW.p.z());
}

void AddTsai(CLI::App* parent) {
  const auto a = std::make_shared<TsaiArguments>();
  CLI::App* command = parent->add_subcommand(
      "tsai", "Calibrate one camera from known points, by Tsai's 1987 method");
  command->add_option("POINTS", a->points, "table with rows of xw yw zw [mm] Xf Yf [px]")
      ->required();
  command->add_option("--pitch", a->pitch_mm, "pixel size dx dy [mm]")->required()->expected(2);
  command->add_option("--size", a->size_px, "picture width and height [px]")
      ->required()
      ->expected(2);
  command
      ->add_option("--center", a->center_px,
                   "principal point Cx Cy [px] (default: the picture's centre)")
      ->expected(2);
  command
      ->add_option("--sx", a->sx, "scale factor sx, for coplanar points, which do not determine it")
      ->capture_default_str();
  command->add_flag("--fixed-center", a->fixed_center, "do not refine Cx and Cy");
  command->add_option("--out", a->out, "output calibration.toml")->required();
  command->callback([a] { RunTsai(*a); });
}

}  // namespace

void AddCalibrateCommand(CLI::App& app) {
  CLI::App* command = app.add_subcommand("calibrate", "Calibrate a studio, or do one step of it");
  command->require_subcommand(1);
  AddPrintedBoard(command);
  AddStudio(command);
  AddIntrinsics(command);
  AddExtrinsics(command);
  AddFloor(command);
  AddPanTilt(command);
  AddHealth(command);
  AddRefine(command);
  AddTsai(command);
  AddCheck(command);
  AddConvert(command);
}

}  // namespace mocap
