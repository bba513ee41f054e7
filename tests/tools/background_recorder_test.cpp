#include "tools/background_recorder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "config/camera_files.h"
#include "core/errors.h"
#include "core/reconstruction/background/change_meter.h"
#include "drivers/pan_tilt_camera.h"
#include "tests/support/small_take.h"
#include "tests/support/temporary_folder.h"

namespace mocap {
namespace {

constexpr double kRecordedSeconds = 2;

/// A camera that needs no time for its frames.
class StillCamera : public CameraDriver {
 public:
  explicit StillCamera(const testing::SmallTake& take)
      : picture_(testing::SmallPicture(take, 0, 0)) {}

  void Start() override {}
  GrabStatus Grab(Frame& frame, std::chrono::milliseconds) override {
    if (frames_ == somebody_comes_at) {
      for (int y = 0; y < 20; ++y) std::fill_n(picture_.row(y), 20, Bgr{});
    }
    frame.image = std::as_const(picture_).view();
    frame.capture_ns = 40'000'000 * ++frames_;
    return GrabStatus::kFrame;
  }
  void Stop() override {}

  std::int64_t somebody_comes_at = -1;

 private:
  Image<Bgr> picture_;
  std::int64_t frames_ = 0;
};

/// A head that is at once where it shall be.
class QuickHead : public PanTilt {
 public:
  void Start() override {}
  void Stop() override {}
  void Update() override {}
  PanTiltAngles At(std::int64_t) const override { return angles_; }
  bool TurnTo(const PanTiltAngles& angles) override {
    angles_ = angles;
    return true;
  }
  PanTiltLimits limits() const override { return {{-1, -0.5}, {1, 0.5}}; }

 private:
  PanTiltAngles angles_;
};

class BackgroundRecorder : public ::testing::Test {
 protected:
  LiveCamera Camera(std::unique_ptr<CameraDriver> driver) {
    LiveCamera camera;
    camera.name = "cam1";
    camera.calibration = testing::SmallCamera(take_, 0);
    camera.driver = std::move(driver);
    return camera;
  }

  LiveCamera CameraOnHead() {
    take_.heads = true;
    auto mounted = std::make_unique<PanTiltCamera>(std::make_unique<StillCamera>(take_),
                                                   std::make_unique<QuickHead>());
    PanTilt* head = &mounted->head();
    LiveCamera camera = Camera(std::move(mounted));
    camera.head = head;
    camera.range = {{-0.2, -0.1}, {0.4, 9}};
    return camera;
  }

  std::vector<BackgroundFrame> Read() {
    const std::string base = (folder_.path() / "cam1").string();
    return OpenCameraBackground(base + ".mkv", base + ".csv", testing::SmallCamera(take_, 0))();
  }

  testing::SmallTake take_;
  testing::TemporaryFolder folder_;
};

TEST_F(BackgroundRecorder, LeavesWhatAStudioOpensAsBackground) {
  LiveCamera camera = Camera(std::make_unique<StillCamera>(take_));
  const BackgroundRecord record = RecordBackground(camera, folder_.path(), kRecordedSeconds);
  EXPECT_EQ(record.frames, 50);
  EXPECT_EQ(record.changed, 0);
  const std::vector<BackgroundFrame> frames = Read();
  ASSERT_EQ(frames.size(), 50u);
  EXPECT_EQ(frames[7].image.pixels(), testing::SmallPicture(take_, 0, 0).pixels());
}

TEST_F(BackgroundRecorder, NoticesSomebodyWhoComesIn) {
  auto driver = std::make_unique<StillCamera>(take_);
  driver->somebody_comes_at = 45;
  LiveCamera camera = Camera(std::move(driver));
  EXPECT_GT(RecordBackground(camera, folder_.path(), kRecordedSeconds).changed, kMostChange);
}

TEST_F(BackgroundRecorder, AnOccupiedStudioIsRecordedAtTwoPicturesASecond) {
  LiveCamera camera = Camera(std::make_unique<StillCamera>(take_));
  RecordOccupied(camera, folder_.path(), 20);
  EXPECT_EQ(Read().size(), 40u);
}

TEST_F(BackgroundRecorder, HeadLooksInAllDirectionsThatTheStudioAllows) {
  LiveCamera camera = CameraOnHead();
  const BackgroundRecord record = RecordBackground(camera, folder_.path(), kRecordedSeconds);
  const std::vector<PanTiltAngles> directions = SweepDirections(camera);
  EXPECT_EQ(record.frames, 2 * static_cast<int>(directions.size()));
  const std::vector<BackgroundFrame> frames = Read();
  ASSERT_EQ(frames.size(), 2 * directions.size());
  double least_pan = 9, most_pan = -9, most_tilt = -9;
  for (const BackgroundFrame& frame : frames) {
    least_pan = std::min(least_pan, frame.angles.pan_rad);
    most_pan = std::max(most_pan, frame.angles.pan_rad);
    most_tilt = std::max(most_tilt, frame.angles.tilt_rad);
  }
  constexpr double kRounding = 1e-12;
  EXPECT_NEAR(least_pan, -0.2, kRounding);
  EXPECT_NEAR(most_pan, 0.4, kRounding);
  EXPECT_NEAR(most_tilt, 0.5, kRounding);
}

TEST_F(BackgroundRecorder, NeighboursOfASweepOverlapByMoreThanHalf) {
  LiveCamera camera = CameraOnHead();
  // 68 pixels of 0.01 mm behind 5.4 mm.
  const double field_rad = 2 * std::atan(0.34 / 5.4);
  const std::vector<PanTiltAngles> directions = SweepDirections(camera);
  for (std::size_t i = 1; i < directions.size(); ++i) {
    EXPECT_LT(std::abs(directions[i].pan_rad - directions[i - 1].pan_rad), field_rad / 2);
    EXPECT_LT(std::abs(directions[i].tilt_rad - directions[i - 1].tilt_rad), field_rad / 2);
  }
}

TEST_F(BackgroundRecorder, SweepThatWouldTakeHoursIsRefused) {
  LiveCamera camera = CameraOnHead();
  camera.range = {{-9, -9}, {9, 9}};
  camera.calibration->lens = OpenCvLens{Vector3(3000, 3000, 1).asDiagonal(), {}};
  EXPECT_THROW(SweepDirections(camera), SetupError);
}

}  // namespace
}  // namespace mocap
