// A simulated studio: cameras render moving people, with truth.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/geometry.h"
#include "drivers/camera_driver.h"
#include "drivers/simulation/simulated_head.h"
#include "drivers/simulation/skeleton.h"
#include "drivers/studio.h"
#include "drivers/subject_position.h"
#include "drivers/take/take_writer.h"

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

/// p_WQ of the points named by kSimulatedJointNames [mm].
using JointPositions = simulation::TruePoints;
inline constexpr auto& kSimulatedJointNames = simulation::kTruthPointNames;

namespace simulation {
class Person;
class Scene;
class SceneView;
class ScenePainter;
class PictureAhead;
class CodedFrames;
}  // namespace simulation

/// How much of a person is visible.
struct PersonPresence {
  bool in_room = false;  ///< Any part of the body is on the room's side of the door.
  bool whole = false;    ///< The whole body is.
  int pictures = 0;      ///< Number that have the whole body within their borders, hidden or not.
};

/// A person is covered if this many pictures have the whole body.
inline constexpr int kCoveringPictures = 4;

/// True joint positions of the simulated people, numbered from 0. Reentrant.
class SimulatedTruth {
 public:
  /// @throws SetupError  for invalid options.
  explicit SimulatedTruth(const SimulatedStudioOptions& options);
  ~SimulatedTruth();
  SimulatedTruth(SimulatedTruth&&) noexcept;

  JointPositions At(std::int64_t capture_ns, int person = 0) const;
  TruthSizes Sizes(int person = 0) const;

 private:
  std::vector<simulation::Person> people_;
};

/// One virtual camera. In real time it paints pictures before they are due, unless its head may be
/// commanded to turn meanwhile.
class SimulatedCamera : public CameraDriver {
 public:
  /// @param head  turns the camera; null: its direction is a function of time.
  explicit SimulatedCamera(std::shared_ptr<const simulation::SceneView> view,
                           std::shared_ptr<SimulatedHead> head = nullptr);
  ~SimulatedCamera() override;

  void Start() override;
  GrabStatus Grab(Frame& frame, std::chrono::milliseconds timeout) override;
  void Stop() override;
  /// Mask of all people visible in the last frame: 255, else 0. Valid until the next call.
  ImageView<const std::uint8_t> TrueMask();
  /// The same as a silhouette, as exact as pixels allow.
  Silhouette TrueSilhouette();

 private:
  GrabStatus GrabPainted(Frame& frame, std::chrono::milliseconds timeout);
  bool PrepareNext();
  void Paint();
  bool IsLost(std::int64_t time_ns) const;

  std::shared_ptr<const simulation::SceneView> view_;
  std::shared_ptr<SimulatedHead> head_;
  std::unique_ptr<simulation::ScenePainter> painter_;
  std::unique_ptr<simulation::PictureAhead> ahead_;
  std::unique_ptr<simulation::CodedFrames> coded_;  ///< If they are coded.
  std::int64_t first_ = 0, next_ = 0;
  bool started_ = false, prepared_ = false;
  std::int64_t due_ns_ = 0;
  Image<std::uint8_t> mask_;
};

/// The studio before its cameras are opened.
class SimulatedStudio {
 public:
  /// @throws SetupError  for invalid options.
  explicit SimulatedStudio(const SimulatedStudioOptions& options);

  const std::vector<CameraCalibration>& cameras() const;
  std::unique_ptr<SimulatedCamera> OpenCamera(int camera) const;
  /// Opens a camera whose head follows the subject.
  std::unique_ptr<CameraDriver> OpenFollowing(int camera,
                                              std::shared_ptr<const SubjectPosition> person) const;
  /// Pictures of the empty studio; for a camera on a head, a scan of its directions.
  std::vector<BackgroundFrame> Background(int camera) const;
  /// Time of a frame without jitter of the cameras.
  std::int64_t NominalTime(std::int64_t frame) const;
  PersonPresence PresenceOf(int person, std::int64_t capture_ns) const;

 private:
  std::shared_ptr<const simulation::Scene> scene_;
  std::vector<std::shared_ptr<const simulation::SceneView>> views_;
};

/// Opens the simulated studio as a source of frames. Cameras share one immutable scene.
/// @throws SetupError  for invalid options.
Studio OpenSimulatedStudio(const SimulatedStudioOptions& options);

}  // namespace mocap
