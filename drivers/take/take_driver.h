// Replays a recorded camera: its video, with its times and angles.
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
/// As fast as possible: frames have the recording's times, none is dropped, and the timeout is not
/// used. In real time: each frame is delivered when due, with the present as its capture time. If
/// the caller falls behind, the oldest frames are dropped, as with a camera that has few buffers.
/// The sequence shows the gap. Dropping costs hardly any time. When the recording loops, times and
/// sequence keep increasing. Ends with the shorter of video and table.
class TakeDriver : public CameraDriver {
 public:
  /// Frames that wait for a slow caller in real time before the oldest is dropped.
  static constexpr std::size_t kBufferedFrames = 4;

  /// @param lead  pictures of the video before the one of the first row.
  TakeDriver(VideoReader video, TakeTable table, std::shared_ptr<Replay> replay,
             std::size_t lead = 0);
  ~TakeDriver() override;

  void Start() override;
  GrabStatus Grab(Frame& frame, std::chrono::milliseconds timeout) override;
  void Stop() override;

 private:
  std::int64_t CaptureTimeNs(std::size_t row) const {
    return table_.rows[row].timestamp_ns + shift_ns_ + replay_->LoopOffset(loop_);
  }
  void PassLead();
  bool NextLoop();
  bool ReadNext();
  std::int64_t OverdueAtNs() const;
  void DropOverdue(std::int64_t now_ns);
  bool WaitUntilDue(std::int64_t deadline_ns);
  GrabStatus HandOut(Frame& frame);

  VideoReader video_;
  const TakeTable table_;
  const std::shared_ptr<Replay> replay_;
  const std::size_t lead_;
  bool started_ = false;
  bool fresh_ = true;  ///< The video is at its first frame.
  std::int64_t shift_ns_ = 0;
  std::uint64_t loop_ = 0;
  std::size_t row_ = 0;              ///< Next row; past the end when this loop is over.
  std::optional<VideoStatus> read_;  ///< Status of the next row, once read.
  ImageView<const Bgr> image_;       ///< Its picture.
};

}  // namespace mocap
