#include "drivers/take/take_driver.h"

#include <algorithm>
#include <utility>

#include "core/errors.h"

namespace mocap {

TakeDriver::TakeDriver(VideoReader video, TakeTable table, std::shared_ptr<Replay> replay)
    : video_(std::move(video)), table_(std::move(table)), replay_(std::move(replay)) {
  MOCAP_CHECK(!table_.rows.empty() && replay_);
}

TakeDriver::~TakeDriver() { Stop(); }

void TakeDriver::Start() {
  MOCAP_CHECK(!started_);
  if (!fresh_) video_.Rewind();
  fresh_ = true;
  loop_ = 0;
  row_ = 0;
  shift_ns_ = replay_->Join();
  started_ = true;
}

void TakeDriver::Stop() {
  if (!started_) return;
  started_ = false;
  replay_->Leave();
}

GrabStatus TakeDriver::Grab(Frame& frame, std::chrono::milliseconds timeout) {
  MOCAP_CHECK(started_);
  ReplayClock* clock = replay_->clock();
  const std::int64_t timeout_ns = std::chrono::nanoseconds(timeout).count();
  const std::int64_t deadline_ns = clock ? clock->NowNs() + timeout_ns : 0;
  while (true) {
    if (row_ == table_.rows.size()) {
      if (!replay_->loops()) return GrabStatus::kEnd;
      if (!NextLoop()) {
        if (clock) clock->SleepUntil(deadline_ns);
        return GrabStatus::kLost;
      }
    }
    if (clock) {
      DropOverdue(clock->NowNs());
      if (row_ == table_.rows.size()) continue;
      if (!WaitUntilDue(deadline_ns)) return GrabStatus::kTimeout;
    }
    const GrabStatus status = ReadRow(frame);
    if (status != GrabStatus::kEnd) return status;
  }
}

bool TakeDriver::NextLoop() {
  try {
    video_.Rewind();
  } catch (const SetupError&) {
    return false;
  }
  ++loop_;
  row_ = 0;
  return true;
}

void TakeDriver::DropOverdue(std::int64_t now_ns) {
  while (row_ + kBufferedFrames < table_.rows.size() &&
         CaptureTimeNs(row_ + kBufferedFrames) <= now_ns) {
    fresh_ = false;
    row_ = video_.Skip() == VideoStatus::kEnd ? table_.rows.size() : row_ + 1;
  }
}

bool TakeDriver::WaitUntilDue(std::int64_t deadline_ns) {
  const std::int64_t due_ns = CaptureTimeNs(row_);
  ReplayClock& clock = *replay_->clock();
  if (clock.NowNs() < due_ns) clock.SleepUntil(std::min(due_ns, deadline_ns));
  return clock.NowNs() >= due_ns;
}

GrabStatus TakeDriver::ReadRow(Frame& frame) {
  fresh_ = false;
  const VideoStatus status = video_.Read(frame.image);
  if (status == VideoStatus::kEnd) {
    row_ = table_.rows.size();
    return GrabStatus::kEnd;
  }
  const TakeRow& row = table_.rows[row_];
  frame.capture_ns = CaptureTimeNs(row_);
  frame.sequence = row.frame + loop_ * (table_.rows.back().frame + 1);
  frame.angles = row.angles;
  ++row_;
  return status == VideoStatus::kFrame ? GrabStatus::kFrame : GrabStatus::kTorn;
}

}  // namespace mocap
