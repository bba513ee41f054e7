#include "drivers/capture_clock.h"

#include <sys/timex.h>

#include <cstdlib>
#include <utility>

namespace mocap {
namespace {

/// A PTP clock is accepted within this distance of the host's, which may follow NTP.
constexpr std::int64_t kNear_ns = 200'000'000;
/// An accepted clock is trusted up to this distance: a frame may be delayed.
constexpr std::int64_t kFar_ns = 2'000'000'000;
constexpr int kLeapSecondsSince2017 = 37;

}  // namespace

std::string_view Describe(TimeSource source) {
  switch (source) {
    case TimeSource::kArrival:
      return "arrival";
    case TimeSource::kDeviceClock:
      return "camera clock, fitted to the host's";
    case TimeSource::kPtp:
      return "PTP";
    case TimeSource::kPtpTai:
      return "PTP, TAI";
  }
  return "";
}

int LeapSeconds() {
  timex state{};
  if (adjtimex(&state) < 0 || state.tai <= 0) return kLeapSecondsSince2017;
  return state.tai;
}

TimeSource CaptureClock::Choose(std::int64_t ahead_ns, bool ptp_locked) const {
  if (!has_stamps_) return TimeSource::kArrival;
  if (!ptp_locked) return TimeSource::kDeviceClock;
  const auto limit_ns = [this](TimeSource source) {
    return source == source_ ? kFar_ns : kNear_ns;
  };
  if (std::abs(ahead_ns) < limit_ns(TimeSource::kPtp)) return TimeSource::kPtp;
  if (std::abs(ahead_ns - leap_ns_) < limit_ns(TimeSource::kPtpTai)) return TimeSource::kPtpTai;
  return TimeSource::kDeviceClock;
}

std::int64_t CaptureClock::MiddleOfExposure(std::int64_t stamp_ns, std::int64_t arrival_ns,
                                            std::int64_t exposure_ns, bool ptp_locked,
                                            std::int64_t time_of_day_ahead_ns) {
  const std::int64_t begin_ns = arrival_ns - exposure_ns;
  if (std::exchange(doubted_, false) && !fit_.Fits(stamp_ns, begin_ns)) fit_ = DeviceClock();
  if (has_stamps_) fit_.Observe(stamp_ns, begin_ns);
  const bool was_set = time_of_day_ahead_ns != time_of_day_ahead_ns_;
  time_of_day_ahead_ns_ = time_of_day_ahead_ns;
  if (was_set && source_ != TimeSource::kArrival) source_ = TimeSource::kDeviceClock;
  const std::int64_t ptp_ns = stamp_ns - time_of_day_ahead_ns;
  source_ = Choose(ptp_ns - begin_ns, ptp_locked);
  std::int64_t capture_ns = begin_ns;
  if (source_ == TimeSource::kDeviceClock) capture_ns = fit_.ToHost(stamp_ns);
  if (source_ == TimeSource::kPtp) capture_ns = ptp_ns;
  if (source_ == TimeSource::kPtpTai) capture_ns = ptp_ns - leap_ns_;
  return capture_ns + exposure_ns / 2;
}

}  // namespace mocap
