// A camera whose pictures tell which one of them each is.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <thread>

#include "drivers/camera_driver.h"

namespace mocap::testing {

/// Delivers pictures at whole multiples of its period by the system's clock.
class PatternCamera : public CameraDriver {
 public:
  PatternCamera(int width_px, int height_px, double fps)
      : picture_(width_px, height_px), period_ns_(static_cast<std::int64_t>(1e9 / fps)) {}

  /// Tells whether a picture is one of ours. Colours are even, so that coarse formats keep them.
  static bool IsPattern(ImageView<const Bgr> picture) {
    const Bgr& first = picture(0, 0);
    for (int y = 0; y < picture.height(); ++y) {
      for (int x = 0; x < picture.width(); ++x) {
        if (picture(x, y) != first) return false;
      }
    }
    return first.b == first.g && first.g == first.r && first.g >= kDarkest;
  }

  /// The grey of the picture at so many periods since the epoch.
  static std::uint8_t GreyAt(std::int64_t beat) {
    return static_cast<std::uint8_t>(kDarkest + beat % 100);
  }

  void Start() override {}
  GrabStatus Grab(Frame& frame, std::chrono::milliseconds) override {
    using std::chrono::nanoseconds;
    using std::chrono::system_clock;
    const auto now_ns =
        std::chrono::duration_cast<nanoseconds>(system_clock::now().time_since_epoch()).count();
    const std::int64_t due_ns = (now_ns / period_ns_ + 1) * period_ns_;
    std::this_thread::sleep_until(std::chrono::sys_time<nanoseconds>(nanoseconds(due_ns)));
    const std::uint8_t grey = GreyAt(due_ns / period_ns_);
    for (Bgr& pixel : picture_.pixels()) pixel = {grey, grey, grey};
    frame = {picture_.view(), due_ns, sequence_++, {}};
    return GrabStatus::kFrame;
  }
  void Stop() override {}

 private:
  static constexpr std::uint8_t kDarkest = 32;
  Image<Bgr> picture_;
  const std::int64_t period_ns_;
  std::uint64_t sequence_ = 0;
};

}  // namespace mocap::testing
