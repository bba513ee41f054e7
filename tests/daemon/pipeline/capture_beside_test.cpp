#include "daemon/pipeline/capture_beside.h"

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "config/load_config.h"

namespace mocap {
namespace {

constexpr std::int64_t kSecondNs = 1'000'000'000;
constexpr std::int64_t kPeriodNs = kSecondNs / 30;

/// Only notes when it was asked.
class Noting : public MotionCapture {
 public:
  Noting(CaptureState state, std::vector<std::int64_t>& times_ns) : times_ns_(times_ns) {
    result_.state = state;
  }

  const CaptureResult& Update(const Observation&, std::int64_t capture_ns,
                              UpdateObserver*) override {
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

bool WorkAtOnce(const std::function<void()>& work) {
  work();
  return true;
}

/// A side that works when it is told to.
class SlowSide : public ::testing::Test {
 protected:
  void See(std::int64_t begin_ns, std::int64_t period_ns, int sets) {
    for (int i = 0; i < sets; ++i) beside_->See({empty_, {}}, begin_ns + i * period_ns);
  }
  void Search(CaptureState state) {
    beside_.emplace(std::make_shared<Noting>(state, processed_ns_),
                    [this](std::function<void()> work) {
                      work_ = std::move(work);
                      return true;
                    });
  }

  VoxelGrid empty_;
  std::vector<std::int64_t> processed_ns_;
  std::function<void()> work_;
  std::optional<CaptureBeside> beside_;
};

TEST_F(SlowSide, TracksAllThatWaits) {
  Search(CaptureState::kAcquiring);
  See(0, kPeriodNs, 5);
  EXPECT_FALSE(beside_->HasCaughtUp());
  work_();
  EXPECT_TRUE(beside_->HasCaughtUp());
  EXPECT_EQ(processed_ns_,
            (std::vector<std::int64_t>{0, kPeriodNs, 2 * kPeriodNs, 3 * kPeriodNs, 4 * kPeriodNs}));
}

TEST_F(SlowSide, GoesOnWithTheLatestAfterASearchThatFoundNobody) {
  Search(CaptureState::kSearching);
  See(0, kPeriodNs, 5);
  work_();
  EXPECT_TRUE(beside_->HasCaughtUp());
  EXPECT_EQ(processed_ns_, (std::vector<std::int64_t>{0, 4 * kPeriodNs}));
}

TEST_F(SlowSide, KeepsWhatReachesUpToThePresent) {
  Search(CaptureState::kAcquiring);
  See(0, kPeriodNs, 100);
  work_();
  EXPECT_LE(processed_ns_.size(), 32u);
  EXPECT_GT(processed_ns_.back(), 94 * kPeriodNs);
  for (std::size_t i = 1; i < processed_ns_.size(); ++i)
    EXPECT_LE(processed_ns_[i] - processed_ns_[i - 1], kSecondNs / 4);
}

std::vector<std::int64_t> Processed(const std::vector<std::int64_t>& times_ns) {
  std::vector<std::int64_t> processed;
  CaptureBeside beside(std::make_shared<Noting>(CaptureState::kTracking, processed), WorkAtOnce);
  const VoxelGrid empty;
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
