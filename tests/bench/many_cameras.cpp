// What a set costs the studio's threads against the number of cameras.
#include <benchmark/benchmark.h>

#include <cmath>

#include "config/load_config.h"
#include "core/make_motion_capture.h"
#include "core/people/people_capture.h"
#include "core/reconstruction/carving/carver.h"
#include "core/reconstruction/carving/hull_agreement.h"
#include "daemon/pipeline/synchronizer.h"
#include "tests/bench/seen_sets.h"

namespace mocap::bench {
namespace {

constexpr double kVoxel_mm = 25;

int CamerasOf(const benchmark::State& state) { return static_cast<int>(state.range(0)); }

std::int64_t TimeNs(int set) { return std::llround(1e9 * set / SeenSets::kFps); }

// Frames come one by one, and after each the synchronizer is asked, as the pipeline does.
void MatchManySets(benchmark::State& state) {
  const int cameras = CamerasOf(state);
  Synchronizer synchronizer(cameras, TimeNs(1), 1.75);
  int set = 0;
  for (auto _ : state) {
    for (int c = 0; c < cameras; ++c) {
      synchronizer.Offer(c, TimeNs(set), static_cast<std::uint64_t>(set));
      while (synchronizer.Decide() != Synchronizer::Decision::kWait) {
      }
    }
    ++set;
  }
}

void CompleteManySets(benchmark::State& state) {
  const SeenSets& studio = SeenSets::Get(CamerasOf(state));
  FloorShadows shadows(studio.cameras());
  std::vector<SeenSets::Seen> set;
  int index = 0;
  for (auto _ : state) {
    state.PauseTiming();
    set = studio.set(SeenSets::SetAt(index++));
    std::vector<ShadedView> views = studio.Shaded(set);
    state.ResumeTiming();
    shadows.Complete(views);
  }
}

void CarveManySets(benchmark::State& state) {
  const SeenSets& studio = SeenSets::Get(CamerasOf(state));
  std::vector<std::vector<CarvingView>> views;
  for (int i = 0; i < SeenSets::kSets; ++i) views.push_back(studio.Views(studio.set(i)));
  Carver carver({.voxel_mm = kVoxel_mm});
  VoxelGrid grid;
  int index = 0;
  for (auto _ : state)
    carver.Carve(views[static_cast<std::size_t>(SeenSets::SetAt(index++))], grid);
}

struct CarvedSeen {
  VoxelGrid grid;
  Eigen::AlignedBox3d person_box_W;
  std::vector<Outline> outlines;
};

std::vector<CarvedSeen> CarveAll(const SeenSets& studio) {
  Carver carver({.voxel_mm = kVoxel_mm});
  std::vector<CarvedSeen> carved(SeenSets::kSets);
  for (int i = 0; i < SeenSets::kSets; ++i) {
    CarvedSeen& set = carved[static_cast<std::size_t>(i)];
    carver.Carve(studio.Views(studio.set(i)), set.grid);
    set.person_box_W = carver.person_box_W();
    for (const SeenSets::Seen& seen : studio.set(i)) set.outlines.push_back(seen.outline);
  }
  return carved;
}

void TrackManySets(benchmark::State& state) {
  // Until the person is known and the sizes have settled.
  constexpr int kWarmUpSets = 150;
  const SeenSets& studio = SeenSets::Get(CamerasOf(state));
  const std::vector<CarvedSeen> carved = CarveAll(studio);
  const std::vector<CameraEye> eyes = studio.Eyes();
  const BodyTable body = LoadBodyTable("full");
  PeopleCapture people([&] { return MakeMotionCapture(TrackerKind::kSurface, body); }, {});
  int index = 0, tracked = 0;
  const auto update = [&] {
    const CarvedSeen& set = carved[static_cast<std::size_t>(SeenSets::SetAt(index))];
    people.Update({set.grid, set.outlines, set.person_box_W}, eyes, TimeNs(index++));
    tracked += people.first().result().state == CaptureState::kTracking;
  };
  while (index < kWarmUpSets) update();
  for (auto _ : state) update();
  state.counters["tracked"] = static_cast<double>(tracked) / index;
}

// One look of the health watch, which takes its time in a thread of its own.
void CheckManyCameras(benchmark::State& state) {
  const SeenSets& studio = SeenSets::Get(CamerasOf(state));
  HullAgreement agreement;
  int index = 0;
  for (auto _ : state) {
    const std::vector<CarvingView> views = studio.Views(studio.set(SeenSets::SetAt(index++)));
    benchmark::DoNotOptimize(agreement.PlaceOf(views));
    benchmark::DoNotOptimize(agreement.Measure(views));
  }
}

void ForManyCameras(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgName("cameras")->Unit(benchmark::kMicrosecond);
  for (const int cameras : {2, 4, 6, 8, 12, 16, 24, 32, 48, 64}) benchmark->Arg(cameras);
}

BENCHMARK(MatchManySets)->Apply(ForManyCameras);
BENCHMARK(CompleteManySets)->Apply(ForManyCameras);
BENCHMARK(CarveManySets)->Apply(ForManyCameras);
BENCHMARK(TrackManySets)->Apply(ForManyCameras);
BENCHMARK(CheckManyCameras)->Apply(ForManyCameras);

}  // namespace
}  // namespace mocap::bench
