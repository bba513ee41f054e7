#include "daemon/pipeline/frame_progress.h"

namespace mocap {
namespace {

bool Moved(const FrameProgress::Thread& before, const FrameProgress::Thread& now) {
  return now.has_ended || now.turns > before.turns;
}

}  // namespace

bool ProgressWatch::HasMoved(const FrameProgress& now) {
  if (!last_) {
    last_ = now;
    return false;
  }
  bool all_moved = Moved(last_->carving, now.carving);
  for (std::size_t i = 0; i < now.cameras.size(); ++i) {
    all_moved &= Moved(last_->cameras[i], now.cameras[i]);
  }
  const bool nothing_waits = now.sets_tracked == now.sets_matched;
  all_moved &= nothing_waits || now.sets_tracked > last_->sets_tracked;
  if (all_moved) last_ = now;
  return all_moved;
}

}  // namespace mocap
