#include "tools/gige/studio_source.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "drivers/clock.h"

namespace mocap {
namespace {

using std::chrono::nanoseconds;

/// Long enough to learn the background.
constexpr std::chrono::seconds kHeadStart{5};

}  // namespace

StudioSource::StudioSource(StudioStage& stage, int camera, int cameras, double fps,
                           Image<Bgr> empty, std::unique_ptr<CameraDriver> recording,
                           std::function<bool()> is_streaming)
    : stage_(stage),
      camera_(camera),
      cameras_(cameras),
      period_ns_(std::llround(1e9 / fps)),
      empty_(std::move(empty)),
      recording_(std::move(recording)),
      is_streaming_(std::move(is_streaming)) {}

bool StudioSource::HasBegun() {
  if (stage_.begin_ns.load() == 0) {
    stage_.streams[camera_].store(is_streaming_());
    const auto begin = stage_.streams.begin();
    if (!std::all_of(begin, begin + cameras_, [](const auto& streams) { return streams.load(); })) {
      return false;
    }
    std::int64_t not_yet = 0;
    const std::int64_t soon_ns = TimelineNs() + nanoseconds(kHeadStart).count();
    stage_.begin_ns.compare_exchange_strong(not_yet, soon_ns);
  }
  if (!std::exchange(started_, true)) recording_->Start();
  return TimelineNs() >= stage_.begin_ns.load() - 2 * period_ns_;
}

GrabStatus StudioSource::Grab(Frame& frame, std::chrono::milliseconds timeout) {
  if (HasBegun()) return recording_->Grab(frame, timeout);
  const std::int64_t due_ns = (TimelineNs() / period_ns_ + 1) * period_ns_;
  SleepUntil(due_ns);
  frame = {.image = empty_.view(), .capture_ns = due_ns, .sequence = shown_++, .angles = {}};
  return GrabStatus::kFrame;
}

void StudioSource::Stop() {
  if (std::exchange(started_, false)) recording_->Stop();
}

}  // namespace mocap
