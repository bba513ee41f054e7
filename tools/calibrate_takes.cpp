#include "tools/calibrate_takes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <vector>

#include "config/load_config.h"
#include "core/errors.h"
#include "daemon/json_object.h"
#include "drivers/calibration_file.h"
#include "drivers/quoted.h"
#include "tools/calibration/footage.h"
#include "tools/calibration/head_fit.h"
#include "tools/calibration/sightings.h"
#include "tools/camera_health.h"

namespace mocap {
namespace {

constexpr int kHealthMoments = 16;
constexpr double kEncoderTolerance = 0.005;

struct PanTiltArguments {
  std::filesystem::path calibration, out;
  std::vector<std::filesystem::path> footage;
  std::string board;
};

struct TakeArguments {
  std::filesystem::path take, out;
  double from_s = 0, to_s = 10;
  bool json = false;
};

// Views of one camera; each recording is a place of the board.
std::vector<BoardSighting> ViewsOf(const std::string& camera,
                                   const std::vector<BoardSightings>& recordings) {
  std::vector<BoardSighting> views;
  for (std::size_t place = 0; place < recordings.size(); ++place) {
    for (BoardSighting view : recordings[place].sightings) {
      if (recordings[place].cameras[static_cast<std::size_t>(view.camera)].name != camera) continue;
      view.moment = static_cast<int>(place);
      views.push_back(std::move(view));
    }
  }
  return views;
}

void RunPanTilt(const PanTiltArguments& a) {
  const Board board = ParseBoard(a.board);
  std::vector<CameraCalibration> cameras = LoadCalibration(a.calibration);
  std::vector<BoardSightings> recordings;
  SightingOptions options;
  options.all_must_see = false;
  for (const std::filesystem::path& folder : a.footage)
    recordings.push_back(CollectSightings(OpenFootage(folder), board, options));
  for (CameraCalibration& camera : cameras) {
    const std::vector<BoardSighting> views = ViewsOf(camera.name, recordings);
    const bool turns = std::any_of(views.begin(), views.end(), [](const BoardSighting& view) {
      return view.angles != PanTiltAngles{};
    });
    if (!turns) continue;
    camera.head.reset();
    const HeadFit fit = FitHead(camera, board, views);
    camera.head = fit.head;
    std::fprintf(stdout, "%s: %d views, %.3f px, encoder scale %.4f (pan) %.4f (tilt)\n",
                 camera.name.c_str(), fit.views, fit.rms_px, fit.pan_scale, fit.tilt_scale);
    if (std::abs(fit.pan_scale - 1) > kEncoderTolerance ||
        std::abs(fit.tilt_scale - 1) > kEncoderTolerance)
      std::fprintf(
          stdout,
          "look: %s: its encoder counts wrongly; multiply its angles by these scales where "
          "they are read, then run this again\n",
          camera.name.c_str());
  }
  if (std::none_of(cameras.begin(), cameras.end(),
                   [](const CameraCalibration& c) { return c.head.has_value(); }))
    throw SetupError(a.footage.front().string() +
                     ": no camera turns; camN.csv with pan_rad,tilt_rad is wanted");
  WriteCalibration(a.out, cameras);
}

const char* Directions(const Vector2& shift) {
  if (std::abs(shift.x()) > std::abs(shift.y())) return shift.x() > 0 ? "right" : "left";
  return shift.y() > 0 ? "down" : "up";
}

std::string ShiftText(const std::vector<CameraShift>& shifts) {
  std::string text;
  for (const CameraShift& s : shifts) {
    text +=
        s.moments == 0
            ? fmt::format("{}: sees no whole person\n", s.camera)
            : fmt::format("{}: {:.1f} px {} ({:+.1f}, {:+.1f}; spread {:.1f}), overlap {:.0f} %\n",
                          s.camera, s.shift_px.norm(), Directions(s.shift_px), s.shift_px.x(),
                          s.shift_px.y(), s.spread_px, 100 * s.overlap);
  }
  return text;
}

std::string ShiftJson(const RefinedStudio& refined) {
  JsonObject json;
  const auto list = [](const std::vector<CameraShift>& shifts) {
    JsonObject cameras;
    for (const CameraShift& s : shifts) {
      JsonObject one;
      one.Add("right_px", s.shift_px.x(), 2);
      one.Add("down_px", s.shift_px.y(), 2);
      one.Add("overlap", s.overlap, 3);
      one.Add("moments", s.moments);
      cameras.Add(s.camera, one);
    }
    return cameras;
  };
  json.Add("before", list(refined.before));
  json.Add("after", list(refined.after));
  std::string moved;
  for (const std::string& name : refined.moved) moved += (moved.empty() ? "" : ",") + name;
  json.Add("moved", moved);
  return json.Text() + '\n';
}

TakeSamples Sample(const TakeArguments& a) {
  return SampleTake(a.take, ChooseHealthMoments(a.take, a.from_s, a.to_s, kHealthMoments), 50);
}

void Print(const TakeArguments& a, const RefinedStudio& refined) {
  std::string text = a.json ? ShiftJson(refined) : ShiftText(refined.before);
  if (!a.json) {
    for (const std::string& name : refined.moved)
      text += name + ": has moved since it was calibrated\n";
    if (refined.moved.empty()) text += "no camera has moved\n";
  }
  std::fputs(text.c_str(), stdout);
}

void AddTake(CLI::App* command, const std::shared_ptr<TakeArguments>& a) {
  command->add_option("TAKE", a->take, "a take in which a person moves about")->required();
  command->add_option("--from", a->from_s, "first second that is looked at")->capture_default_str();
  command->add_option("--to", a->to_s, "last second that is looked at")->capture_default_str();
  command->add_flag("--json", a->json, "print one JSON object");
}

}  // namespace

void AddPanTilt(CLI::App* parent) {
  const auto a = std::make_shared<PanTiltArguments>();
  CLI::App* command = parent->add_subcommand(
      "pan-tilt", "Axes of heads, from a board that lies still while the cameras turn");
  command->add_option("CALIBRATION", a->calibration, "calibration.toml at pan = tilt = 0")
      ->required();
  command
      ->add_option("--footage", a->footage,
                   "recording with camN.csv of pan_rad,tilt_rad; one for each place of the board")
      ->required();
  command->add_option("--board", a->board, "as for mocap calibrate studio")->required();
  command->add_option("--out", a->out, "calibration.toml to write")->required();
  command->callback([a] { RunPanTilt(*a); });
}

void AddHealth(CLI::App* parent) {
  const auto a = std::make_shared<TakeArguments>();
  CLI::App* command =
      parent->add_subcommand("health", "Whether cameras still stand where they were calibrated");
  AddTake(command, a);
  command->callback([a] { Print(*a, RefineFromSilhouettes(Sample(*a))); });
}

void AddRefine(CLI::App* parent) {
  const auto a = std::make_shared<TakeArguments>();
  CLI::App* command = parent->add_subcommand(
      "refine", "Puts small motions of cameras right, from silhouettes of a moving person alone");
  AddTake(command, a);
  command->add_option("--out", a->out, "calibration.toml to write")->required();
  command->callback([a] {
    const RefinedStudio refined = RefineFromSilhouettes(Sample(*a));
    WriteCalibration(a->out, refined.cameras);
    Print(*a, refined);
    if (!a->json) std::fputs(("after:\n" + ShiftText(refined.after)).c_str(), stdout);
  });
}

}  // namespace mocap
