// What may be chosen about a studio that does not exist.
#pragma once

#include <cstdint>
#include <numbers>
#include <optional>
#include <string>

namespace mocap {

/// Options of the simulated studio. The same options give the same pictures and truth.
struct SimulatedStudioOptions {
  std::string motion = "walk";  ///< As in simulation::MakeCompany().
  int people = 1;               ///< 1 to simulation::kMostSimulatedPeople.
  double stature_mm = 1750;     ///< Of the first, 1000 to 2100; others have a similar one.
  bool varied = false;  ///< Builds, hair, hats, clothes and loads as varied as among real people.
  double fps = 30;
  int cameras = 6;
  int width_px = 640, height_px = 480;
  double camera_height_mm = 2550;                ///< As in simulation::RigOptions,
  double camera_arc_rad = 2 * std::numbers::pi;  ///< and this.
  /// Clothes differ from what is behind them, in every picture, by at most this many of 256 grey
  /// values: 5 to 100. Skin and hair keep their colours. 0: clothes have any colours.
  double contrast = 0;
  /// Lamps are panels as wide as a person: shadows have wide penumbras, and fall on walls and
  /// furniture, too.
  bool soft_shadows = false;
  /// Share of the cameras, rounded up and chosen at random, that are misled: to such a camera,
  /// either all shirts or all trousers look exactly like the empty room behind them.
  double misled_share = 0;
  /// Cameras without a common trigger: the pictures of a set are taken up to this far apart, below
  /// half a period.
  double apart_s = 0;
  /// Pictures, with those of the empty room, are coded by x264 at this constant rate factor and
  /// decoded again: 0 to 51. Not in real time, nor with heads that follow commands.
  std::optional<int> crf = {};
  bool pan_tilt = false;  ///< Heads follow the person by themselves; slower to render.
  /// With pan_tilt: heads turn on command, as tracking demands.
  bool follow = false;
  std::uint64_t seed = 1;  ///< Person, clothes, room, lenses and path.
  bool realtime = false;   ///< Frames come when due on the timeline.
  double seconds = 0;      ///< Length unless realtime; 0: endless.
  /// How often each camera is lost for some seconds; only in real time.
  double losses_per_minute = 0;
  /// Capture time at which the motion begins. It may stay 0 in real time: the motion then follows
  /// the clock, and any process with these options can compute the truth of a capture time.
  std::int64_t start_ns = 0;
  double begin_s = 0;  ///< How much of the motion has passed at start_ns.
};

/// Options for frames rendered as fast as possible, starting at a fixed time: 1000 s after the Unix
/// epoch.
SimulatedStudioOptions RecordedSimulation();

}  // namespace mocap
