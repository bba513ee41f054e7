// What the whole pipeline costs, without reading frames: they are in memory.
#include <benchmark/benchmark.h>

#include "config/load_config.h"
#include "daemon/pipeline/pipeline.h"
#include "drivers/clock.h"
#include "tests/bench/recorded_studio.h"

namespace mocap::bench {
namespace {

// Until the person is known and memory has its size.
constexpr int kWarmUpSets = 200;
// What waits in queues when the warm-up ends is few of them.
constexpr int kSets = 2000;
// A live source takes its time: 30 s.
constexpr int kLiveSets = 900;

// Measures from the first set after the warm-up to the last.
class Meter : public PoseSink {
 public:
  explicit Meter(int sets) : last_(sets) {}
  void Watch(const Pipeline& pipeline) { pipeline_ = &pipeline; }
  void OnSet(const TrackedSet& set) override {
    benchmark::DoNotOptimize(set.result.pose);
    tracked_ += set.result.state == CaptureState::kTracking;
    ++sets_;
    if (sets_ == kWarmUpSets) {
      before_ = pipeline_->Status().stages;
      begin_ns_ = SteadyNs();
    }
    if (sets_ == last_) end_ns_ = SteadyNs();
  }
  double seconds() const { return static_cast<double>(end_ns_ - begin_ns_) / 1e9; }
  StageHistograms stages() const { return pipeline_->Status().stages.Since(before_); }
  int tracked() const { return tracked_; }

 private:
  const Pipeline* pipeline_ = nullptr;
  StageHistograms before_;
  int last_;
  int sets_ = 0, tracked_ = 0;
  std::int64_t begin_ns_ = 0, end_ns_ = 0;
};

// The recording of a benchmark whose first arguments are cameras and height of the pictures [px].
const RecordedStudio& StudioOf(const benchmark::State& state) {
  const auto height_px = static_cast<int>(state.range(1));
  return RecordedStudio::Get({.cameras = static_cast<int>(state.range(0)),
                              .width_px = height_px * 4 / 3,
                              .height_px = height_px});
}

void CountPercentiles(const LatencyHistogram& times, benchmark::State& state) {
  const double median_ms = times.PercentileMs(0.5);
  state.counters["p50_ms"] = median_ms;
  state.counters["p99_per_p50"] = times.PercentileMs(0.99) / median_ms;
}

// Arguments: cameras, height of the pictures [px], edge of a voxel [mm], whether in one thread.
void TrackSets(benchmark::State& state) {
  const RecordedStudio& studio = StudioOf(state);
  const BodyTable body = LoadBodyTable("full");
  for (auto _ : state) {
    Meter meter(kSets);
    Pipeline pipeline(studio.Open(kSets),
                      {.voxel_mm = static_cast<double>(state.range(2)),
                       .overflow = Overflow::kWait,
                       .latency_origin = LatencyOrigin::kArrival},
                      body, meter);
    meter.Watch(pipeline);
    if (state.range(3) == 1) {
      pipeline.RunSerially();
    } else {
      pipeline.Start();
      pipeline.Join();
    }
    state.SetIterationTime(meter.seconds() / (kSets - kWarmUpSets));
    const StageHistograms stages = meter.stages();
    for (const Stage stage : {Stage::kSegment, Stage::kCarve, Stage::kLabel, Stage::kFilter}) {
      state.counters[std::string(kStageNames[static_cast<std::size_t>(stage)]) + "_us"] =
          1e3 * stages[stage].PercentileMs(0.5);
    }
    CountPercentiles(stages[Stage::kTotal], state);
    state.counters["tracked"] = static_cast<double>(meter.tracked()) / kSets;
    state.counters["sets_per_s"] = (kSets - kWarmUpSets) / meter.seconds();
  }
}

// Arguments: cameras, height of the pictures [px]. Counts the latency from a set's last frame to
// its pose, where frames come at the cameras' rate. Threads that get frames as fast as they take
// them wait for processors: their percentiles say how many of those there are.
void TrackLiveSets(benchmark::State& state) {
  const RecordedStudio& studio = StudioOf(state);
  const BodyTable body = LoadBodyTable("full");
  for (auto _ : state) {
    Meter meter(kLiveSets);
    Pipeline pipeline(studio.Open(kLiveSets, RecordedStudio::Pace::kLive),
                      {.latency_origin = LatencyOrigin::kArrival}, body, meter);
    meter.Watch(pipeline);
    pipeline.Start();
    pipeline.Join();
    CountPercentiles(meter.stages()[Stage::kLatency], state);
    state.counters["tracked"] = static_cast<double>(meter.tracked()) / kLiveSets;
  }
}

BENCHMARK(TrackSets)
    ->ArgNames({"cameras", "height", "mm", "serial"})
    ->Args({6, 480, 25, 1})
    ->Args({6, 480, 25, 0})
    ->Args({6, 480, 10, 0})
    ->Args({6, 1080, 25, 0})
    ->Args({6, 1080, 25, 1})
    ->Unit(benchmark::kMillisecond)
    ->UseManualTime()
    ->Iterations(1);

BENCHMARK(TrackLiveSets)
    ->ArgNames({"cameras", "height"})
    ->Args({6, 480})
    ->Args({6, 1080})
    ->Unit(benchmark::kMillisecond)
    ->Iterations(1);

}  // namespace
}  // namespace mocap::bench
