#include "daemon/pipeline/masked_camera.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <utility>

#include "config/open_studio.h"
#include "core/reconstruction/carving/floor_shadows.h"
#include "tests/daemon/fake_studio.h"

namespace mocap {
namespace {

using testing::kFakeHeight;
using testing::kFakeWidth;

constexpr int kLeft = 20, kRight = 40;

/// Delivers a bright block, with grey borders as by a codec, as often as it is asked.
class BlockMasks : public CameraDriver {
 public:
  BlockMasks() : mask_(kFakeWidth, kFakeHeight) {
    for (int y = 8; y < kFakeHeight; ++y) {
      for (int x = kLeft - 1; x <= kRight + 1; ++x) mask_(x, y) = {127, 127, 127};
      for (int x = kLeft; x <= kRight; ++x) mask_(x, y) = {240, 240, 240};
    }
  }
  void Start() override {}
  void Stop() override {}
  GrabStatus Grab(Frame& frame, std::chrono::milliseconds) override {
    if (sequence_ == 3) return GrabStatus::kEnd;
    if (sequence_ == 1) return ++sequence_, GrabStatus::kTorn;
    frame = {
        std::as_const(mask_).view(), 1000 + static_cast<std::int64_t>(sequence_), sequence_, {}};
    ++sequence_;
    return GrabStatus::kFrame;
  }

 private:
  Image<Bgr> mask_;
  std::uint64_t sequence_ = 0;
};

CameraCalibration MaskCamera() {
  return CalibrationsOf(testing::FakeStudio({testing::SteadyFrames(1)})).front();
}

TEST(MaskedCamera, WhitePixelsAreTheSilhouette) {
  MaskedCamera camera(MaskCamera(), std::make_unique<BlockMasks>(), kRaysPerPerson);
  camera.Start();
  const std::atomic<std::int64_t> wanted_from_ns{0};
  SegmentedFrame frame;
  ASSERT_EQ(camera.Next(wanted_from_ns, frame), SilhouetteSource::Outcome::kFrame);
  EXPECT_EQ(frame.trimap.person.BoundingBox(), (PixelBox{kLeft, 8, kRight, kFakeHeight - 1}));
  EXPECT_EQ(frame.capture_ns, 1000);
  EXPECT_FALSE(frame.outline.empty());
  EXPECT_EQ(camera.expectation(), Expectation::kCertain);
  EXPECT_EQ(camera.Next(wanted_from_ns, frame), SilhouetteSource::Outcome::kNothing);
  EXPECT_EQ(camera.Next(wanted_from_ns, frame), SilhouetteSource::Outcome::kFrame);
  EXPECT_EQ(frame.sequence, 2u);
  EXPECT_EQ(camera.Next(wanted_from_ns, frame), SilhouetteSource::Outcome::kEnd);
  EXPECT_EQ(camera.Status().torn, 1);
}

TEST(MaskedCamera, NothingIsAddedToAMaskAsIfItWereDark) {
  std::vector<CameraCalibration> cameras(3, MaskCamera());
  std::vector<SegmentedFrame> frames(cameras.size());
  std::vector<SensorPlaneTable> tables;
  std::vector<ShadedView> views;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    MaskedCamera camera(cameras[i], std::make_unique<BlockMasks>(), kRaysPerPerson);
    ASSERT_EQ(camera.Next({0}, frames[i]), SilhouetteSource::Outcome::kFrame);
    tables.emplace_back(cameras[i]);
  }
  const Silhouette before = frames[0].trimap.person;
  for (int i = 0; i < 3; ++i)
    views.push_back({i, &tables[i], cameras[i].X_CW, &frames[i].shading, &frames[i].trimap});
  FloorShadows(cameras).Complete(views);
  EXPECT_FALSE(views[0].has_changed);
  EXPECT_EQ(frames[0].trimap.person.words(), before.words());
  EXPECT_FALSE(frames[0].trimap.unknown.BoundingBox()) << "nobody is in doubt";
}

}  // namespace
}  // namespace mocap
