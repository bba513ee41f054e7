#include "tools/calibrate.h"

#include <cstdio>
#include <fstream>
#include <functional>
#include <memory>
#include <stdexcept>

#include "config/load_config.h"
#include "core/errors.h"
#include "drivers/calibration_file.h"
#include "tools/calibrate_steps.h"

namespace mocap {
namespace {

using Arguments = std::shared_ptr<CalibrateArguments>;

void Finish(const CalibrateArguments& arguments, const StudioFit& fit) {
  const std::vector<Finding> findings = CheckAll(arguments, fit);
  WriteCalibration(arguments.out, fit.bundle.cameras);
  const std::string text = arguments.json ? FitJson(fit, findings) : FitText(fit, findings);
  std::fputs(text.c_str(), stdout);
}

void AddFootage(CLI::App* command, const Arguments& a) {
  command
      ->add_option("FOOTAGE", a->footage, "a take, or a folder with a video or pictures a camera")
      ->required();
  command
      ->add_option("--board", a->board,
                   "chess:COLUMNSxROWS:MM (inner corners) or "
                   "charuco:COLUMNSxROWS:MM[:DICTIONARY][:MARKER_SHARE][:inverted] (squares)")
      ->required();
  command->add_option("--most-frames", a->most_frames, "look at so many frames of a camera")
      ->capture_default_str()
      ->check(CLI::Range(1, 100000));
}

void AddOutput(CLI::App* command, const Arguments& a) {
  command->add_option("--out", a->out, "calibration.toml to write")->required();
  command->add_flag("--json", a->json, "print one JSON object");
}

void AddLens(CLI::App* command, const Arguments& a) {
  command->add_option("--lens", a->lens, "lens model: tsai, opencv or fisheye")
      ->capture_default_str()
      ->check(CLI::IsMember({"tsai", "opencv", "fisheye"}));
  command->add_option("--pitch", a->pitch_mm, "Tsai's dx dy: size of a pixel [mm]")->expected(2);
}

void AddWorld(CLI::App* command, const Arguments& a) {
  command->add_option("--floor", a->floor,
                      "footage of the board lying on the floor: origin and axes");
  command->add_option("--floor-points", a->floor_points,
                      "CSV of three floor points instead: origin|x|y,CAMERA,X,Y");
  command->add_option("--thickness", a->thickness_mm,
                      "the board's printed side above the floor [mm]");
  command->add_option("--distance", a->distance,
                      "two cameras' distance measured with a tape, CAMERA:CAMERA:MM");
  command->add_flag("--set-scale", a->set_scale,
                    "make the world agree with --distance instead of checking against it");
}

void AddStudio(CLI::App* parent) {
  const auto a = std::make_shared<CalibrateArguments>();
  CLI::App* command = parent->add_subcommand("studio", "All cameras from a board carried about");
  AddFootage(command, a);
  AddOutput(command, a);
  AddLens(command, a);
  AddWorld(command, a);
  command->callback([a] { Finish(*a, CalibrateStudio(*a)); });
}

void AddIntrinsics(CLI::App* parent) {
  const auto a = std::make_shared<CalibrateArguments>();
  CLI::App* command = parent->add_subcommand("intrinsics", "Lenses alone");
  AddFootage(command, a);
  AddOutput(command, a);
  AddLens(command, a);
  command->callback([a] { Finish(*a, CalibrateIntrinsics(*a)); });
}

void AddExtrinsics(CLI::App* parent) {
  const auto a = std::make_shared<CalibrateArguments>();
  CLI::App* command =
      parent->add_subcommand("extrinsics", "Poses of cameras whose lenses are known");
  AddFootage(command, a);
  AddOutput(command, a);
  AddWorld(command, a);
  command->add_option("--intrinsics", a->intrinsics, "calibration.toml with the lenses")
      ->required();
  command->add_flag("--still", a->still,
                    "the board lies still on the floor where all cameras see it: it is the world");
  command->add_flag("--keep-lenses", a->keep_lenses, "leave the lenses as they are");
  command->callback([a] { Finish(*a, CalibrateExtrinsics(*a)); });
}

void AddFloor(CLI::App* parent) {
  const auto a = std::make_shared<CalibrateArguments>();
  CLI::App* command =
      parent->add_subcommand("floor", "Floor, origin, axes and scale of a calibration");
  command->add_option("CALIBRATION", a->calibration, "calibration.toml")->required();
  command->add_option("--board", a->board, "the board on the floor, as for mocap calibrate studio");
  AddOutput(command, a);
  AddWorld(command, a);
  command->callback([a] {
    if (a->floor.empty() == a->floor_points.empty())
      throw SetupError("mocap calibrate floor: either --floor or --floor-points is wanted");
    StudioFit fit;
    fit.bundle.cameras = LoadCalibration(a->calibration);
    SetWorld(*a, fit);
    WriteCalibration(a->out, fit.bundle.cameras);
    const std::string verdict = Verdict(CheckAll(*a, fit)) + '\n';
    std::fputs(verdict.c_str(), stdout);
  });
}

}  // namespace

void AddCalibrateCommand(CLI::App& app) {
  CLI::App* command = app.add_subcommand("calibrate", "Calibrates a studio, or one step of it");
  command->require_subcommand(1);
  AddStudio(command);
  AddIntrinsics(command);
  AddExtrinsics(command);
  AddFloor(command);
}

}  // namespace mocap
