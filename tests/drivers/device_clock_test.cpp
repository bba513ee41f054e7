#include "drivers/device_clock.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <random>
#include <vector>

namespace mocap {
namespace {

constexpr std::int64_t kFirst_ns = 1'750'000'000'000'000'000;
constexpr std::int64_t kDeviceSecond_ns = 1'000'000'000;
constexpr std::int64_t kTick_ns = kDeviceSecond_ns / 30;
constexpr double kJitter_ms = 5;

/// A camera whose clock is wrong, and a network that delays its frames.
struct WrongClock {
  std::int64_t offset_ns = 0;
  double drift_ppm = 0;
  std::mt19937 random{7};

  std::int64_t DeviceTime(std::int64_t host_ns) const {
    const auto running_ns = static_cast<double>(host_ns - kFirst_ns);
    return host_ns + offset_ns + std::llround(running_ns * drift_ppm * 1e-6);
  }
  std::int64_t Delay() {
    return std::llround(std::uniform_real_distribution<double>(0, kJitter_ms)(random) * 1e6);
  }
};

/// Runs frames [begin, end) and gives the largest error of any of them [ms].
double LargestError_ms(DeviceClock& clock, WrongClock& camera, int begin, int end) {
  double largest_ms = 0;
  for (int i = begin; i < end; ++i) {
    const std::int64_t host_ns = kFirst_ns + i * kTick_ns;
    clock.Observe(camera.DeviceTime(host_ns), host_ns + camera.Delay());
    const std::int64_t error_ns = clock.ToHost(camera.DeviceTime(host_ns)) - host_ns;
    largest_ms = std::max(largest_ms, static_cast<double>(std::abs(error_ns)) * 1e-6);
  }
  return largest_ms;
}

TEST(DeviceClock, FindsMinutesOfOffsetAndDriftThroughJitter) {
  for (const double drift_ppm : {-50.0, 0.0, 50.0}) {
    for (const std::int64_t minutes : {-17, 0, 3}) {
      WrongClock camera{minutes * 60 * kDeviceSecond_ns, drift_ppm};
      DeviceClock clock;
      EXPECT_LE(LargestError_ms(clock, camera, 0, 30), kJitter_ms);
      EXPECT_LT(LargestError_ms(clock, camera, 30, 30 * 20), 1.2);
      EXPECT_LT(LargestError_ms(clock, camera, 30 * 20, 30 * 600), 0.5);
      EXPECT_NEAR(clock.drift_ppm(), -drift_ppm, 8);
      EXPECT_EQ(clock.restarts(), 0);
    }
  }
}

TEST(DeviceClock, NeverTakesLongerThanTheJitterToBeRight) {
  WrongClock camera{kDeviceSecond_ns, 50};
  DeviceClock clock;
  EXPECT_LE(LargestError_ms(clock, camera, 0, 1), kJitter_ms);
}

TEST(DeviceClock, FramesThatWereHeldUpDoNotMoveIt) {
  WrongClock camera{60 * kDeviceSecond_ns, 20};
  DeviceClock clock;
  LargestError_ms(clock, camera, 0, 900);
  for (int i = 900; i < 910; ++i) {
    const std::int64_t host_ns = kFirst_ns + i * kTick_ns;
    clock.Observe(camera.DeviceTime(host_ns), host_ns + 2 * kDeviceSecond_ns);
    EXPECT_LT(std::abs(clock.ToHost(camera.DeviceTime(host_ns)) - host_ns), 500'000);
  }
  EXPECT_LT(LargestError_ms(clock, camera, 910, 1800), 0.5);
  EXPECT_EQ(clock.restarts(), 0);
}

TEST(DeviceClock, OneFrameThatCannotBeDoesNotMoveIt) {
  WrongClock camera{60 * kDeviceSecond_ns, 20};
  DeviceClock clock;
  LargestError_ms(clock, camera, 0, 900);
  const std::int64_t host_ns = kFirst_ns + 900 * kTick_ns;
  clock.Observe(camera.DeviceTime(host_ns), host_ns - kDeviceSecond_ns / 10);
  clock.Observe(camera.DeviceTime(kFirst_ns), host_ns);
  EXPECT_LT(LargestError_ms(clock, camera, 901, 1800), 0.5);
  EXPECT_EQ(clock.restarts(), 0);
}

TEST(DeviceClock, ClockThatBeganAnewIsLearnedAnew) {
  WrongClock camera{60 * kDeviceSecond_ns, 20};
  DeviceClock clock;
  LargestError_ms(clock, camera, 0, 900);
  for (const std::int64_t step_ns : {-3600 * kDeviceSecond_ns, 50 * kDeviceSecond_ns}) {
    camera.offset_ns += step_ns;
    const int restarts = clock.restarts();
    // A few frames, or a second of them, until it is believed.
    LargestError_ms(clock, camera, 900, 960);
    EXPECT_GT(clock.restarts(), restarts);
    EXPECT_LE(LargestError_ms(clock, camera, 960, 990), kJitter_ms);
  }
}

TEST(DeviceClock, AnHourThatOnlyTheHostSawIsBelievedAfterThreeFrames) {
  WrongClock camera{60 * kDeviceSecond_ns, 0};
  DeviceClock clock;
  LargestError_ms(clock, camera, 0, 900);
  constexpr int kHour = 3600 * 30;
  camera.offset_ns -= 3600 * kDeviceSecond_ns;
  LargestError_ms(clock, camera, kHour + 900, kHour + 903);
  EXPECT_LE(LargestError_ms(clock, camera, kHour + 903, kHour + 990), kJitter_ms);
  EXPECT_EQ(clock.restarts(), 1);
}

TEST(DeviceClock, FirstFramesThatWereHeldUpAreForgottenAtOnce) {
  WrongClock camera{60 * kDeviceSecond_ns, 0};
  DeviceClock clock;
  clock.Observe(camera.DeviceTime(kFirst_ns), kFirst_ns + 3 * kDeviceSecond_ns);
  EXPECT_LE(LargestError_ms(clock, camera, 1, 30), kJitter_ms);
}

TEST(DeviceClock, LearnsFromTwoFramesASecondToo) {
  WrongClock camera{60 * kDeviceSecond_ns, 50};
  DeviceClock clock;
  double largest_ms = 0;
  for (int i = 0; i < 240; ++i) {
    const std::int64_t host_ns = kFirst_ns + i * kDeviceSecond_ns / 2;
    clock.Observe(camera.DeviceTime(host_ns), host_ns + camera.Delay());
    if (i < 60) continue;
    const std::int64_t error_ns = clock.ToHost(camera.DeviceTime(host_ns)) - host_ns;
    largest_ms = std::max(largest_ms, static_cast<double>(std::abs(error_ns)) * 1e-6);
  }
  EXPECT_LT(largest_ms, 2);
}

}  // namespace
}  // namespace mocap
