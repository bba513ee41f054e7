#include "drivers/simulation/coded_frames.h"

#include <utility>

#include "core/errors.h"

namespace mocap::simulation {

void CodedFrames::Add(const Frame& frame, const Image<std::uint8_t>& figures) {
  coder_.Add(frame.image);
  waiting_.push_back({frame, figures});
}

void CodedFrames::Finish() {
  coder_.Finish();
  is_finished_ = true;
}

bool CodedFrames::Take(Frame& frame) {
  if (!coder_.Take(picture_)) return false;
  frame = waiting_.front().frame;
  frame.image = std::as_const(picture_).view();
  figures_ = std::move(waiting_.front().figures);
  waiting_.pop_front();
  return true;
}

void CodePictures(double fps, int crf, std::vector<BackgroundFrame>& pictures) {
  const Image<Bgr>& first = pictures.front().image;
  PictureCoder coder(first.width(), first.height(), fps, crf);
  // What comes back is never ahead of what was added.
  auto next = pictures.begin();
  const auto take_all = [&] {
    while (next != pictures.end() && coder.Take(next->image)) ++next;
  };
  for (const BackgroundFrame& picture : pictures) {
    coder.Add(picture.image.view());
    take_all();
  }
  coder.Finish();
  take_all();
  MOCAP_CHECK(next == pictures.end());
}

}  // namespace mocap::simulation
