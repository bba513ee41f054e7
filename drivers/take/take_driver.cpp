#include "drivers/take/take_driver.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "core/errors.h"

namespace mocap {

TakeDriver::TakeDriver(VideoReader video, TakeTable table, std::shared_ptr<Replay> replay,
                       std::size_t lead)
    : video_(std::move(video)), table_(std::move(table)), replay_(std::move(replay)), lead_(lead) {
  MOCAP_CHECK(!table_.rows.empty() && replay_);
}

TakeDriver::~TakeDriver() { Stop(); }

void TakeDriver::Start() {
  MOCAP_CHECK(!started_);
  if (!fresh_) video_.Rewind();
  PassLead();
  fresh_ = lead_ == 0;
  read_.reset();
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
  while (!ReadNext()) {
    if (!replay_->loops()) return GrabStatus::kEnd;
    if (!NextLoop()) {
      if (clock) clock->SleepUntil(deadline_ns);
      return GrabStatus::kLost;
    }
  }
  if (clock && !WaitUntilDue(deadline_ns)) return GrabStatus::kTimeout;
  return HandOut(frame);
}

void TakeDriver::PassLead() {
  for (std::size_t i = 0; i < lead_; ++i) video_.Skip();
}

bool TakeDriver::NextLoop() {
  try {
    video_.Rewind();
    PassLead();
  } catch (const SetupError&) {
    return false;
  }
  ++loop_;
  row_ = 0;
  return true;
}

bool TakeDriver::ReadNext() {
  if (replay_->clock()) DropOverdue(replay_->clock()->NowNs());
  if (row_ == table_.rows.size()) return false;
  fresh_ = false;
  // Read ahead, so that the picture is ready when due.
  if (!read_) read_ = video_.Read(image_);
  if (read_ != VideoStatus::kEnd) return true;
  read_.reset();
  row_ = table_.rows.size();
  return false;
}

std::int64_t TakeDriver::OverdueAtNs() const {
  const std::size_t rows = table_.rows.size(), newer = row_ + kBufferedFrames;
  if (newer >= rows && !replay_->loops()) return std::numeric_limits<std::int64_t>::max();
  return CaptureTimeNs(newer % rows) + replay_->LoopOffset(newer / rows);
}

void TakeDriver::DropOverdue(std::int64_t now_ns) {
  // Whole loops are skipped: the video is at the same frame then.
  if (OverdueAtNs() <= now_ns) loop_ += replay_->LoopsIn(now_ns - OverdueAtNs());
  while (row_ < table_.rows.size() && OverdueAtNs() <= now_ns) {
    fresh_ = false;
    const VideoStatus passed = read_ ? *std::exchange(read_, std::nullopt) : video_.Skip();
    row_ = passed == VideoStatus::kEnd ? table_.rows.size() : row_ + 1;
  }
}

bool TakeDriver::WaitUntilDue(std::int64_t deadline_ns) {
  const std::int64_t due_ns = CaptureTimeNs(row_);
  ReplayClock& clock = *replay_->clock();
  if (clock.NowNs() < due_ns) clock.SleepUntil(std::min(due_ns, deadline_ns));
  return clock.NowNs() >= due_ns;
}

GrabStatus TakeDriver::HandOut(Frame& frame) {
  const TakeRow& row = table_.rows[row_];
  frame.image = image_;
  frame.capture_ns = CaptureTimeNs(row_);
  frame.sequence = row.frame + loop_ * (table_.rows.back().frame + 1);
  frame.angles = row.angles;
  ++row_;
  return std::exchange(read_, std::nullopt) == VideoStatus::kFrame ? GrabStatus::kFrame
                                                                   : GrabStatus::kTorn;
}

}  // namespace mocap
