// A studio that exists in the computer only: cameras render moving people, with truth.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
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

/// What happens in the simulated studio. The same options give the same pictures and truth.
struct SimulatedStudioOptions {
  std::string motion = "walk";  ///< As simulation::MakeCompany() has it.
  int people = 1;               ///< 1 to simulation::kMostSimulatedPeople.
  double stature_mm = 1750;     ///< Of the first, 1000 to 2100; others are of about his size.
  double fps = 30;
  int cameras = 6;
  int width_px = 640, height_px = 480;
  bool pan_tilt = false;  ///< Heads go after the person by themselves; slower to render.
  /// With pan_tilt: heads turn when they are told to, as tracking wants it.
  bool follow = false;
  std::uint64_t seed = 1;  ///< Person, clothes, room, lenses and path.
  bool realtime = false;   ///< Frames come when the system clock says that they are due.
  double seconds = 0;      ///< Length unless realtime; 0: without end.
  /// How often each camera is lost for some seconds, in real time only.
  double losses_per_minute = 0;
  /// Capture time at which the motion begins. In real time it may stay 0: then the motion follows
  /// the clock, and any process with these options knows the truth of a capture time.
  std::int64_t start_ns = 0;
};

/// Gives options for frames as fast as they are rendered, from a fixed time on: 1000 s after the
/// Unix epoch.
SimulatedStudioOptions RecordedSimulation();

/// p_WQ of the points that kSimulatedJointNames tells [mm].
using JointPositions = simulation::TruePoints;
inline constexpr auto& kSimulatedJointNames = simulation::kTruthPointNames;

namespace simulation {
class Person;
class Scene;
class SceneView;
class ScenePainter;
class PictureAhead;
}  // namespace simulation

/// How much of somebody is to be seen.
struct PersonPresence {
  bool in_room = false;  ///< Any part of the body is on this side of the door.
  bool whole = false;    ///< All of it is.
  int pictures = 0;      ///< That have all of the body within their borders, hidden or not.
};

/// So many pictures that have all of somebody cover him.
inline constexpr int kCoveringPictures = 4;

/// Where the simulated people's joints truly are. People are numbered from 0. Reentrant.
class SimulatedTruth {
 public:
  /// @throws SetupError  when the options cannot be.
  explicit SimulatedTruth(const SimulatedStudioOptions& options);
  ~SimulatedTruth();
  SimulatedTruth(SimulatedTruth&&) noexcept;

  JointPositions At(std::int64_t capture_ns, int person = 0) const;
  TruthSizes Sizes(int person = 0) const;

 private:
  std::vector<simulation::Person> people_;
};

/// One virtual camera. In real time it paints ahead of the time when a picture is due, unless its
/// head is told where to turn meanwhile.
class SimulatedCamera : public CameraDriver {
 public:
  /// @param head  turns the camera; null: where it points follows from the time.
  explicit SimulatedCamera(std::shared_ptr<const simulation::SceneView> view,
                           std::shared_ptr<SimulatedHead> head = nullptr);
  ~SimulatedCamera() override;

  void Start() override;
  GrabStatus Grab(Frame& frame, std::chrono::milliseconds timeout) override;
  void Stop() override;
  /// Where anybody is visible in the last frame: 255, else 0. Valid until the next call.
  ImageView<const std::uint8_t> TrueMask();

 private:
  bool PrepareNext();
  void Paint();
  bool IsLost(std::int64_t time_ns) const;

  std::shared_ptr<const simulation::SceneView> view_;
  std::shared_ptr<SimulatedHead> head_;
  std::unique_ptr<simulation::ScenePainter> painter_;
  std::unique_ptr<simulation::PictureAhead> ahead_;
  std::int64_t first_ = 0, next_ = 0;
  bool started_ = false, prepared_ = false;
  std::int64_t due_ns_ = 0;
  Image<std::uint8_t> mask_;
};

/// The studio before its cameras are handed out.
class SimulatedStudio {
 public:
  /// @throws SetupError  when the options cannot be.
  explicit SimulatedStudio(const SimulatedStudioOptions& options);

  const std::vector<CameraCalibration>& cameras() const;
  std::unique_ptr<SimulatedCamera> OpenCamera(int camera) const;
  /// Opens a camera whose head follows.
  std::unique_ptr<CameraDriver> OpenFollowing(int camera,
                                              std::shared_ptr<const SubjectPosition> person) const;
  /// Pictures of the empty studio; for a camera on a head a sweep of its directions.
  std::vector<BackgroundFrame> Background(int camera) const;
  /// Time of a frame without any camera's jitter.
  std::int64_t NominalTime(std::int64_t frame) const;
  PersonPresence PresenceOf(int person, std::int64_t capture_ns) const;

 private:
  std::shared_ptr<const simulation::Scene> scene_;
  std::vector<std::shared_ptr<const simulation::SceneView>> views_;
};

/// Opens the simulated studio as a source of frames. Cameras share one immutable scene.
/// @throws SetupError  when the options cannot be.
Studio OpenSimulatedStudio(const SimulatedStudioOptions& options);

}  // namespace mocap
