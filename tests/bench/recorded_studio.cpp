#include "tests/bench/recorded_studio.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <memory>
#include <thread>
#include <tuple>

#include "drivers/simulation/simulated_studio.h"

namespace mocap::bench {
namespace {

// Hands out frames of a recording, there and back again.
class MemoryDriver : public CameraDriver {
 public:
  MemoryDriver(const RecordedStudio& studio, int camera, int sets, RecordedStudio::Pace pace)
      : studio_(studio), camera_(camera), sets_(sets), pace_(pace) {}

  void Start() override { start_ = std::chrono::steady_clock::now(); }
  GrabStatus Grab(Frame& frame, std::chrono::milliseconds) override {
    if (next_ == sets_) return GrabStatus::kEnd;
    if (pace_ == RecordedStudio::Pace::kLive) {
      std::this_thread::sleep_until(
          start_ + std::chrono::nanoseconds(std::llround(1e9 * next_ / RecordedStudio::kFps)));
    }
    frame.image = studio_.frame(camera_, RecordedStudio::SetAt(next_));
    frame.capture_ns = std::llround(1e9 * next_ / RecordedStudio::kFps);
    frame.sequence = static_cast<std::uint64_t>(next_++);
    frame.angles = {};
    return GrabStatus::kFrame;
  }
  void Stop() override {}

 private:
  const RecordedStudio& studio_;
  int camera_, sets_;
  RecordedStudio::Pace pace_;
  std::chrono::steady_clock::time_point start_;
  int next_ = 0;
};

Image<Bgr> CopyOf(ImageView<const Bgr> view) {
  Image<Bgr> image(view.width(), view.height());
  for (int y = 0; y < view.height(); ++y) std::copy_n(view.row(y), view.width(), image.row(y));
  return image;
}

}  // namespace

const RecordedStudio& RecordedStudio::Get(const StudioSize& size) {
  static std::map<std::tuple<int, int, int>, std::unique_ptr<RecordedStudio>> studios;
  auto& studio = studios[{size.cameras, size.width_px, size.height_px}];
  if (!studio) studio.reset(new RecordedStudio(size));
  return *studio;
}

RecordedStudio::RecordedStudio(const StudioSize& size) : size_(size) {
  SimulatedStudioOptions options = RecordedSimulation();
  options.cameras = size.cameras;
  options.width_px = size.width_px;
  options.height_px = size.height_px;
  options.fps = kFps;
  options.seconds = kSets / kFps;
  const SimulatedStudio simulated(options);
  cameras_ = simulated.cameras();
  for (int c = 0; c < size.cameras; ++c) {
    tables_.emplace_back(cameras_[c]);
    background_.push_back(simulated.Background(c));
    Segmenter segmenter(cameras_[c], background_[c], {});
    const std::unique_ptr<SimulatedCamera> camera = simulated.OpenCamera(c);
    camera->Start();
    auto& frames = frames_.emplace_back();
    auto& trimaps = trimaps_.emplace_back();
    for (Frame frame; static_cast<int>(frames.size()) < kSets;) {
      const GrabStatus status = camera->Grab(frame, std::chrono::milliseconds(1000));
      if (status == GrabStatus::kEnd) break;
      if (status != GrabStatus::kFrame) continue;
      frames.push_back(CopyOf(frame.image));
      segmenter.Segment(frames.back().view(), {}, trimaps.emplace_back());
    }
    // A camera may have missed the last.
    while (static_cast<int>(frames.size()) < kSets) {
      frames.push_back(frames.back());
      trimaps.push_back(trimaps.back());
    }
  }
}

std::vector<CarvingView> RecordedStudio::Views(int set) const {
  std::vector<CarvingView> views;
  for (int c = 0; c < size_.cameras; ++c)
    views.push_back(
        {&tables_[c], &trimaps_[c][set].person, cameras_[c].X_CW, &trimaps_[c][set].unknown});
  return views;
}

Studio RecordedStudio::Open(int sets, Pace pace) const {
  Studio studio;
  studio.name = "frames in memory";
  studio.fps_nominal = kFps;
  for (int c = 0; c < size_.cameras; ++c) {
    StudioCamera& camera = studio.cameras.emplace_back();
    camera.calibration = cameras_[c];
    camera.driver = std::make_unique<MemoryDriver>(*this, c, sets, pace);
    camera.background = [this, c] { return background_[c]; };
  }
  return studio;
}

}  // namespace mocap::bench
