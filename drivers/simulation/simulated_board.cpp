#include "drivers/simulation/simulated_board.h"

#include "drivers/simulation/printed_board.h"
#include "drivers/simulation/random.h"
#include "drivers/simulation/scene.h"

namespace mocap {

class SimulatedBoard::Impl {
 public:
  Impl(const SimulatedStudioOptions& options, BoardPlace place)
      : scene_(std::make_shared<const simulation::Scene>(options)),
        place_(place),
        path_(scene_->cameras(), options.seed) {
    for (const CameraCalibration& camera : scene_->cameras()) {
      views_.emplace_back();
      simulation::EmptyViewRenderer(camera).Render(scene_->room(), camera.X_CW, views_.back());
    }
  }

  const simulation::Scene& scene() const { return *scene_; }

  RigidTransform PoseAt(std::int64_t capture_ns) const {
    if (place_ == BoardPlace::kOnFloor) return simulation::BoardOnFloor();
    return path_.PoseAt(static_cast<double>(capture_ns - scene_->options().start_ns) * 1e-9);
  }

  ImageView<const Bgr> Paint(int camera, std::int64_t frame) {
    const std::int64_t capture_ns = scene_->CaptureTime(camera, frame);
    canvas_ = views_[camera].image;
    simulation::PaintBoard(scene_->cameras()[camera], PoseAt(capture_ns), views_[camera].nearness,
                           canvas_);
    scene_->sensor().Expose(
        canvas_, simulation::LampGain(capture_ns),
        simulation::Mix(scene_->options().seed, simulation::Tag("board frame"),
                        static_cast<std::uint64_t>(camera), static_cast<std::uint64_t>(frame)),
        picture_);
    return static_cast<const Image<Bgr>&>(picture_).view();
  }

 private:
  std::shared_ptr<const simulation::Scene> scene_;
  BoardPlace place_;
  simulation::BoardPath path_;
  std::vector<simulation::EmptyView> views_;
  Image<Bgr> canvas_, picture_;
};

SimulatedBoard::SimulatedBoard(const SimulatedStudioOptions& options, BoardPlace place)
    : impl_(std::make_unique<Impl>(options, place)) {}
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

ImageView<const Bgr> SimulatedBoard::Paint(int camera, std::int64_t frame) {
  return impl_->Paint(camera, frame);
}

}  // namespace mocap
