// What happens on a frame's way, counted.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <deque>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "daemon/pipeline/camera_worker.h"
#include "daemon/pipeline/carve_stage.h"
#include "drivers/simulation/simulated_studio.h"
#include "tests/support/allocation_counter.h"
#include "tests/support/heap_bytes.h"

namespace mocap {
namespace {

constexpr int kCameras = 3;
constexpr int kFrames = 4;
constexpr std::int64_t kPeriodNs = 40'000'000;

// Shows the same few pictures again and again.
class LoopingDriver : public CameraDriver {
 public:
  explicit LoopingDriver(std::vector<Image<Bgr>> pictures) : pictures_(std::move(pictures)) {}
  void Start() override {}
  GrabStatus Grab(Frame& frame, std::chrono::milliseconds) override {
    frame.image = std::as_const(pictures_[next_ % kFrames]).view();
    frame.capture_ns = (next_ + 1) * kPeriodNs;
    frame.sequence = static_cast<std::uint64_t>(next_++);
    frame.angles = {};
    return GrabStatus::kFrame;
  }
  void Stop() override {}

 private:
  std::vector<Image<Bgr>> pictures_;
  std::int64_t next_ = 0;
};

class FramePathTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!kCountsAllocations) GTEST_SKIP() << "the sanitizer allocates by itself";
  }

  FramePathTest() {
    SimulatedStudioOptions options = RecordedSimulation();
    options.cameras = kCameras;
    options.width_px = 240;
    options.height_px = 180;
    options.seconds = kFrames / options.fps;
    const SimulatedStudio studio(options);
    for (int c = 0; c < kCameras; ++c) {
      std::vector<Image<Bgr>> pictures;
      const std::unique_ptr<SimulatedCamera> camera = studio.OpenCamera(c);
      camera->Start();
      for (Frame frame; static_cast<int>(pictures.size()) < kFrames;) {
        if (camera->Grab(frame, std::chrono::milliseconds(1000)) != GrabStatus::kFrame) break;
        pictures.emplace_back(frame.image.width(), frame.image.height());
        for (int y = 0; y < frame.image.height(); ++y)
          std::copy_n(frame.image.row(y), frame.image.width(), pictures.back().row(y));
      }
      while (static_cast<int>(pictures.size()) < kFrames) pictures.push_back(pictures.back());
      StudioCamera line;
      line.calibration = studio.cameras()[c];
      line.driver = std::make_unique<LoopingDriver>(std::move(pictures));
      workers_.emplace_back(std::move(line),
                            Segmenter(studio.cameras()[c], studio.Background(c), {}), recorders_);
      workers_.back().Start();
    }
    carve_ = std::make_unique<CarveStage>(
        studio.cameras(), Synchronizer(kCameras, kPeriodNs, Synchronizer::kWaitForever),
        CarvingOptions{.voxel_mm = 40}, kRaysPerPerson, recorders_);
  }

  // Brings one set on its way, perhaps without a camera; returns how many voxels there are.
  std::int64_t Pass(std::optional<int> absent = {}) {
    for (int c = 0; c < kCameras; ++c) {
      EXPECT_EQ(workers_[c].Next(carve_->wanted_from_ns(), frames_[c]),
                CameraWorker::Outcome::kFrame);
      if (c != absent) carve_->Offer(c, frames_[c]);
      carve_->synchronizer().Expect(c, c == absent ? Expectation::kNone : Expectation::kCertain);
    }
    EXPECT_EQ(carve_->Next(set_), Synchronizer::Decision::kSet);
    std::int64_t voxels = 0;
    for (const std::uint64_t word : set_.grid.words()) voxels += std::popcount(word);
    return voxels;
  }

  StageRecorders recorders_;
  std::deque<CameraWorker> workers_;
  std::unique_ptr<CarveStage> carve_;
  SegmentedFrame frames_[kCameras];
  CarvedSet set_;
};

TEST_F(FramePathTest, SegmentingTracingMatchingAndCarvingAllocateNothingOnceTheyRun) {
  // Memory goes round between two places a camera.
  std::int64_t voxels = 0;
  for (int i = 0; i < kFrames; ++i) Pass(1);  // Two cameras leave a larger hull.
  for (int i = 0; i < 3 * kFrames; ++i) voxels = Pass();
  EXPECT_GT(voxels, 200);
  const std::int64_t before = Allocations();
  EXPECT_GT(before, 0);
  for (int i = 0; i < 2 * kFrames; ++i) Pass();
  EXPECT_EQ(Allocations() - before, 0);
  Pass(1);
  EXPECT_TRUE(set_.outlines[1].empty());
  Pass();
  EXPECT_FALSE(set_.outlines[1].empty());
  EXPECT_EQ(Allocations() - before, 0) << "a camera that is back takes no memory anew";
}

TEST_F(FramePathTest, HundredsOfLostCamerasLeaveNothingBehind) {
  const auto lose_all_in_turn = [this] {
    for (int camera = 0; camera < kCameras; ++camera) {
      Pass(camera);
      Pass();
    }
  };
  for (int i = 0; i < kFrames; ++i) lose_all_in_turn();
  const std::int64_t before = HeapBytes();
  for (int i = 0; i < 100; ++i) lose_all_in_turn();
  EXPECT_EQ(HeapBytes() - before, 0);
}

TEST_F(FramePathTest, ARoomySetHoldsAPersonWithoutAllocating) {
  for (int i = 0; i < 3 * kFrames; ++i) Pass();
  set_ = RoomySet(kCameras, 40);
  const std::int64_t before = Allocations();
  EXPECT_GT(Pass(), 200);
  EXPECT_EQ(Allocations() - before, 0);
}

}  // namespace
}  // namespace mocap
