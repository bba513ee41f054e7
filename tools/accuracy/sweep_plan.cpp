#include "tools/accuracy/sweep_plan.h"

#include <fmt/format.h>

#include <numbers>

#include "config/load_config.h"

namespace mocap {

std::vector<SweepPlan> PlannedSweeps() {
  const auto cameras = [](int count) {
    return SweepStep{std::to_string(count),
                     [count](AccuracyTrial& trial) { trial.studio.cameras = count; }};
  };
  const auto voxels = [](int edge_mm) {
    return SweepStep{std::to_string(edge_mm),
                     [edge_mm](AccuracyTrial& trial) { trial.voxel_mm = edge_mm; }};
  };
  const auto covered = [](int percent) {
    return SweepStep{std::to_string(percent),
                     [percent](AccuracyTrial& trial) { trial.covered_share = percent / 100.0; }};
  };
  const auto calibration = [](int error_px) {
    return SweepStep{std::to_string(error_px),
                     [error_px](AccuracyTrial& trial) { trial.calibration_error_px = error_px; }};
  };
  const auto happens = [](const char* what, Mishap mishap) {
    return SweepStep{what, [mishap](AccuracyTrial& trial) { trial.mishap = mishap; }};
  };
  std::vector<SweepStep> trackers;
  for (const NamedTracker& tracker : Trackers()) {
    trackers.push_back({tracker.name, [tracker](AccuracyTrial& trial) {
                          trial.tracker = tracker.kind;
                          trial.body = tracker.body;
                        }});
  }
  return {{"cameras", "cameras", {cameras(4), cameras(5), cameras(6), cameras(8)}},
          {"voxels", "edge of a voxel [mm]", {voxels(10), voxels(25), voxels(50)}},
          {"covered",
           "pictures covered by squares [%]",
           {covered(0), covered(2), covered(5), covered(10)}},
          {"calibration",
           "error of calibration [px]",
           {calibration(0), calibration(1), calibration(2), calibration(5)}},
          {"mishap",
           "one camera of six, from the middle on",
           {happens("well", Mishap::kNone), happens("lost", Mishap::kLost),
            happens("blinded", Mishap::kBlinded), happens("turned by 20 px", Mishap::kTurned)}},
          {"tracker", "tracker", trackers}};
}

SweepPlan PlannedStudios() {
  const auto cameras = [](int count) {
    return SweepStep{fmt::format("{} cameras", count),
                     [count](AccuracyTrial& trial) { trial.studio.cameras = count; }};
  };
  const auto arc = [](const char* part, double share) {
    return SweepStep{fmt::format("all along {} of the circle", part),
                     [share](AccuracyTrial& trial) {
                       trial.studio.camera_arc_rad = share * 2 * std::numbers::pi;
                     }};
  };
  const auto height = [](double height_mm) {
    return SweepStep{
        fmt::format("{:.1f} m high", height_mm / 1000),
        [height_mm](AccuracyTrial& trial) { trial.studio.camera_height_mm = height_mm; }};
  };
  const auto pictures = [](int width_px, int height_px) {
    return SweepStep{fmt::format("{} × {} px", width_px, height_px),
                     [width_px, height_px](AccuracyTrial& trial) {
                       trial.studio.width_px = width_px;
                       trial.studio.height_px = height_px;
                     }};
  };
  const auto rate = [](int fps) {
    return SweepStep{fmt::format("{} Hz", fps),
                     [fps](AccuracyTrial& trial) { trial.studio.fps = fps; }};
  };
  return {"studio",
          "studio",
          {{"six VGA cameras all around, 2.55 m high, 30 Hz", [](AccuracyTrial&) {}},
           cameras(2),
           {"2 cameras at a right angle",
            [](AccuracyTrial& trial) {
              trial.studio.cameras = 2;
              trial.studio.camera_arc_rad = std::numbers::pi;
            }},
           cameras(3),
           cameras(4),
           cameras(8),
           arc("half", 0.5),
           arc("a quarter", 0.25),
           height(1200),
           height(1800),
           pictures(160, 120),
           pictures(320, 240),
           pictures(1280, 960),
           rate(10)}};
}

}  // namespace mocap
