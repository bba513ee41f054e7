// Simulated frames as they are after lossy video coding.
#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "core/image.h"
#include "core/reconstruction/silhouette/background_model.h"
#include "drivers/camera_driver.h"
#include "drivers/take/picture_coder.h"

namespace mocap::simulation {

/// Codes a camera's frames, and keeps what goes with each until it comes back. Thread-bound.
class CodedFrames {
 public:
  /// As PictureCoder.
  CodedFrames(int width_px, int height_px, double fps, int crf)
      : coder_(width_px, height_px, fps, crf) {}

  /// Adds the next frame. @param figures  a FigurePixel each. @pre  as of PictureCoder.
  void Add(const Frame& frame, const Image<std::uint8_t>& figures);
  void Finish();
  bool is_finished() const { return is_finished_; }
  /// Takes the next frame, as PictureCoder::Take. Its pixels and figures() are valid until the next
  /// call.
  bool Take(Frame& frame);
  const Image<std::uint8_t>& figures() const { return figures_; }

 private:
  struct Kept {
    Frame frame;
    Image<std::uint8_t> figures;
  };

  PictureCoder coder_;
  std::deque<Kept> waiting_;
  Image<Bgr> picture_;
  Image<std::uint8_t> figures_;
  bool is_finished_ = false;
};

/// Codes pictures as a video of their own.
/// @pre  at least one.
void CodePictures(double fps, int crf, std::vector<BackgroundFrame>& pictures);

}  // namespace mocap::simulation
