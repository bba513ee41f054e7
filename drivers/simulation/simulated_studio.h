// Cameras in a studio that does not exist.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "drivers/camera_driver.h"
#include "drivers/simulation/simulated_head.h"
#include "drivers/studio.h"
#include "drivers/subject_position.h"
#include "drivers/virtual_studio/presence.h"
#include "drivers/virtual_studio/studio_options.h"

namespace mocap {
namespace simulation {
class Scene;
class SceneView;
class ScenePainter;
class PictureAhead;
class CodedFrames;
}  // namespace simulation

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
