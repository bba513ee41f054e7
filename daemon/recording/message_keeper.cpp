#include "daemon/recording/message_keeper.h"

#include "drivers/take/take_layout.h"

namespace mocap {
namespace {

constexpr std::size_t kMessagesQueued = 1024;

}  // namespace

MessageKeeper::MessageKeeper(const std::filesystem::path& folder, RecordingTaps& taps)
    : taps_(taps), log_(TakeLayout{folder}.Poses()), keypoints_(folder / "keypoints.csv") {}

MessageKeeper::~MessageKeeper() {
  taps_.messages.Free();
  taps_.received.Free();
  taps_.keypoints.Free();
}

void MessageKeeper::Open(Doorbell& bell) {
  taps_.messages.Open(kMessagesQueued, {}, bell);
  taps_.received.Open(kMessagesQueued, {}, bell);
  taps_.keypoints.Open(kMessagesQueued, {}, bell);
}

void MessageKeeper::Close() {
  taps_.messages.Close();
  taps_.received.Close();
  taps_.keypoints.Close();
}

void MessageKeeper::Write(std::int64_t ahead_ns) {
  WriteMessages(taps_.messages, ahead_ns);
  WriteMessages(taps_.received, ahead_ns);
  while (taps_.keypoints.queue().TryPop()) {
    KeypointView& view = taps_.keypoints.queue().front();
    view.capture_ns += ahead_ns;
    keypoints_.Write(view);
  }
  log_.Flush();
  keypoints_.Flush();
}

void MessageKeeper::WriteMessages(MessageTap& tap, std::int64_t ahead_ns) {
  while (tap.queue().TryPop()) {
    TappedMessage& message = tap.queue().front();
    message.utime += ahead_ns / 1000;
    log_.Write(message);
  }
}

}  // namespace mocap
