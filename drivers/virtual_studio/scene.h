// A simulated studio with its people: the state that cameras share, and one camera's view of it.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "core/image.h"
#include "core/reconstruction/camera/camera_model.h"
#include "core/reconstruction/silhouette/segmenter.h"
#include "drivers/pan_tilt.h"
#include "drivers/virtual_studio/motions/motion.h"
#include "drivers/virtual_studio/people/anthropometry.h"
#include "drivers/virtual_studio/people/person_mesh.h"
#include "drivers/virtual_studio/presence.h"
#include "drivers/virtual_studio/rendering/empty_view.h"
#include "drivers/virtual_studio/rendering/person_renderer.h"
#include "drivers/virtual_studio/rendering/sensor.h"
#include "drivers/virtual_studio/room/room.h"
#include "drivers/virtual_studio/studio_options.h"

namespace mocap::simulation {

/// A person and the motion. Immutable; reentrant.
class Person {
 public:
  /// @param start_ns  start of the motion.
  Person(const Anthropometry& body, std::unique_ptr<const Motion> motion, std::int64_t start_ns)
      : body_(body), motion_(std::move(motion)), start_ns_(start_ns) {}

  const Anthropometry& body() const { return body_; }
  const Motion& motion() const { return *motion_; }
  BonePoses BonesAt(std::int64_t capture_ns) const;

 private:
  Anthropometry body_;
  std::unique_ptr<const Motion> motion_;
  std::int64_t start_ns_;
};

/// Makes all people of a studio.
/// @throws SetupError  for invalid options.
std::vector<Person> MakePeople(const SimulatedStudioOptions& options);

/// Everything that the cameras see. Immutable; reentrant.
class Scene {
 public:
  explicit Scene(const SimulatedStudioOptions& options);

  const SimulatedStudioOptions& options() const { return options_; }
  const std::vector<Person>& people() const { return people_; }
  std::vector<BonePoses> BonesAt(std::int64_t capture_ns) const;
  const Room& room() const { return room_; }
  /// One per person, in their order.
  const std::vector<Figure>& figures() const { return figures_; }
  const Sensor& sensor() const { return sensor_; }
  const std::vector<CameraCalibration>& cameras() const { return cameras_; }

  /// How people look to a camera, which may be misled.
  FigureStyle StyleOf(int camera) const;
  /// Nominal time of frame number `frame`, the same for all cameras.
  std::int64_t NominalTime(std::int64_t frame) const;
  /// Actual capture time of a camera, within 0.3 ms of the nominal time.
  std::int64_t CaptureTime(int camera, std::int64_t frame) const;
  /// How much of a person is in the room and in the pictures.
  PersonPresence PresenceOf(int person, std::int64_t capture_ns) const;
  /// Angles of a camera's head, which follows the first person with a lag. Zero without a head.
  PanTiltAngles AnglesAt(int camera, std::int64_t capture_ns) const;
  /// Range of a camera's head, whether commanded or moving by itself. Zero without a head.
  PanTiltLimits ReachOf(int camera) const;
  /// Directions that cover its range, as a serpentine; zeros without a head.
  std::vector<PanTiltAngles> Sweep(int camera, int frames) const;

 private:
  SimulatedStudioOptions options_;
  std::vector<Person> people_;
  Room room_;
  std::vector<Figure> figures_;
  Sensor sensor_;
  std::vector<CameraCalibration> cameras_;
};

/// One camera's empty view, rendered on first use. Reentrant.
class SceneView {
 public:
  SceneView(std::shared_ptr<const Scene> scene, int camera);

  const Scene& scene() const { return *scene_; }
  int camera() const { return camera_; }
  const CameraCalibration& calibration() const { return scene_->cameras()[camera_]; }
  /// @pre  no head: the view never changes.
  const EmptyView& fixed_view() const;
  /// Renders the view in one direction, with a head.
  void RenderView(const PanTiltAngles& angles, EmptyView& view) const;
  /// Frames of the empty studio with noise and directions; capture times are before the start.
  std::vector<BackgroundFrame> Background(int frames) const;

 private:
  std::shared_ptr<const Scene> scene_;
  int camera_;
  mutable std::once_flag once_;
  mutable std::unique_ptr<const EmptyViewRenderer> renderer_;
  mutable EmptyView fixed_view_;
  const EmptyViewRenderer& Renderer() const;
};

/// Renders one camera's pictures; reuses its memory. Thread-bound.
class ScenePainter {
 public:
  explicit ScenePainter(std::shared_ptr<const SceneView> view);

  /// Paints the camera's picture at a time; its head follows the first person.
  void Paint(std::int64_t capture_ns);
  /// Paints the picture for given angles of its head.
  void Paint(std::int64_t capture_ns, const PanTiltAngles& angles);
  const Image<Bgr>& picture() const { return picture_; }
  const PanTiltAngles& angles() const { return angles_; }
  /// The figures that are visible: a FigurePixel each.
  const Image<std::uint8_t>& figures() const { return renderer_.figures(); }

 private:
  std::shared_ptr<const SceneView> view_;
  PersonRenderer renderer_;
  EmptyView turned_view_;
  PanTiltAngles angles_;
  Image<Bgr> canvas_, picture_;
  bool fresh_ = true;
};

}  // namespace mocap::simulation
