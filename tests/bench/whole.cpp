// What the whole pipeline costs, without reading frames: they are in memory.
#include <benchmark/benchmark.h>

#include "config/load_config.h"
#include "daemon/pipeline.h"
#include "tests/bench/recorded_studio.h"

namespace mocap::bench {
namespace {

constexpr int kSets = 400;

class Nowhere : public PoseSink {
 public:
  void OnSet(const TrackedSet& set) override { benchmark::DoNotOptimize(set.result.pose); }
};

// Arguments: cameras, height of the pictures [px], edge of a voxel [mm], whether in one thread.
void TrackSets(benchmark::State& state) {
  const auto height_px = static_cast<int>(state.range(1));
  const RecordedStudio& studio = RecordedStudio::Get({.cameras = static_cast<int>(state.range(0)),
                                                      .width_px = height_px * 4 / 3,
                                                      .height_px = height_px});
  Nowhere nowhere;
  const BodyTable body = LoadBodyTable("full");
  for (auto _ : state) {
    state.PauseTiming();
    Pipeline pipeline(studio.Open(kSets),
                      {.voxel_mm = static_cast<double>(state.range(2)),
                       .overflow = Overflow::kWait,
                       .latency_origin = LatencyOrigin::kArrival},
                      body, nowhere);
    state.ResumeTiming();
    if (state.range(3) == 1) {
      pipeline.RunSerially();
    } else {
      pipeline.Start();
      pipeline.Join();
    }
    state.PauseTiming();
    const StageHistograms stages = pipeline.Status().stages;
    for (const Stage stage : {Stage::kSegment, Stage::kCarve, Stage::kLabel, Stage::kFilter}) {
      state.counters[std::string(kStageNames[static_cast<std::size_t>(stage)]) + "_us"] =
          1e3 * stages[stage].PercentileMs(0.5);
    }
    const double median_ms = stages[Stage::kTotal].PercentileMs(0.5);
    state.counters["p99_per_p50"] = stages[Stage::kTotal].PercentileMs(0.99) / median_ms;
    state.ResumeTiming();
  }
  state.counters["sets_per_s"] = benchmark::Counter(static_cast<double>(kSets * state.iterations()),
                                                    benchmark::Counter::kIsRate);
}

BENCHMARK(TrackSets)
    ->ArgNames({"cameras", "height", "mm", "serial"})
    ->Args({6, 480, 25, 1})
    ->Args({6, 480, 25, 0})
    ->Args({6, 480, 10, 0})
    ->Args({6, 1080, 25, 0})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->MeasureProcessCPUTime()
    ->Iterations(1);

}  // namespace
}  // namespace mocap::bench
