#include "tools/camera_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>

#include "core/errors.h"

namespace mocap {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr std::int64_t kPeriod_ns = 40'000'000;
constexpr int kFrames = 200;

/// A camera that did all that it was asked for, 25 times a second.
CameraRun GoodRun(const std::string& name, std::int64_t offset_ns = 0) {
  CameraRun run;
  run.name = name;
  run.request.fps = 25;
  run.facts.fps = 25;
  run.facts.bus = "usb-1";
  run.facts.link_mbit_s = 480;
  run.facts.bytes_per_frame = 640 * 480 * 2;
  for (int i = 0; i < kFrames; ++i) {
    run.times_ns.push_back(1'000'000'000 + i * kPeriod_ns + offset_ns);
    run.sequences.push_back(static_cast<std::uint64_t>(i));
  }
  return run;
}

std::vector<std::string> Troubles(const CameraRun& run) { return TroublesOf(run, LoadsOf({run})); }

TEST(CameraCheck, FindsNothingWrongWithGoodCameras) {
  const std::vector<CameraRun> runs = {GoodRun("a"), GoodRun("b", 1'000'000)};
  EXPECT_THAT(Troubles(runs[0]), IsEmpty());
  const SetSummary sets = SummarizeSets(runs);
  EXPECT_EQ(sets.sets, kFrames);
  EXPECT_EQ(sets.complete, kFrames);
  EXPECT_EQ(sets.median_spread_ms, 1);
  EXPECT_THAT(TroublesOf(sets, runs), IsEmpty());
  EXPECT_NEAR(runs[0].Fps(), 25, 1e-9);
}

TEST(CameraCheck, TellsWhatTheDriverRemarked) {
  CameraRun run = GoodRun("a");
  run.facts.remarks = {"gain: the camera adjusts it automatically; set gain"};
  EXPECT_EQ(Troubles(run), run.facts.remarks);
  run.error = "/dev/video0: is in use";
  EXPECT_THAT(Troubles(run), ElementsAre(run.error));
}

TEST(CameraCheck, SlowCameraIsToldFromLostFrames) {
  CameraRun slow = GoodRun("a");
  for (std::int64_t& time_ns : slow.times_ns) time_ns *= 2;
  EXPECT_THAT(Troubles(slow), ElementsAre(HasSubstr("12.5 frames a second instead of 25")));
  EXPECT_THAT(Troubles(slow), ElementsAre(HasSubstr("exposure_us below 40000")));
  CameraRun lossy = GoodRun("a");
  for (int i = kFrames - 1; i > 0; i -= 2) {
    lossy.times_ns.erase(lossy.times_ns.begin() + i);
    lossy.sequences.erase(lossy.sequences.begin() + i);
  }
  EXPECT_EQ(lossy.MissedFrames(), 99);
  EXPECT_THAT(Troubles(lossy), ElementsAre(HasSubstr("99 of 199 frames were lost")));
}

TEST(CameraCheck, FullBusIsNamedWithItsCameras) {
  std::vector<CameraRun> runs = {GoodRun("a"), GoodRun("b"), GoodRun("c"), GoodRun("d")};
  const std::vector<BusLoad> loads = LoadsOf(runs);
  ASSERT_EQ(loads.size(), 1u);
  EXPECT_NEAR(loads[0].used_mbit_s, 4 * 640 * 480 * 2 * 25 * 8e-6, 1e-6);
  EXPECT_THAT(TroublesOf(loads[0]), ElementsAre(HasSubstr("usb-1 carries 492 of 480 Mbit/s")));
  runs[0].sequences.back() += 50;
  EXPECT_THAT(TroublesOf(runs[0], loads), ElementsAre(HasSubstr("usb-1 is full")));
}

TEST(CameraCheck, DamageLossAndSilenceHaveTheirKnobs) {
  CameraRun run = GoodRun("a");
  run.torn = 3;
  run.times_lost = 2;
  run.sequences.back() += 30;
  EXPECT_THAT(Troubles(run),
              ElementsAre(HasSubstr("was lost 2 times"), HasSubstr("3 frames arrived damaged")));
  CameraRun silent;
  silent.request.fps = 25;
  EXPECT_THAT(Troubles(silent), ElementsAre(HasSubstr("trigger")));
}

TEST(CameraCheck, CamerasThatWaitForAnotherAreToldOnce) {
  std::vector<CameraRun> runs = {GoodRun("a"), GoodRun("b"), GoodRun("c")};
  for (const std::size_t i : {1, 2}) {
    runs[i].waits_for = "a";
    runs[i].times_ns.clear();
  }
  EXPECT_THAT(Troubles(runs[1]), IsEmpty());
  EXPECT_THAT(TriggerTroublesOf(runs), ElementsAre(HasSubstr("no trigger from a reaches b, c: ")));
  runs[0].times_ns.clear();
  EXPECT_THAT(TriggerTroublesOf(runs),
              ElementsAre("waiting for the trigger of a, which delivers no frames: b, c"));
}

TEST(CameraCheck, DamagedFramesAreOneTroubleAndNoOther) {
  CameraRun damaged = GoodRun("a");
  for (int i = kFrames - 2; i > 0; i -= 4) {
    damaged.times_ns.erase(damaged.times_ns.begin() + i);
    damaged.sequences.erase(damaged.sequences.begin() + i);
    ++damaged.torn;
  }
  damaged.facts.damage = "packets are missing; lower fps";
  EXPECT_NEAR(damaged.TakenFps(), 25, 0.2);
  EXPECT_THAT(Troubles(damaged),
              ElementsAre("50 frames arrived damaged: packets are missing; lower fps"));
  const std::vector<CameraRun> runs = {GoodRun("b"), damaged};
  const SetSummary sets = SummarizeSets(runs);
  EXPECT_EQ(sets.complete, kFrames - 50);
  EXPECT_THAT(TroublesOf(sets, runs), IsEmpty());
}

TEST(CameraCheck, CamerasOutOfStepOrAtDifferentRatesAreTold) {
  std::vector<CameraRun> runs = {GoodRun("a"), GoodRun("b", kPeriod_ns / 4)};
  EXPECT_THAT(TroublesOf(SummarizeSets(runs), runs),
              ElementsAre(HasSubstr("not synchronized, 10.0 ms")));
  CameraRun half = GoodRun("c");
  for (std::size_t i = 0; i < half.times_ns.size(); ++i) {
    half.times_ns[i] = half.times_ns.front() + 2 * static_cast<std::int64_t>(i) * kPeriod_ns;
  }
  half.torn = 1;
  runs = {GoodRun("a"), GoodRun("b"), half};
  EXPECT_THAT(TroublesOf(SummarizeSets(runs), runs), Contains(HasSubstr("lack a camera")));
}

/// A camera that is not there.
class AbsentCamera : public CameraDriver {
 public:
  void Start() override { throw SetupError("it is not there"); }
  GrabStatus Grab(Frame&, std::chrono::milliseconds) override { return GrabStatus::kEnd; }
  void Stop() override {}
};

TEST(CameraCheck, CameraThatDoesNotStartIsAResult) {
  std::vector<LiveCamera> cameras(1);
  cameras[0].driver = std::make_unique<AbsentCamera>();
  const std::vector<CameraRun> runs = WatchCameras(cameras, 0.1);
  EXPECT_EQ(runs.at(0).error, "it is not there");
}

/// A camera that goes away with its first frame, and is then silent.
class LooseCamera : public CameraDriver {
 public:
  void Start() override {}
  GrabStatus Grab(Frame&, std::chrono::milliseconds) override {
    return std::exchange(is_loose_, false) ? GrabStatus::kLost : GrabStatus::kTimeout;
  }
  void Stop() override {}

 private:
  bool is_loose_ = true;
};

TEST(CameraCheck, CameraThatGoesAwayWhileItSettlesIsTold) {
  std::vector<LiveCamera> cameras(1);
  cameras[0].driver = std::make_unique<LooseCamera>();
  const std::vector<CameraRun> runs = WatchCameras(cameras, 0);
  EXPECT_THAT(TroublesOf(runs.at(0), {}), Contains(HasSubstr("was lost once")));
}

}  // namespace
}  // namespace mocap
