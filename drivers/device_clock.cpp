#include "drivers/device_clock.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace mocap {
namespace {

constexpr std::int64_t kSlot_ns = 500'000'000;
/// Over a shorter span, the slope would be jitter.
constexpr std::int64_t kSlopeNeeds_ns = 20'000'000'000;
constexpr std::int64_t kRecent_ns = 5'000'000'000;
/// Earlier, no undelayed frame may have come yet.
constexpr std::int64_t kSettled_ns = 1'000'000'000;
/// Quartz is within 100 ppm; both clocks may be at this limit.
constexpr double kSteepest = 200e-6;
/// A frame earlier than this means that a clock was set.
constexpr std::int64_t kTooEarly_ns = 3'000'000;
constexpr int kEarlyToBelieve = 3;
/// Frames this late for a whole second mean the same.
constexpr std::int64_t kTooLate_ns = 500'000'000;
constexpr int kLateToBelieve = 30;
/// Several frames this late mean that a clock was set, or the host slept.
constexpr std::int64_t kFarTooLate_ns = 5'000'000'000;
constexpr int kFarTooLateToBelieve = 3;
/// After a camera was away, its first frame may be delayed by this much.
constexpr std::int64_t kAway_ns = 5'000'000'000;

}  // namespace

std::int64_t DeviceClock::OffsetAt(std::int64_t device_ns) const {
  return base_ns_ + std::llround(slope_ * static_cast<double>(device_ns - origin_ns_));
}

bool DeviceClock::Fits(std::int64_t device_ns, std::int64_t arrival_ns) const {
  if (used_ == 0 || device_ns <= last_ns_) return false;
  const std::int64_t above_ns = arrival_ns - device_ns - OffsetAt(device_ns);
  return above_ns > -kAway_ns && above_ns < kAway_ns;
}

void DeviceClock::Observe(std::int64_t device_ns, std::int64_t arrival_ns) {
  const Point point{device_ns, arrival_ns - device_ns};
  if (used_ == 0) {
    Restart(point);
    return;
  }
  const std::int64_t above_ns = point.offset_ns - OffsetAt(device_ns);
  if (IsDoubtful(point, above_ns)) return;
  last_ns_ = device_ns;
  if (above_ns < 0) base_ns_ += above_ns;
  Keep(point);
}

bool DeviceClock::IsDoubtful(const Point& point, std::int64_t above_ns) {
  const bool settled = last_ns_ - first_ns_ > kSettled_ns;
  const bool early = point.device_ns <= last_ns_ || (settled && above_ns < -kTooEarly_ns);
  const bool late = above_ns > kTooLate_ns;
  early_ = early ? early_ + 1 : 0;
  late_ = late ? late_ + 1 : 0;
  far_too_late_ = above_ns > kFarTooLate_ns ? far_too_late_ + 1 : 0;
  if (early_ >= kEarlyToBelieve || late_ >= kLateToBelieve ||
      far_too_late_ >= kFarTooLateToBelieve) {
    Restart(point);
    ++restarts_;
    return true;
  }
  return early || late;
}

void DeviceClock::Restart(const Point& point) {
  newest_ = 0;
  used_ = 1;
  slots_[0] = point;
  first_ns_ = last_ns_ = slot_begin_ns_ = origin_ns_ = point.device_ns;
  base_ns_ = point.offset_ns;
  slope_ = 0;
  early_ = late_ = far_too_late_ = 0;
}

void DeviceClock::Keep(const Point& point) {
  if (point.device_ns - slot_begin_ns_ < kSlot_ns) {
    Point& least = slots_[newest_];
    const auto above = [this](const Point& p) { return p.offset_ns - OffsetAt(p.device_ns); };
    if (above(point) < above(least)) least = point;
    return;
  }
  Fit();
  slot_begin_ns_ = point.device_ns;
  newest_ = (newest_ + 1) % kSlots;
  used_ = std::min(used_ + 1, kSlots);
  slots_[newest_] = point;
}

void DeviceClock::Fit() {
  const std::int64_t newest_ns = slot(0).device_ns;
  const std::int64_t span_ns = newest_ns - slot(used_ - 1).device_ns;
  slope_ = span_ns < kSlopeNeeds_ns ? 0 : std::clamp(HullSlope(), -kSteepest, kSteepest);
  // The last seconds define the current position of the line, despite any error in the slope.
  origin_ns_ = newest_ns;
  base_ns_ = slot(0).offset_ns;
  for (std::size_t age = 1; age < used_ && newest_ns - slot(age).device_ns < kRecent_ns; ++age) {
    base_ns_ += std::min<std::int64_t>(0, slot(age).offset_ns - OffsetAt(slot(age).device_ns));
  }
}

double DeviceClock::HullSlope() const {
  const auto slope = [](const Point& a, const Point& b) {
    return static_cast<double>(b.offset_ns - a.offset_ns) /
           static_cast<double>(b.device_ns - a.device_ns);
  };
  // The lower hull from left to right; the newest slot is last.
  std::array<Point, kSlots> hull;
  std::size_t size = 0;
  for (std::size_t age = used_; age-- > 0;) {
    const Point& point = slot(age);
    while (size >= 2 && slope(hull[size - 2], point) <= slope(hull[size - 2], hull[size - 1])) {
      --size;
    }
    hull[size++] = point;
  }
  const std::int64_t middle_ns = hull[0].device_ns / 2 + hull[size - 1].device_ns / 2;
  std::size_t right = 1;
  while (right + 1 < size && hull[right].device_ns < middle_ns) ++right;
  return slope(hull[right - 1], hull[right]);
}

}  // namespace mocap
