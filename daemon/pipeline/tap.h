// Lets recordings and previews copy data out of the pipeline's threads without blocking them.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "core/image.h"
#include "core/reconstruction/camera/camera_model.h"
#include "core/reconstruction/silhouette/trimap.h"
#include "daemon/pipeline/spsc_queue.h"
#include "drivers/camera_driver.h"

namespace mocap {

/// Passes copies to a recording while it runs, through its own queue. If that is full, the oldest
/// item is dropped and counted.
///
/// Offer: one thread of the pipeline; it neither waits nor allocates once items have grown. Hold:
/// any thread. The rest: the recording's thread.
template <typename Item>
class Tap {
 public:
  using Queue = SpscQueue<Item>;

  /// If a recording is on, lets `fill` write the copy into a reused item.
  /// @param fill  returns whether there is an item to push.
  template <typename Fill>
  void Offer(Fill fill) {
    if (!open_.load(std::memory_order_relaxed)) return;
    // Each side raises its own flag before it reads the other's, sequentially consistent. So Close
    // cannot miss a copy in progress.
    in_use_.store(true);
    if (open_.load() && fill(queue_->back())) queue_->Push();
    in_use_.store(false);
  }

  /// Sets whether the recipient should leave the items in the queue while there is room, because
  /// the pipeline needs the processor.
  void Hold(bool is_held) { held_.store(is_held, std::memory_order_relaxed); }
  bool is_held() const { return held_.load(std::memory_order_relaxed); }

  /// Opens the tap. @param capacity  of the queue. @param item  initial content of the items.
  /// @param bell  rung for each item; borrowed until the next Open.
  void Open(std::size_t capacity, const Item& item, Doorbell& bell) {
    queue_ = std::make_unique<Queue>(capacity, Overflow::kDropOldest, bell, item);
    open_.store(true);
  }
  /// Closes the tap. Queued items can still be taken out.
  void Close() {
    open_.store(false);
    while (in_use_.load()) std::this_thread::yield();
    if (queue_) queue_->Close();
  }
  /// @pre  Open was called.
  Queue& queue() { return *queue_; }
  const Queue& queue() const { return *queue_; }
  /// Frees the memory. @pre  closed.
  void Free() { queue_.reset(); }

 private:
  std::atomic<bool> open_{false};
  std::atomic<bool> in_use_{false};
  std::atomic<bool> held_{false};
  std::unique_ptr<Queue> queue_;
};

/// A copy of a frame for a recording.
struct TappedFrame {
  Image<Bgr> image;
  std::int64_t capture_ns = 0;
  std::int64_t offered_ns = 0;  ///< When it was copied, by the steady clock.
  std::uint64_t sequence = 0;
  PanTiltAngles angles;
};
using FrameTap = Tap<TappedFrame>;

/// Copies a frame. @return  false if its size differs from that of the items.
bool CopyFrame(const Frame& from, TappedFrame& to);
/// Copies pixels between pictures of equal size. @return  false if the sizes differ.
bool CopyPixels(ImageView<const Bgr> from, Image<Bgr>& to);

/// A picture and its segmentation, for viewing.
struct SeenFrame {
  Image<Bgr> image;
  Trimap trimap;
  RigidTransform X_CW;
  std::int64_t capture_ns = 0;
};
using PreviewTap = Tap<SeenFrame>;
/// Maximum rate of pictures for viewing.
inline constexpr double kPreviewHz = 5;

/// A message as it was published.
struct TappedMessage {
  std::string channel;
  std::vector<std::uint8_t> bytes;
  std::int64_t utime = 0;  ///< Of publishing, on the timeline [us].
};
using MessageTap = Tap<TappedMessage>;

}  // namespace mocap
