#include "tools/calibrate_takes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <stdexcept>
#include <vector>

#include "config/load_config.h"
#include "config/take_header.h"
#include "core/calibration/diagnosis_text.h"
#include "core/errors.h"
#include "daemon/base/json.h"
#include "drivers/clock.h"
#include "drivers/take/calibration_file.h"
#include "drivers/take/take_layout.h"
#include "drivers/take/text_file.h"
#include "tools/calibration/detections.h"
#include "tools/calibration/footage.h"
#include "tools/calibration/head_fit.h"
#include "tools/calibration/same_calibration.h"
#include "tools/camera_health.h"
#include "tools/remarks.h"
#include "tools/studio_examination.h"

namespace mocap {
namespace {

constexpr int kHealthMoments = 16;

struct PanTiltArguments {
  std::filesystem::path calibration, out, posed_by;
  std::vector<std::filesystem::path> footage;
  std::string board;
};

struct TakeArguments {
  std::filesystem::path take, out, note;
  double from_s = 0, to_s = 10;
  bool json = false;
};

// Views of one camera; in each recording the board is at another place.
std::vector<BoardDetection> ViewsOf(const std::string& camera,
                                    const std::vector<BoardDetections>& recordings) {
  std::vector<BoardDetection> views;
  for (std::size_t place = 0; place < recordings.size(); ++place) {
    for (BoardDetection view : recordings[place].detections) {
      if (recordings[place].cameras[static_cast<std::size_t>(view.camera)].name != camera) continue;
      view.moment = static_cast<int>(place);
      views.push_back(std::move(view));
    }
  }
  return views;
}

// Encoder readings of a camera during the recording that gave its pose.
PanTiltAngles PosedAt(const std::string& camera, const Footage& posed_by) {
  for (const FootageCamera& recorded : posed_by.cameras) {
    if (recorded.name != camera) continue;
    std::vector<PanTiltAngles> readings;
    for (const FootageFrame& frame : recorded.frames) readings.push_back(frame.angles);
    return StandingAngles(camera, readings);
  }
  throw SetupError(posed_by.folder.string() + ": has no recording of " + camera);
}

void RunPanTilt(const PanTiltArguments& a) {
  RequireWritable(a.out);
  const Board board = ParseBoard(a.board);
  std::vector<CameraCalibration> cameras = LoadCalibration(a.calibration);
  std::vector<BoardDetections> recordings;
  DetectionOptions options;
  options.all_must_see = false;
  for (const std::filesystem::path& folder : a.footage)
    recordings.push_back(CollectDetections(OpenFootage(folder), board, options));
  const Footage posed_by = a.posed_by.empty() ? Footage{} : OpenFootage(a.posed_by);
  for (CameraCalibration& camera : cameras) {
    const std::vector<BoardDetection> views = ViewsOf(camera.name, recordings);
    const bool turns = std::any_of(views.begin(), views.end(), [](const BoardDetection& view) {
      return view.angles != PanTiltAngles{};
    });
    if (!turns) continue;
    camera.head.reset();
    const PanTiltAngles posed_at =
        a.posed_by.empty() ? PanTiltAngles{} : PosedAt(camera.name, posed_by);
    const PanTiltFit fit = FitHead(camera, posed_at, board, views);
    camera.head = fit.head;
    const std::string line = fmt::format(
        "{}: {} views, {:.3f} px; encoders' scale {:.4f} (pan) {:.4f} (tilt), zero {:.4f} {:.4f} "
        "rad\n",
        camera.name, fit.views, fit.rms_px, fit.head.pan_scale, fit.head.tilt_scale,
        posed_at.pan_rad, posed_at.tilt_rad);
    std::fputs(line.c_str(), stdout);
  }
  if (std::none_of(cameras.begin(), cameras.end(),
                   [](const CameraCalibration& c) { return c.head.has_value(); }))
    throw SetupError(a.footage.front().string() +
                     ": no camera turns; expected camN.csv with pan_rad,tilt_rad");
  WriteCalibration(a.out, cameras, LoadCalibrationRecord(a.calibration));
}

const char* Directions(const Vector2& shift) {
  if (std::abs(shift.x()) > std::abs(shift.y())) return shift.x() > 0 ? "right" : "left";
  return shift.y() > 0 ? "down" : "up";
}

/// A number with one decimal place; no zero is negative.
double Tenths(double value) { return std::round(10 * value) / 10 + 0.0; }

std::string ShiftText(const std::vector<CameraShift>& shifts) {
  std::string text = fmt::format("{:<12}{:>7}  {:<8}{:>16}{:>9}{:>9}{:>9}\n", "camera", "px",
                                 "towards", "(right, down)", "spread", "larger", "overlap");
  for (const CameraShift& s : shifts) {
    text += s.moments == 0
                ? fmt::format("{:<12}sees too little of the person for a check\n", s.camera)
                : fmt::format("{:<12}{:>7.1f}  {:<8}{:>16}{:>9.1f}{:>7.1f} %{:>7.0f} %\n", s.camera,
                              s.shift_px.norm(), Directions(s.shift_px),
                              fmt::format("({:+.1f}, {:+.1f})", Tenths(s.shift_px.x()),
                                          Tenths(s.shift_px.y())),
                              s.spread_px, Tenths(100 * s.growth), 100 * s.overlap);
  }
  return text;
}

std::string ShiftJson(const RefinedStudio& refined) {
  Json json = Json::object();
  const auto list = [](const std::vector<CameraShift>& shifts) {
    Json cameras = Json::object();
    for (const CameraShift& s : shifts) {
      Json one = Json::object();
      one["right_px"] = Rounded(s.shift_px.x(), 2);
      one["down_px"] = Rounded(s.shift_px.y(), 2);
      one["growth"] = Rounded(s.growth, 4);
      one["overlap"] = Rounded(s.overlap, 3);
      one["moments"] = s.moments;
      cameras[s.camera] = one;
    }
    return cameras;
  };
  json["before"] = list(refined.before);
  json["after"] = list(refined.after);
  std::string moved;
  for (const std::string& name : refined.moved) moved += (moved.empty() ? "" : ",") + name;
  json["moved"] = moved;
  return JsonText(json) + '\n';
}

std::string ConclusionText(const RefinedStudio& refined) {
  std::string text;
  for (const std::string& change : ChangesOf(refined)) text += change + '\n';
  return text.empty() ? "no camera has moved\n" : text;
}

std::vector<CameraOffset> OffsetsOf(const std::vector<CameraShift>& shifts,
                                    const std::vector<std::string>& moved) {
  std::vector<CameraOffset> offsets;
  for (const CameraShift& s : shifts) {
    const bool has_moved = std::find(moved.begin(), moved.end(), s.camera) != moved.end();
    if (s.moments > 0) offsets.push_back({s.camera, s.shift_px.norm(), has_moved || IsZoomed(s)});
  }
  return offsets;
}

// Corrections of poses cannot mend pictures of other cameras.
void RequireRightPictures(const std::filesystem::path& take, const TakeSamples& samples) {
  const StudioDiagnosis diagnosis = Diagnose(samples.cameras, MomentsOf(samples));
  const bool are_others =
      diagnosis.fault == StudioFault::kExchanged || diagnosis.fault == StudioFault::kUpsideDown ||
      diagnosis.fault == StudioFault::kMirrored || diagnosis.fault == StudioFault::kUnit;
  if (!are_others) return;
  throw SetupError(take.string() + ": " + FindingOf(diagnosis, samples.cameras)->text);
}

RefinedStudio Refined(const TakeArguments& a) {
  const TakeSamples samples =
      SampleTake(a.take, ChooseHealthMoments(a.take, a.from_s, a.to_s, kHealthMoments), 50);
  TellRemarks("calibrate", samples.remarks);
  RequireRightPictures(a.take, samples);
  try {
    return RefineFromSilhouettes(samples);
  } catch (const SetupError& error) {
    throw SetupError(a.take.string() + ": " + error.what());
  }
}

/// What a take says of its cameras may only be noted in their own calibration.
void RequireOwnCalibration(const TakeArguments& a) {
  ReadTakeHeader(a.take);
  const std::filesystem::path own = TakeLayout{a.take}.Calibration();
  const std::string difference = DifferenceFrom(LoadCalibration(own), LoadCalibration(a.note));
  if (difference.empty()) return;
  throw SetupError(a.note.string() + ": " + difference + " than " + own.string() +
                   "; expected the calibration with which the take was recorded");
}

void RunHealth(const TakeArguments& a) {
  if (!a.note.empty()) {
    RequireWritable(a.note);
    RequireOwnCalibration(a);
  }
  const RefinedStudio refined = Refined(a);
  const std::string text =
      a.json ? ShiftJson(refined) : ShiftText(refined.before) + ConclusionText(refined);
  std::fputs(text.c_str(), stdout);
  if (!a.note.empty()) {
    CalibrationRecord record = LoadCalibrationRecord(a.note);
    record.checked_s = TimeOfDayS();
    record.offsets = OffsetsOf(refined.before, refined.moved);
    WriteCalibration(a.note, LoadCalibration(a.note), record);
  }
  if (!ChangesOf(refined).empty())
    throw std::runtime_error(a.take.string() + ": not all cameras are as calibrated, see above");
}

void RunRefine(const TakeArguments& a) {
  RequireWritable(a.out);
  const RefinedStudio refined = Refined(a);
  CalibrationRecord record = LoadCalibrationRecord(TakeLayout{a.take}.Calibration());
  record.refined_s = record.checked_s = TimeOfDayS();
  record.offsets = OffsetsOf(refined.after, {});
  WriteCalibration(a.out, refined.cameras, record);
  const bool is_own = std::filesystem::equivalent(a.out, TakeLayout{a.take}.Calibration());
  std::string text = ShiftText(refined.before) + ConclusionText(refined);
  if (!refined.moved.empty()) text += "after:\n" + ShiftText(refined.after);
  text += fmt::format("written: {}{}\n", a.out.string(), is_own ? ", the take's own" : "");
  std::fputs((a.json ? ShiftJson(refined) : text).c_str(), stdout);
}

void AddTake(CLI::App* command, const std::shared_ptr<TakeArguments>& a) {
  command->add_option("TAKE", a->take, "take in which a person walks about")->required();
  command->add_option("--from", a->from_s, "start of the evaluated time [s]")
      ->capture_default_str();
  command->add_option("--to", a->to_s, "end of the evaluated time [s]")->capture_default_str();
  command->add_flag("--json", a->json, "print one JSON object");
}

}  // namespace

void AddPanTilt(CLI::App* parent) {
  const auto a = std::make_shared<PanTiltArguments>();
  CLI::App* command = parent->add_subcommand(
      "pan-tilt",
      "Calibrate the axes of pan-tilt heads, from a board that lies still while the cameras turn");
  command->add_option("CALIBRATION", a->calibration, "input calibration.toml, with extrinsics")
      ->required();
  command->add_option("--posed-by", a->posed_by,
                      "recording from which the extrinsics were calibrated: they hold at its "
                      "encoder readings (default: at zero)");
  command
      ->add_option("--footage", a->footage,
                   "recording with pan_rad,tilt_rad in camN.csv, one for each place of the board")
      ->required();
  command->add_option("--board", a->board, "board, as for mocap calibrate studio")->required();
  command->add_option("--out", a->out, "output calibration.toml")->required();
  command->callback([a] { RunPanTilt(*a); });
}

void AddHealth(CLI::App* parent) {
  const auto a = std::make_shared<TakeArguments>();
  CLI::App* command = parent->add_subcommand(
      "health", "Check whether the cameras are still where they were calibrated");
  AddTake(command, a);
  command->add_option("--note", a->note,
                      "calibration.toml in use, to store the result in, for mocap calibrate check");
  command->callback([a] { RunHealth(*a); });
}

void AddRefine(CLI::App* parent) {
  const auto a = std::make_shared<TakeArguments>();
  CLI::App* command = parent->add_subcommand(
      "refine",
      "Correct the extrinsics of slightly moved cameras, from silhouettes of a walking person");
  AddTake(command, a);
  command->add_option("--out", a->out, "output calibration.toml")->required();
  command->callback([a] { RunRefine(*a); });
}

}  // namespace mocap
