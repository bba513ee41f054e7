#include "drivers/simulation/simulated_board.h"

#include <cmath>

#include "drivers/virtual_studio/random.h"
#include "drivers/virtual_studio/room/camera_rig.h"
#include "drivers/virtual_studio/room/printed_board.h"
#include "drivers/virtual_studio/scene.h"

namespace mocap {
namespace {

// Range and rate at which heads scan around a board. Pan and tilt combine differently all the time.
constexpr double kPanAbout_rad = 0.25, kTiltAbout_rad = 0.18;
constexpr double kPanRate_rad_s = 0.7, kTiltRate_rad_s = 1.1;

}  // namespace

class SimulatedBoard::Impl {
 public:
  Impl(const SimulatedStudioOptions& options, BoardPlace place, int desk)
      : scene_(std::make_shared<const simulation::Scene>(options)),
        place_(place),
        desk_(desk),
        path_(scene_->cameras(), options.seed) {
    for (const CameraCalibration& camera : scene_->cameras())
      views_.emplace_back(camera).Turn(scene_->room(), {});
  }

  const simulation::Scene& scene() const { return *scene_; }

  RigidTransform PoseAt(std::int64_t capture_ns) const {
    if (place_ == BoardPlace::kOnFloor) return simulation::BoardOnFloor();
    if (place_ == BoardPlace::kOnDesk)
      return simulation::BoardOnDesk(scene_->options().seed, desk_);
    return path_.PoseAt(SecondsAt(capture_ns));
  }

  PanTiltAngles AnglesAt(int camera, std::int64_t capture_ns) const {
    if (place_ != BoardPlace::kOnDesk || !scene_->cameras()[camera].head) return {};
    const Vector3 middle_W = PoseAt(capture_ns) * simulation::PrintedBoard::Middle();
    const double t_s = SecondsAt(capture_ns);
    PanTiltAngles angles = simulation::AimInSteps(scene_->cameras()[camera], middle_W);
    angles.pan_rad += kPanAbout_rad * std::sin(kPanRate_rad_s * t_s);
    angles.tilt_rad += kTiltAbout_rad * std::sin(kTiltRate_rad_s * t_s);
    return angles;
  }

  ImageView<const Bgr> Paint(int camera, std::int64_t frame) {
    const std::int64_t capture_ns = scene_->CaptureTime(camera, frame);
    View& view = views_[camera];
    view.Turn(scene_->room(), AnglesAt(camera, capture_ns));
    canvas_ = view.empty.image;
    simulation::PaintBoard(view.camera, view.camera.PoseAt(view.angles), PoseAt(capture_ns),
                           view.empty.nearness, canvas_);
    scene_->sensor().Expose(
        canvas_, simulation::LampGain(capture_ns),
        simulation::Mix(scene_->options().seed, simulation::Tag("board frame"),
                        static_cast<std::uint64_t>(camera), static_cast<std::uint64_t>(frame)),
        picture_);
    return static_cast<const Image<Bgr>&>(picture_).view();
  }

 private:
  // The empty studio in a camera's last direction.
  struct View {
    explicit View(const CameraCalibration& which) : camera(which), renderer(which) {}
    void Turn(const simulation::Room& room, const PanTiltAngles& to) {
      if (is_rendered && to == angles) return;
      angles = to;
      is_rendered = true;
      renderer.Render(room, camera.PoseAt(to), empty);
    }

    CameraCalibration camera;
    simulation::EmptyViewRenderer renderer;
    simulation::EmptyView empty;
    PanTiltAngles angles;
    bool is_rendered = false;
  };

  double SecondsAt(std::int64_t capture_ns) const {
    return static_cast<double>(capture_ns - scene_->options().start_ns) * 1e-9;
  }

  std::shared_ptr<const simulation::Scene> scene_;
  BoardPlace place_;
  int desk_;
  simulation::BoardPath path_;
  std::vector<View> views_;
  Image<Bgr> canvas_, picture_;
};

SimulatedBoard::SimulatedBoard(const SimulatedStudioOptions& options, BoardPlace place, int desk)
    : impl_(std::make_unique<Impl>(options, place, desk)) {}
SimulatedBoard::~SimulatedBoard() = default;

const std::vector<CameraCalibration>& SimulatedBoard::cameras() const {
  return impl_->scene().cameras();
}

std::int64_t SimulatedBoard::CaptureTime(int camera, std::int64_t frame) const {
  return impl_->scene().CaptureTime(camera, frame);
}

RigidTransform SimulatedBoard::PoseAt(std::int64_t capture_ns) const {
  return impl_->PoseAt(capture_ns);
}

PanTiltAngles SimulatedBoard::AnglesAt(int camera, std::int64_t capture_ns) const {
  return impl_->AnglesAt(camera, capture_ns);
}

ImageView<const Bgr> SimulatedBoard::Paint(int camera, std::int64_t frame) {
  return impl_->Paint(camera, frame);
}

}  // namespace mocap
