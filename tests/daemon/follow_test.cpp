// Heads that follow, with the whole daemon's pipeline behind them.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "config/load_config.h"
#include "daemon/pipeline/pipeline.h"
#include "drivers/simulation/simulated_studio.h"
#include "drivers/virtual_studio/truth.h"

namespace mocap {
namespace {

/// Whether a camera sees all of the person's joints.
bool ShowsAll(const CameraCalibration& camera, const PanTiltAngles& angles,
              const JointPositions& joints_W) {
  const RigidTransform X_CW = camera.PoseAt(angles);
  return std::ranges::all_of(joints_W, [&](const Vector3& p_WQ) {
    const Vector3 p_CQ = X_CW * p_WQ;
    if (p_CQ.z() <= 0) return false;
    const auto pixel = PixelFromNormalized(camera.lens, p_CQ.head<2>() / p_CQ.z());
    return pixel && pixel->x() >= 0 && pixel->y() >= 0 && pixel->x() <= camera.width_px - 1 &&
           pixel->y() <= camera.height_px - 1;
  });
}

/// In how many frames of a camera all of the person is to be seen.
struct InView {
  int frames = 0, whole = 0;
  int whole_without_turning = 0;  ///< Had the head stayed where it was.
};

/// Holds a camera's frames against the truth.
class Witness : public CameraDriver {
 public:
  Witness(std::unique_ptr<CameraDriver> camera, CameraCalibration calibration,
          const SimulatedTruth& truth, InView& seen)
      : camera_(std::move(camera)),
        calibration_(std::move(calibration)),
        truth_(truth),
        seen_(seen) {}

  void Start() override { camera_->Start(); }
  GrabStatus Grab(Frame& frame, std::chrono::milliseconds timeout) override {
    const GrabStatus status = camera_->Grab(frame, timeout);
    if (status != GrabStatus::kFrame) return status;
    const JointPositions joints_W = truth_.At(frame.capture_ns);
    ++seen_.frames;
    seen_.whole += ShowsAll(calibration_, frame.angles, joints_W);
    seen_.whole_without_turning += ShowsAll(calibration_, {}, joints_W);
    return status;
  }
  void Stop() override { camera_->Stop(); }

 private:
  std::unique_ptr<CameraDriver> camera_;
  CameraCalibration calibration_;
  const SimulatedTruth& truth_;
  InView& seen_;
};

class CountingSink : public PoseSink {
 public:
  void OnSet(const TrackedSet& set) override {
    tracked += set.result.state == CaptureState::kTracking;
  }
  int tracked = 0;
};

constexpr int kFollowedFrames = 64;

/// Somebody walks at 1 m/s.
SimulatedStudioOptions Walk() {
  SimulatedStudioOptions options = RecordedSimulation();
  options.width_px = 320;
  options.height_px = 240;
  options.fps = 10;
  options.seconds = kFollowedFrames / options.fps;
  options.pan_tilt = options.follow = true;
  return options;
}

double WalkedMm(const SimulatedTruth& truth) {
  double length_mm = 0;
  const auto torso = [&truth](int frame) {
    return truth.At(Walk().start_ns + frame * 100'000'000LL)[0].head<2>().eval();
  };
  for (int i = 1; i < kFollowedFrames; ++i) length_mm += (torso(i) - torso(i - 1)).norm();
  return length_mm;
}

TEST(FollowingHeads, KeepAPersonWhoWalksSixMetersInViewOfAllCameras) {
  const SimulatedTruth truth(Walk());
  ASSERT_GT(WalkedMm(truth), 6000);
  Studio studio = OpenSimulatedStudio(Walk());
  std::vector<InView> seen(studio.cameras.size());
  for (std::size_t i = 0; i < seen.size(); ++i) {
    StudioCamera& camera = studio.cameras[i];
    camera.driver =
        std::make_unique<Witness>(std::move(camera.driver), camera.calibration, truth, seen[i]);
  }
  CountingSink sink;
  Pipeline pipeline(std::move(studio),
                    {.overflow = Overflow::kWait, .latency_origin = LatencyOrigin::kArrival},
                    LoadBodyTable("full"), sink);
  pipeline.RunSerially();
  EXPECT_GT(sink.tracked, kFollowedFrames * 9 / 10);
  int whole_without_turning = 0;
  for (const InView& camera : seen) {
    EXPECT_EQ(camera.frames, kFollowedFrames);
    EXPECT_GE(camera.whole, kFollowedFrames * 95 / 100);
    whole_without_turning += camera.whole_without_turning;
  }
  EXPECT_LT(whole_without_turning, kFollowedFrames * 6 * 85 / 100);
}

}  // namespace
}  // namespace mocap
