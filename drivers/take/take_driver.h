// A recorded camera as a driver: its video, and the times and angles beside it.
#pragma once

#include <memory>
#include <optional>

#include "drivers/camera_driver.h"
#include "drivers/take/replay.h"
#include "drivers/take/take_table.h"
#include "drivers/take/video_reader.h"

namespace mocap {

/// Replays one camera of a take.
///
/// Read as fast as possible, frames carry the times of the recording, every frame is handed out and
/// the timeout is never used up. In real time each frame is handed out once its time has come, and
/// carries the present as its capture time; a caller that falls behind loses the oldest frames, as
/// with a camera that has few buffers, and sees the gap in the sequence; what was lost costs hardly
/// any time. When the recording loops, times and sequence go on increasing. Ends with the shorter
/// of video and table.
class TakeDriver : public CameraDriver {
 public:
  /// Frames that wait for a slow caller in real time before the oldest is lost.
  static constexpr std::size_t kBufferedFrames = 4;

  TakeDriver(VideoReader video, TakeTable table, std::shared_ptr<Replay> replay);
  ~TakeDriver() override;

  void Start() override;
  GrabStatus Grab(Frame& frame, std::chrono::milliseconds timeout) override;
  void Stop() override;

 private:
  std::int64_t CaptureTimeNs(std::size_t row) const {
    return table_.rows[row].timestamp_ns + shift_ns_ + replay_->LoopOffset(loop_);
  }
  bool NextLoop();
  bool ReadNext();
  std::int64_t OverdueAtNs() const;
  void DropOverdue(std::int64_t now_ns);
  bool WaitUntilDue(std::int64_t deadline_ns);
  GrabStatus HandOut(Frame& frame);

  VideoReader video_;
  const TakeTable table_;
  const std::shared_ptr<Replay> replay_;
  bool started_ = false;
  bool fresh_ = true;  ///< The video stands at its first frame.
  std::int64_t shift_ns_ = 0;
  std::uint64_t loop_ = 0;
  std::size_t row_ = 0;              ///< The next one; past the last one when this loop has ended.
  std::optional<VideoStatus> read_;  ///< Of the next row, once it was read.
  ImageView<const Bgr> image_;       ///< Its picture.
};

}  // namespace mocap
