#include "daemon/pipeline/capture_beside.h"

#include <algorithm>
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
// Each time that so many more wait, the distance doubles. At 5 Hz a walker is still tracked.
constexpr std::int64_t kWaitingToDouble = 8;

}  // namespace

struct CaptureBeside::Queue {
  struct Seen {
    VoxelGrid flesh, room;
    std::vector<Outline> outlines, borders;
    std::vector<KeypointRays> keypoints;
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
      Observation observation(next.flesh, next.outlines, next.box_W, next.room, next.borders);
      observation.keypoints = next.keypoints;
      capture->Update(observation, next.capture_ns);
      const bool has_found = capture->result().state != CaptureState::kSearching;
      taken = has_found ? taken + 1 : std::max(taken + 1, pushed - 1);
    }
    is_begun = false;
    // An observation that was pushed just now did not begin work of its own.
  } while (has_more() && !is_begun.exchange(true));
}

CaptureBeside::CaptureBeside(std::shared_ptr<MotionCapture> capture, BeginWork begin)
    : queue_(std::make_shared<Queue>()), begin_(std::move(begin)) {
  queue_->capture = std::move(capture);
}

CaptureBeside::~CaptureBeside() { queue_->is_abandoned = true; }

void CaptureBeside::See(const Observation& observation, std::int64_t capture_ns) {
  Queue& queue = *queue_;
  const std::int64_t waiting = queue.pushed - queue.taken;
  if (waiting == kMostWaiting) return;
  const std::int64_t least_apart_ns = kLeastApartNs << (waiting / kWaitingToDouble);
  if (queue.last_ns && std::abs(capture_ns - *queue.last_ns) < least_apart_ns) return;
  queue.last_ns = capture_ns;
  Queue::Seen& seen = queue.At(queue.pushed);
  seen.flesh = observation.flesh;
  seen.room = observation.room;
  seen.outlines.assign(observation.outlines.begin(), observation.outlines.end());
  seen.borders.assign(observation.borders.begin(), observation.borders.end());
  seen.keypoints.assign(observation.keypoints.begin(), observation.keypoints.end());
  seen.box_W = observation.box_W;
  seen.capture_ns = capture_ns;
  ++queue.pushed;
  if (queue.is_begun.exchange(true)) return;
  if (!begin_([work = queue_] { work->Work(); })) queue.is_begun = false;
}

bool CaptureBeside::HasCaughtUp() const { return queue_->taken == queue_->pushed; }

}  // namespace mocap
