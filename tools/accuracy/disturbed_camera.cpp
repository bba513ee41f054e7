#include "tools/accuracy/disturbed_camera.h"

#include <algorithm>
#include <utility>

#include "drivers/virtual_studio/random.h"

namespace mocap {
namespace {

constexpr double kLeastSide_px = 6, kMostSide_px = 30;
constexpr int kTurned_px = 20;

}  // namespace

DisturbedCamera::DisturbedCamera(std::unique_ptr<CameraDriver> camera, Image<Bgr> empty,
                                 const PictureDisturbance& disturbance)
    : camera_(std::move(camera)), empty_(std::move(empty)), disturbance_(disturbance) {}

GrabStatus DisturbedCamera::Grab(Frame& frame, std::chrono::milliseconds timeout) {
  const GrabStatus status = camera_->Grab(frame, timeout);
  if (status != GrabStatus::kFrame) return status;
  const bool has_happened = frame.capture_ns >= disturbance_.mishap_ns;
  const Mishap mishap = has_happened ? disturbance_.mishap : Mishap::kNone;
  if (mishap == Mishap::kLost) return GrabStatus::kEnd;
  if (mishap == Mishap::kNone && disturbance_.covered_share == 0) return status;
  Copy(frame, mishap == Mishap::kTurned ? kTurned_px : 0);
  if (mishap == Mishap::kBlinded) std::ranges::fill(picture_.pixels(), Bgr{255, 255, 255});
  Cover(frame.sequence);
  frame.image = std::as_const(picture_).view();
  return status;
}

// The content that a turn reveals at the left may be anything: keep the old.
void DisturbedCamera::Copy(const Frame& frame, int shift_px) {
  const int width = frame.image.width(), height = frame.image.height();
  if (picture_.width() != width || picture_.height() != height) picture_ = {width, height};
  for (int y = 0; y < height; ++y) {
    const Bgr* row = frame.image.row(y);
    std::copy_n(row, shift_px, picture_.row(y));
    std::copy_n(row, width - shift_px, picture_.row(y) + shift_px);
  }
}

void DisturbedCamera::Cover(std::uint64_t sequence) {
  const int width = picture_.width(), height = picture_.height();
  simulation::Random random(simulation::Mix(disturbance_.seed, sequence));
  double left_px = disturbance_.covered_share * width * height;
  for (bool is_hole = true; left_px > 0; is_hole = !is_hole) {
    const int side = static_cast<int>(random.Uniform(kLeastSide_px, kMostSide_px));
    const int x0 = static_cast<int>(random.Uniform(0, width - side));
    const int y0 = static_cast<int>(random.Uniform(0, height - side));
    const auto grey = static_cast<std::uint8_t>(random.Uniform(0, 256));
    for (int y = y0; y < y0 + side; ++y) {
      if (is_hole) {
        std::copy_n(empty_.row(y) + x0, side, picture_.row(y) + x0);
      } else {
        std::fill_n(picture_.row(y) + x0, side, Bgr{grey, grey, grey});
      }
    }
    left_px -= side * side;
  }
}

}  // namespace mocap
