#include "daemon/pipeline/camera_lines.h"

#include <future>
#include <stdexcept>
#include <utility>

namespace mocap {
namespace {

/// Maximum number of a camera's frames between threads. Offline, every thread has enough work;
/// live, frames do not get old.
constexpr std::size_t kPatientFrames = 8, kLiveFrames = 4;
/// With several people, a small blob may be a person whom others hide; share of the picture.
constexpr double kLargestThingAmongPeople = 0.003;

/// The same pictures, but throws LearningStopped once `stop` is set.
BackgroundSource UntilStopped(const BackgroundSource& source, const std::atomic<bool>* stop) {
  if (!stop) return source;
  return BackgroundSource::OneByOne([&source, stop](const BackgroundSource::Visit& visit) {
    source.ForEach([&](const BackgroundFrame& frame) {
      if (stop->load(std::memory_order_relaxed)) throw LearningStopped();
      visit(frame);
    });
  });
}

}  // namespace

std::vector<Segmenter> LearnBackgrounds(const std::vector<StudioCamera>& cameras,
                                        const SegmentationOptions& options,
                                        const std::atomic<bool>* stop) {
  std::vector<std::future<Segmenter>> learning;
  for (const StudioCamera& camera : cameras) {
    if (!camera.driver) continue;
    learning.push_back(std::async(std::launch::async, [&camera, &options, stop] {
      return Segmenter(camera.calibration, UntilStopped(camera.background, stop)(), options);
    }));
  }
  std::vector<Segmenter> segmenters;
  for (auto& learned : learning) segmenters.push_back(learned.get());
  return segmenters;
}

SegmentationOptions SegmentationOf(const PipelineOptions& options) {
  SegmentationOptions segmentation = options.segmentation;
  if (options.people > 1) segmentation.largest_thing_share = kLargestThingAmongPeople;
  return segmentation;
}

CameraLine::CameraLine(std::unique_ptr<SilhouetteSource> of, Overflow overflow, Doorbell& bell)
    : source(std::move(of)),
      queue(overflow == Overflow::kWait ? kPatientFrames : kLiveFrames, overflow, bell) {}

CameraLines::CameraLines(std::vector<StudioCamera> cameras, const PipelineOptions& options,
                         int rays, StageRecorders& recorders, Doorbell& bell)
    : segmentation_(SegmentationOf(options)), bell_(bell) {
  std::vector<Segmenter> segmenters = LearnBackgrounds(cameras, segmentation_, options.stop);
  std::size_t learned = 0;
  for (StudioCamera& camera : cameras) {
    std::unique_ptr<SilhouetteSource> source;
    if (camera.driver) {
      const std::size_t i = learned++;
      std::vector<FrameTap*> taps;
      for (std::deque<FrameTap>* of_all : options.taps) taps.push_back(&of_all->at(i));
      PreviewTap* preview = options.previews ? &options.previews->at(i) : nullptr;
      auto worker = std::make_unique<CameraWorker>(std::move(camera), std::move(segmenters[i]),
                                                   recorders, std::move(taps), preview, rays);
      MOCAP_CHECK(workers_.size() == lines_.size());
      workers_.push_back(worker.get());
      source = std::move(worker);
    } else {
      source = options.elsewhere(camera.calibration, rays);
    }
    lines_.push_back(std::make_unique<CameraLine>(std::move(source), options.overflow, bell));
  }
}

void CameraLines::Launch(ThreadGroup& threads, const std::atomic<std::int64_t>& wanted_from_ns) {
  for (const auto& line : lines_) {
    threads.Launch(line->source->calibration().name, [&, line = line.get()] {
      threads.Guard([&] { Run(*line, threads, wanted_from_ns); });
      line->has_ended.store(true, std::memory_order_relaxed);
      line->queue.Close();
    });
  }
}

void CameraLines::Run(CameraLine& line, ThreadGroup& threads,
                      const std::atomic<std::int64_t>& wanted_from_ns) {
  line.source->Start();
  while (!threads.is_stopped()) {
    line.turns.fetch_add(1, std::memory_order_relaxed);
    const auto outcome = line.source->Next(wanted_from_ns, line.queue.back());
    if (outcome == SilhouetteSource::Outcome::kEnd) break;
    if (outcome == SilhouetteSource::Outcome::kFrame) {
      line.queue.Push();
    } else {
      // The consumer may have to continue without this camera.
      bell_.Ring();
    }
  }
  line.source->Stop();
}

void CameraLines::Close() {
  for (const auto& line : lines_) line->queue.Close();
}

void CameraLines::ReplaceBackground(int camera, std::span<const BackgroundFrame> background) {
  CameraWorker& worker = *workers_.at(static_cast<std::size_t>(camera));
  if (!worker.Replace(Segmenter(worker.calibration(), background, segmentation_))) {
    throw std::runtime_error(worker.calibration().name + " did not apply the learned background");
  }
}

CameraStatus CameraLines::Status(int camera) const {
  const CameraLine& line = (*this)[camera];
  CameraStatus status = line.source->Status();
  status.dropped += line.queue.dropped();
  return status;
}

std::vector<FrameProgress::Thread> CameraLines::Progress() const {
  std::vector<FrameProgress::Thread> progress;
  for (const auto& line : lines_) {
    progress.push_back({line->turns.load(std::memory_order_relaxed),
                        line->has_ended.load(std::memory_order_relaxed)});
  }
  return progress;
}

}  // namespace mocap
