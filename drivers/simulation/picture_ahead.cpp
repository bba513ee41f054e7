#include "drivers/simulation/picture_ahead.h"

#include <utility>

#include "drivers/go_behind.h"

namespace mocap::simulation {

PictureAhead::PictureAhead(std::shared_ptr<const SceneView> view)
    : painter_(std::make_unique<ScenePainter>(view)),
      thread_([this, name = view->calibration().name] {
        GoBehind("paint " + name);
        Run();
      }) {}

PictureAhead::~PictureAhead() {
  state_.store(State::kEnded, std::memory_order_release);
  state_.notify_one();
  thread_.join();
}

void PictureAhead::Ask(std::int64_t capture_ns) {
  if (state_.load(std::memory_order_acquire) == State::kAsked) return;
  capture_ns_ = capture_ns;
  state_.store(State::kAsked, std::memory_order_release);
  state_.notify_one();
}

bool PictureAhead::Take(std::int64_t capture_ns, std::unique_ptr<ScenePainter>& painter) {
  if (capture_ns_ != capture_ns) return false;
  if (state_.load(std::memory_order_acquire) == State::kAsked) {
    if (!BringForward(thread_)) return false;
    state_.wait(State::kAsked, std::memory_order_acquire);
    SendBehind(thread_);
  }
  if (state_.load(std::memory_order_acquire) != State::kPainted) return false;
  std::swap(painter, painter_);
  state_.store(State::kIdle, std::memory_order_relaxed);
  return true;
}

void PictureAhead::Run() {
  for (;;) {
    State state = state_.load(std::memory_order_acquire);
    if (state == State::kEnded) return;
    if (state != State::kAsked) {
      state_.wait(state, std::memory_order_acquire);
      continue;
    }
    painter_->Paint(capture_ns_);
    state_.compare_exchange_strong(state, State::kPainted, std::memory_order_release);
    state_.notify_one();
  }
}

}  // namespace mocap::simulation
