#include "core/people/capture_beside.h"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "config/load_config.h"
#include "core/surface_capture.h"

namespace mocap {
namespace {

constexpr std::int64_t kSecondNs = 1'000'000'000;

/// Only notes when it was asked.
class Noting : public MotionCapture {
 public:
  explicit Noting(std::vector<std::int64_t>& times_ns) : times_ns_(times_ns) {}

  const CaptureResult& Update(const Sighting&, std::int64_t capture_ns, UpdateObserver*) override {
    times_ns_.push_back(capture_ns);
    return result_;
  }
  void Forget() override {}
  void Expect(const BodySizes&) override {}
  const CaptureResult& result() const override { return result_; }
  PoseState PredictedPose(std::int64_t) const override { return {}; }
  const BodyModel& body() const override { return body_; }
  int acquisition_frames() const override { return 0; }

 private:
  std::vector<std::int64_t>& times_ns_;
  CaptureResult result_;
  BodyModel body_{LoadBodyTable("full"), AverageSizes(1750)};
};

class AtOnce : public SideWork {
 public:
  bool Begin(std::function<void()> work) override {
    work();
    return true;
  }
};

std::vector<std::int64_t> Processed(const std::vector<std::int64_t>& times_ns) {
  std::vector<std::int64_t> processed;
  AtOnce side;
  CaptureBeside beside(std::make_shared<Noting>(processed), side);
  VoxelGrid empty;
  empty.Reset({0, 0, 0}, {0, 0, 0}, 25);
  for (const std::int64_t time_ns : times_ns) beside.See({empty, {}}, time_ns);
  EXPECT_TRUE(beside.HasCaughtUp());
  return processed;
}

TEST(CaptureBeside, SkipsWhatComesSoonerThanTrackingNeeds) {
  const std::int64_t ms = kSecondNs / 1000;
  EXPECT_EQ(Processed({0, 10 * ms, 20 * ms, 30 * ms, 40 * ms, 60 * ms}),
            (std::vector<std::int64_t>{0, 30 * ms, 60 * ms}));
}

TEST(CaptureBeside, GoesOnAfterTimesThatStepBack) {
  EXPECT_EQ(Processed({100 * kSecondNs, 40 * kSecondNs, 41 * kSecondNs}),
            (std::vector<std::int64_t>{100 * kSecondNs, 40 * kSecondNs, 41 * kSecondNs}));
}

}  // namespace
}  // namespace mocap
