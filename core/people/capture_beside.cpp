#include "core/people/capture_beside.h"

#include <array>
#include <atomic>
#include <cstdlib>
#include <optional>
#include <utility>
#include <vector>

namespace mocap {
namespace {

// At 30 Hz a moving person is tracked well. With faster cameras, a search catches up sooner.
constexpr std::int64_t kLeastApartNs = 25'000'000;
// More observations than arrive during a search.
constexpr std::int64_t kMostWaiting = 32;

}  // namespace

struct CaptureBeside::Queue {
  struct Seen {
    VoxelGrid flesh, room;
    std::vector<Outline> outlines, borders;
    Eigen::AlignedBox3d box_W;
    std::int64_t capture_ns = 0;
  };

  Seen& At(std::int64_t number) { return seen[static_cast<std::size_t>(number % kMostWaiting)]; }
  void Work();

  std::shared_ptr<MotionCapture> capture;
  std::array<Seen, kMostWaiting> seen;
  std::optional<std::int64_t> last_ns;
  std::atomic<std::int64_t> pushed{0}, taken{0};
  std::atomic<bool> is_begun{false};  // Work that was begun has not ended.
  std::atomic<bool> is_abandoned{false};
};

void CaptureBeside::Queue::Work() {
  const auto has_more = [this] { return taken < pushed && !is_abandoned; };
  do {
    while (has_more()) {
      const Seen& next = At(taken);
      capture->Update({next.flesh, next.outlines, next.box_W, next.room, next.borders},
                      next.capture_ns);
      ++taken;
    }
    is_begun = false;
    // An observation that was pushed just now did not begin work of its own.
  } while (has_more() && !is_begun.exchange(true));
}

CaptureBeside::CaptureBeside(std::shared_ptr<MotionCapture> capture, SideWork& side)
    : queue_(std::make_shared<Queue>()), side_(side) {
  queue_->capture = std::move(capture);
}

CaptureBeside::~CaptureBeside() { queue_->is_abandoned = true; }

void CaptureBeside::See(const Sighting& sighting, std::int64_t capture_ns) {
  Queue& queue = *queue_;
  if (queue.last_ns && std::abs(capture_ns - *queue.last_ns) < kLeastApartNs) return;
  if (queue.pushed - queue.taken == kMostWaiting) return;
  queue.last_ns = capture_ns;
  Queue::Seen& seen = queue.At(queue.pushed);
  seen.flesh = sighting.flesh;
  seen.room = sighting.room;
  seen.outlines.assign(sighting.outlines.begin(), sighting.outlines.end());
  seen.borders.assign(sighting.borders.begin(), sighting.borders.end());
  seen.box_W = sighting.box_W;
  seen.capture_ns = capture_ns;
  ++queue.pushed;
  if (queue.is_begun.exchange(true)) return;
  if (!side_.Begin([work = queue_] { work->Work(); })) queue.is_begun = false;
}

bool CaptureBeside::HasCaughtUp() const { return queue_->taken == queue_->pushed; }

}  // namespace mocap
