// Where recordings and previews take things out of the pipeline's threads, without ever holding
// them up.
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
#include "core/reconstruction/silhouette/silhouette.h"
#include "daemon/pipeline/spsc_queue.h"
#include "drivers/camera_driver.h"

namespace mocap {

/// Hands copies to a recording while one is on, by a queue of its own; when that is full, the
/// oldest item goes and is counted.
///
/// Offer: one thread of the pipeline; it neither waits nor allocates once items have their size.
/// Hold: any. The rest: the recording's.
template <typename Item>
class Tap {
 public:
  using Queue = SpscQueue<Item>;

  /// Lets `fill` write the copy into an item that is used again and again, if a recording is on.
  /// @param fill  returns whether there is something to hand over.
  template <typename Fill>
  void Offer(Fill fill) {
    if (!open_.load(std::memory_order_relaxed)) return;
    // Each side raises its own flag before it looks at the other's, in one order for all threads:
    // Close cannot miss a copy that is under way.
    in_use_.store(true);
    if (open_.load() && fill(queue_->back())) queue_->Push();
    in_use_.store(false);
  }

  /// Whether nothing should be done for now with what is handed over, as long as there is room for
  /// it: the pipeline needs the time.
  void Hold(bool is_held) { held_.store(is_held, std::memory_order_relaxed); }
  bool is_held() const { return held_.load(std::memory_order_relaxed); }

  /// Begins. @param capacity  how many items can wait. @param item  what each is made of at first.
  /// @param bell  rung for each; borrowed until the next Open.
  void Open(std::size_t capacity, const Item& item, Doorbell& bell) {
    queue_ = std::make_unique<Queue>(capacity, Overflow::kDropOldest, bell, item);
    open_.store(true);
  }
  /// Ends; what waits can still be taken out.
  void Close() {
    open_.store(false);
    while (in_use_.load()) std::this_thread::yield();
    if (queue_) queue_->Close();
  }
  /// @pre  Open was called.
  Queue& queue() { return *queue_; }
  const Queue& queue() const { return *queue_; }
  /// Gives the memory back. @pre  closed.
  void Free() { queue_.reset(); }

 private:
  std::atomic<bool> open_{false};
  std::atomic<bool> in_use_{false};
  std::atomic<bool> held_{false};
  std::unique_ptr<Queue> queue_;
};

/// A frame's copy on its way to a recording.
struct TappedFrame {
  Image<Bgr> image;
  std::int64_t capture_ns = 0;
  std::int64_t offered_ns = 0;  ///< When it was copied, by the steady clock.
  std::uint64_t sequence = 0;
  PanTiltAngles angles;
};
using FrameTap = Tap<TappedFrame>;

/// Copies a frame; one of another size than the items' is none of this camera's.
bool CopyFrame(const Frame& from, TappedFrame& to);
/// Copies pixels between pictures of one size. @return  false where they are not.
bool CopyPixels(ImageView<const Bgr> from, Image<Bgr>& to);

/// A picture and what was segmented in it, on their way to be looked at.
struct SeenFrame {
  Image<Bgr> image;
  Silhouette silhouette;
  RigidTransform X_CW;
  std::int64_t capture_ns = 0;
};
using PreviewTap = Tap<SeenFrame>;
/// More pictures a second are not looked at.
inline constexpr double kPreviewHz = 5;

/// A message as it was published.
struct TappedMessage {
  std::string channel;
  std::vector<std::uint8_t> bytes;
  std::int64_t utime = 0;  ///< When, on the timeline [us].
};
using MessageTap = Tap<TappedMessage>;

}  // namespace mocap
