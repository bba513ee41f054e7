// What each stage costs, and what others need for the same.
#include <benchmark/benchmark.h>

#include <cstring>
#include <opencv2/video/background_segm.hpp>

#include "core/reconstruction/carving/carver.h"
#include "core/reconstruction/silhouette/outline.h"
#include "tests/bench/recorded_studio.h"

namespace mocap::bench {
namespace {

constexpr int kRays = 100;

StudioSize SizeOf(const benchmark::State& state, int cameras = 6) {
  const auto height_px = static_cast<int>(state.range(0));
  return {.cameras = cameras, .width_px = height_px * 4 / 3, .height_px = height_px};
}

// The same bytes copied once: less is not possible.
void CopyFrame(benchmark::State& state) {
  const RecordedStudio& studio = RecordedStudio::Get(SizeOf(state));
  const ImageView<const Bgr> first = studio.frame(0, 0);
  std::vector<Bgr> copy(static_cast<std::size_t>(first.width()) * first.height());
  int set = 0;
  for (auto _ : state) {
    std::memcpy(copy.data(), studio.frame(0, set++ % RecordedStudio::kSets).row(0),
                copy.size() * sizeof(Bgr));
    benchmark::ClobberMemory();
  }
}

// Calls `segment` with the next picture of each camera in turn, as they come: some see the person
// larger than others, and what is known of all of them may not fit into the cache.
// Arguments: height of the pictures [px], cameras.
template <typename Segment>
void SegmentInTurn(benchmark::State& state, const RecordedStudio& studio, const Segment& segment) {
  const auto cameras = static_cast<int>(state.range(1));
  int picture = 0;
  for (auto _ : state) {
    const int camera = picture % cameras;
    segment(camera, studio.frame(camera, RecordedStudio::SetAt(picture / cameras)));
    ++picture;
  }
}

void SegmentFrame(benchmark::State& state) {
  const RecordedStudio& studio = RecordedStudio::Get(SizeOf(state));
  std::vector<Segmenter> segmenters;
  for (int camera = 0; camera < state.range(1); ++camera)
    segmenters.emplace_back(studio.cameras()[camera], studio.background(camera),
                            SegmentationOptions{});
  Trimap trimap;
  SegmentInTurn(state, studio, [&](int camera, ImageView<const Bgr> frame) {
    segmenters[camera].Segment(frame, {}, trimap);
  });
}

template <typename Create>
void SegmentByOpenCv(benchmark::State& state, const Create& create) {
  const RecordedStudio& studio = RecordedStudio::Get(SizeOf(state));
  cv::setNumThreads(1);
  const auto wrap = [](ImageView<const Bgr> image) {
    return cv::Mat(image.height(), image.width(), CV_8UC3, const_cast<Bgr*>(image.row(0)));
  };
  cv::Mat mask;
  std::vector<cv::Ptr<cv::BackgroundSubtractor>> subtractors;
  for (int camera = 0; camera < state.range(1); ++camera) {
    subtractors.push_back(create());
    for (const BackgroundFrame& frame : studio.background(camera))
      subtractors.back()->apply(wrap(frame.image.view()), mask);
  }
  SegmentInTurn(state, studio, [&](int camera, ImageView<const Bgr> frame) {
    subtractors[camera]->apply(wrap(frame), mask, 0);
  });
}

void LearnBackground(benchmark::State& state) {
  const RecordedStudio& studio = RecordedStudio::Get(SizeOf(state));
  for (auto _ : state) {
    Segmenter segmenter(studio.cameras()[0], studio.background(0), {});
    benchmark::DoNotOptimize(segmenter);
  }
}

void TraceFrame(benchmark::State& state) {
  const RecordedStudio& studio = RecordedStudio::Get(SizeOf(state));
  Outline outline;
  int set = 0;
  for (auto _ : state)
    TraceOutline(studio.cameras()[0], studio.cameras()[0].X_CW,
                 studio.trimap(0, set++ % RecordedStudio::kSets), kRays, outline);
}

// Arguments: height of the pictures [px], edge of a voxel [mm], cameras.
void CarveSet(benchmark::State& state) {
  const RecordedStudio& studio =
      RecordedStudio::Get(SizeOf(state, static_cast<int>(state.range(2))));
  std::vector<std::vector<CarvingView>> views;
  for (int set = 0; set < RecordedStudio::kSets; ++set) views.push_back(studio.Views(set));
  Carver carver(CarvingOptions{static_cast<double>(state.range(1))});
  VoxelGrid grid;
  std::size_t set = 0;
  for (auto _ : state) carver.Carve(views[set++ % views.size()], grid);
}

BENCHMARK(CopyFrame)->Arg(480)->Arg(1080);
BENCHMARK(SegmentFrame)
    ->ArgNames({"height", "cameras"})
    ->Args({240, 6})
    ->Args({480, 6})
    ->Args({720, 6})
    ->Args({1080, 6})
    ->Args({480, 1})
    ->Unit(benchmark::kMicrosecond);
BENCHMARK(LearnBackground)->Arg(480)->Unit(benchmark::kMillisecond);
BENCHMARK(TraceFrame)->Arg(480)->Unit(benchmark::kMicrosecond);
BENCHMARK(CarveSet)
    ->ArgNames({"height", "mm", "cameras"})
    ->Args({480, 50, 6})
    ->Args({480, 25, 6})
    ->Args({480, 15, 6})
    ->Args({480, 10, 6})
    ->Args({480, 25, 2})
    ->Args({480, 25, 4})
    ->Args({480, 25, 8})
    ->Args({240, 25, 6})
    ->Args({720, 25, 6})
    ->Args({1080, 25, 6})
    ->Unit(benchmark::kMicrosecond);

template <typename Create>
void RegisterPeer(const char* name, const Create& create) {
  benchmark::RegisterBenchmark(
      name, [create](benchmark::State& state) { SegmentByOpenCv(state, create); })
      ->ArgNames({"height", "cameras"})
      ->Args({480, 6})
      ->Args({480, 1})
      ->Unit(benchmark::kMicrosecond);
}

const bool kPeers = [] {
  RegisterPeer("SegmentByMog2", [] { return cv::createBackgroundSubtractorMOG2(); });
  RegisterPeer("SegmentByKnn", [] { return cv::createBackgroundSubtractorKNN(); });
  return true;
}();

}  // namespace
}  // namespace mocap::bench
