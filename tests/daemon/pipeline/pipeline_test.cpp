#include "daemon/pipeline/pipeline.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <functional>
#include <set>
#include <span>
#include <stdexcept>
#include <thread>
#include <vector>

#include "config/load_config.h"
#include "core/errors.h"
#include "daemon/pipeline/load_control.h"
#include "drivers/clock.h"
#include "drivers/simulation/simulated_studio.h"
#include "tests/daemon/fake_studio.h"
#include "tests/support/setup_error.h"

namespace mocap {
namespace {

using testing::FakeGrab;
using testing::FakeScript;
using testing::FakeStudio;
using testing::kFakePeriodNs;
using testing::SteadyFrames;

/// All that a sink sees of a set, to compare runs.
struct Seen {
  std::int64_t frame, capture_ns;
  std::uint64_t cameras;
  CaptureState state;
  std::vector<std::uint64_t> voxels;
  BodyPoints points_W;

  friend bool operator==(const Seen& a, const Seen& b) {
    return a.frame == b.frame && a.capture_ns == b.capture_ns && a.cameras == b.cameras &&
           a.state == b.state && a.voxels == b.voxels &&
           (a.state == CaptureState::kSearching || a.points_W == b.points_W);
  }
};

class RecordingSink : public PoseSink {
 public:
  void OnSet(const TrackedSet& set) override {
    seen.push_back({set.frame, set.capture_ns, set.cameras, set.result.state, set.grid.words(),
                    set.result.points_W});
    if (on_set) on_set(seen.back());
  }

  std::vector<Seen> seen;
  std::function<void(const Seen&)> on_set;
};

PipelineOptions Waiting() {
  return {.voxel_mm = 50, .overflow = Overflow::kWait, .latency_origin = LatencyOrigin::kArrival};
}

PipelineOptions Live() { return {.voxel_mm = 50, .overflow = Overflow::kDropOldest}; }

void RunToEnd(Pipeline& pipeline) {
  pipeline.Start();
  pipeline.Join();
}

/// A person who walks, in pictures so small that it is a matter of seconds.
Studio SmallSimulation(int cameras = 4, double seconds = 0.8) {
  SimulatedStudioOptions options = RecordedSimulation();
  options.cameras = cameras;
  options.width_px = 160;
  options.height_px = 120;
  options.seconds = seconds;
  return OpenSimulatedStudio(options);
}

TEST(Pipeline, ThreadedEqualsSerialBitForBit) {
  RecordingSink serial;
  Pipeline(SmallSimulation(), Waiting(), LoadBodyTable("full"), serial).RunSerially();
  ASSERT_EQ(serial.seen.size(), 24u);
  EXPECT_NE(serial.seen.back().state, CaptureState::kSearching) << "the comparison must see poses";
  RecordingSink threaded;
  Pipeline pipeline(SmallSimulation(), Waiting(), LoadBodyTable("full"), threaded);
  RunToEnd(pipeline);
  EXPECT_TRUE(threaded.seen == serial.seen);
}

TEST(Pipeline, SetsBeforeTheFirstAreLeftOutAndTheOthersKeepTheirEvidence) {
  RecordingSink all, later, serial;
  Pipeline(SmallSimulation(), Waiting(), LoadBodyTable("full"), all).RunSerially();
  PipelineOptions options = Waiting();
  options.first_set = 7;
  Pipeline pipeline(SmallSimulation(), options, LoadBodyTable("full"), later);
  RunToEnd(pipeline);
  ASSERT_EQ(later.seen.size(), all.seen.size() - 7);
  for (std::size_t i = 0; i < later.seen.size(); ++i) {
    EXPECT_EQ(later.seen[i].frame, all.seen[i + 7].frame);
    EXPECT_EQ(later.seen[i].capture_ns, all.seen[i + 7].capture_ns);
    EXPECT_EQ(later.seen[i].voxels, all.seen[i + 7].voxels);
  }
  Pipeline(SmallSimulation(), options, LoadBodyTable("full"), serial).RunSerially();
  EXPECT_TRUE(serial.seen == later.seen);
}

TEST(Pipeline, OtherStartsSeeWhatTheyWouldSeeAlone) {
  RecordingSink all, later, alone;
  PipelineOptions options = Waiting();
  options.other_starts = {{12, &later}};
  Pipeline pipeline(SmallSimulation(), options, LoadBodyTable("full"), all);
  RunToEnd(pipeline);
  options.other_starts.clear();
  options.first_set = 12;
  Pipeline(SmallSimulation(), options, LoadBodyTable("full"), alone).RunSerially();
  ASSERT_EQ(all.seen.size(), 24u);
  ASSERT_NE(alone.seen.back().state, CaptureState::kSearching);
  EXPECT_TRUE(later.seen == alone.seen);
  EXPECT_FALSE(std::ranges::equal(alone.seen, std::span(all.seen).last(12)))
      << "the first set must matter";
}

TEST(Pipeline, SixtyFourCamerasCarveTogether) {
  RecordingSink sink;
  Pipeline pipeline(SmallSimulation(64, 0.1), Waiting(), LoadBodyTable("full"), sink);
  RunToEnd(pipeline);
  ASSERT_EQ(sink.seen.size(), 3u);
  for (const Seen& set : sink.seen) {
    EXPECT_EQ(set.cameras, ~std::uint64_t{0});
    EXPECT_GT(std::ranges::count_if(set.voxels, [](std::uint64_t word) { return word != 0; }), 100);
  }
}

TEST(Pipeline, EachOfManyCamerasMayBeTheOneThatIsMissing) {
  for (const int cameras : {33, 63, 64}) {
    std::vector<FakeScript> scripts(static_cast<std::size_t>(cameras), SteadyFrames(4));
    scripts.back() = SteadyFrames(2);
    RecordingSink sink;
    Pipeline(FakeStudio(scripts), Waiting(), LoadBodyTable("full"), sink).RunSerially();
    ASSERT_EQ(sink.seen.size(), 4u);
    const std::uint64_t all = ~std::uint64_t{0} >> (64 - cameras);
    EXPECT_EQ(sink.seen[1].cameras, all);
    EXPECT_EQ(sink.seen[2].cameras, all >> 1);
  }
}

TEST(Pipeline, SixtyFiveCamerasAreRefusedByTheStudiosName) {
  Studio studio = FakeStudio(std::vector<FakeScript>(65, SteadyFrames(1)));
  const std::string name = studio.name;
  RecordingSink sink;
  const std::string said = testing::SetupErrorOf(
      [&] { Pipeline(std::move(studio), Waiting(), LoadBodyTable("full"), sink); });
  EXPECT_EQ(said, name + ": has 65 cameras; expected 1 to 64");
}

TEST(Pipeline, TracksEverySetInOrderWhenItMayWait) {
  RecordingSink sink;
  Pipeline pipeline(FakeStudio({SteadyFrames(40), SteadyFrames(40), SteadyFrames(25)}), Waiting(),
                    LoadBodyTable("full"), sink);
  RunToEnd(pipeline);
  ASSERT_EQ(sink.seen.size(), 40u);
  for (int n = 0; n < 40; ++n) {
    EXPECT_EQ(sink.seen[n].frame, n);
    EXPECT_EQ(sink.seen[n].capture_ns, n * kFakePeriodNs);
    EXPECT_EQ(sink.seen[n].cameras, n < 25 ? 0b111u : 0b011u);
  }
  const PipelineStatus status = pipeline.Status();
  EXPECT_EQ(status.sets_complete, 25);
  EXPECT_EQ(status.sets_partial, 15);
  EXPECT_EQ(status.sets_dropped, 0);
  EXPECT_EQ(status.sets_tracked, 40);
  EXPECT_EQ(status.cameras[2].frames, 25);
  EXPECT_EQ(status.cameras[2].state, CameraState::kEnded);
  EXPECT_EQ(status.stages[Stage::kSegment].count(), 105);
  EXPECT_EQ(status.stages[Stage::kTotal].count(), 40);
  EXPECT_EQ(status.stages[Stage::kPublish].count(), 40);
}

TEST(Pipeline, TracksOnWhenTheClockIsPutBack) {
  const FakeScript script = [](int call) {
    constexpr std::int64_t kHourNs = 3'600'000'000'000;
    if (call >= 20) return FakeGrab{};
    return FakeGrab{GrabStatus::kFrame,
                    call < 10 ? kHourNs + call * kFakePeriodNs : (call - 10) * kFakePeriodNs};
  };
  RecordingSink sink;
  Pipeline pipeline(FakeStudio({script, script, script}), Waiting(), LoadBodyTable("full"), sink);
  pipeline.RunSerially();
  ASSERT_EQ(sink.seen.size(), 20u);
  EXPECT_EQ(sink.seen.back().capture_ns, 9 * kFakePeriodNs);
  EXPECT_EQ(sink.seen.back().cameras, 0b111u);
}

TEST(Pipeline, GoesOnWithoutALostCameraAndTakesItBack) {
  std::atomic<int> sets{0};
  std::atomic<bool> is_back{false};
  // Lost from frame 10 on, back with frame 20 once the sets before it are through.
  const FakeScript lost_for_a_while = [&, next = 0](int) mutable {
    if (next == 10 && sets < 20) return FakeGrab{GrabStatus::kLost, 0};
    if (next == 10) next = 20;
    if (next == 21) is_back = true;
    return next < 30 ? FakeGrab{GrabStatus::kFrame, next++ * kFakePeriodNs} : FakeGrab{};
  };
  const FakeScript waits_for_it = [&](int call) {
    while (call == 20 && !is_back) std::this_thread::yield();
    return SteadyFrames(30)(call);
  };
  RecordingSink sink;
  sink.on_set = [&](const Seen&) { ++sets; };
  Pipeline pipeline(FakeStudio({waits_for_it, waits_for_it, lost_for_a_while}), Waiting(),
                    LoadBodyTable("full"), sink);
  RunToEnd(pipeline);
  ASSERT_EQ(sink.seen.size(), 30u);
  for (int n = 0; n < 30; ++n) {
    EXPECT_EQ(sink.seen[n].cameras, n < 10 || n >= 20 ? 0b111u : 0b011u) << "set " << n;
  }
}

TEST(Pipeline, CountsTornFramesAndGoesOn) {
  const FakeScript torn = [](int call) {
    if (call == 12) return FakeGrab{};
    return call % 3 == 1 ? FakeGrab{GrabStatus::kTorn, 0}
                         : FakeGrab{GrabStatus::kFrame, call * kFakePeriodNs};
  };
  RecordingSink sink;
  Pipeline pipeline(FakeStudio({SteadyFrames(12), torn, SteadyFrames(12)}), Waiting(),
                    LoadBodyTable("full"), sink);
  RunToEnd(pipeline);
  ASSERT_EQ(sink.seen.size(), 12u);
  for (int n = 0; n < 12; ++n) EXPECT_EQ(sink.seen[n].cameras, n % 3 == 1 ? 0b101u : 0b111u);
  EXPECT_EQ(pipeline.Status().cameras[1].torn, 4);
}

TEST(Pipeline, PassesOnWhatDriversRemark) {
  RecordingSink sink;
  Pipeline pipeline(FakeStudio({SteadyFrames(2), SteadyFrames(2)}), Waiting(),
                    LoadBodyTable("full"), sink);
  pipeline.RunSerially();
  EXPECT_EQ(pipeline.Status().cameras[1].remarks, std::vector<std::string>{"is fake"});
}

// Otherwise each of more than a hundred keeps the memory of the largest hull that it ever held.
TEST(Pipeline, LiveSetsShareAFewGridsWhileNoneWaits) {
  struct : PoseSink {
    void OnSet(const TrackedSet& set) override { grids.insert(set.grid.words().data()); }
    std::set<const std::uint64_t*> grids;
  } sink;
  std::atomic<const Pipeline*> running{nullptr};
  const FakeScript one_by_one = [&](int call) {
    const auto done = [&] {
      const PipelineStatus status = running.load()->Status();
      return status.sets_tracked + status.cameras[0].dropped;
    };
    while (!running || done() < call) std::this_thread::yield();
    return call < 200 ? FakeGrab{GrabStatus::kFrame, TimelineNs()} : FakeGrab{};
  };
  Pipeline pipeline(FakeStudio({one_by_one}), Live(), LoadBodyTable("full"), sink);
  running = &pipeline;
  RunToEnd(pipeline);
  EXPECT_GT(pipeline.Status().sets_tracked, 20);
  EXPECT_LE(sink.grids.size(), GridShelf::kPlaces + 2);
}

TEST(Pipeline, LiveLeavesSetsOutWhenTheSinkIsSlow) {
  // The first set is held until the cameras have delivered far more than may be under way.
  std::atomic<int> grabbed{0};
  const FakeScript present = [&](int call) {
    grabbed = std::max(grabbed.load(), call);
    const std::int64_t capture_ns = TimelineNs();
    return call < 200 ? FakeGrab{GrabStatus::kFrame, capture_ns} : FakeGrab{};
  };
  RecordingSink sink;
  sink.on_set = [&](const Seen& set) {
    while (set.frame == 0 && grabbed < 200) std::this_thread::yield();
  };
  Pipeline pipeline(FakeStudio({present}), Live(), LoadBodyTable("full"), sink);
  RunToEnd(pipeline);
  ASSERT_GE(sink.seen.size(), 1u);
  EXPECT_LE(sink.seen.size(), static_cast<std::size_t>(LoadControl::kMostUnderWay) + 2);
  for (std::size_t i = 1; i < sink.seen.size(); ++i) {
    EXPECT_EQ(sink.seen[i].frame, sink.seen[i - 1].frame + 1);
    EXPECT_GT(sink.seen[i].capture_ns, sink.seen[i - 1].capture_ns);
  }
  const CameraStatus camera = pipeline.Status().cameras[0];
  EXPECT_EQ(camera.frames, 200);
  EXPECT_EQ(camera.dropped + pipeline.Status().sets_tracked, 200);
}

TEST(Pipeline, StopsASourceWithoutEnd) {
  const FakeScript endless = [](int call) {
    return FakeGrab{GrabStatus::kFrame, call * kFakePeriodNs};
  };
  RecordingSink sink;
  Pipeline pipeline(FakeStudio({endless, endless}), Waiting(), LoadBodyTable("full"), sink);
  sink.on_set = [&](const Seen& set) {
    if (set.frame == 5) pipeline.RequestStop();
  };
  RunToEnd(pipeline);
  EXPECT_TRUE(pipeline.finished());
  EXPECT_GE(sink.seen.size(), 6u);
}

TEST(Pipeline, ACameraThatDoesNotStartIsASetupError) {
  const FakeScript endless = [](int call) {
    return FakeGrab{GrabStatus::kFrame, call * kFakePeriodNs};
  };
  RecordingSink sink;
  Pipeline pipeline(FakeStudio({endless, nullptr, endless}), Waiting(), LoadBodyTable("full"),
                    sink);
  pipeline.Start();
  EXPECT_THROW(pipeline.Join(), SetupError);
}

TEST(Pipeline, AFailingSinkEndsTheRunWithItsError) {
  const FakeScript endless = [](int call) {
    return FakeGrab{GrabStatus::kFrame, call * kFakePeriodNs};
  };
  RecordingSink sink;
  sink.on_set = [](const Seen& set) {
    if (set.frame == 3) throw std::runtime_error("the disk is full");
  };
  Pipeline pipeline(FakeStudio({endless, endless}), Waiting(), LoadBodyTable("full"), sink);
  pipeline.Start();
  EXPECT_THROW(pipeline.Join(), std::runtime_error);
  EXPECT_EQ(sink.seen.size(), 4u);
}

TEST(Pipeline, AStudioWithoutCamerasIsASetupError) {
  RecordingSink sink;
  EXPECT_THROW(Pipeline(FakeStudio({}), Waiting(), LoadBodyTable("full"), sink), SetupError);
}

}  // namespace
}  // namespace mocap
