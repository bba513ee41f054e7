#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/errors.h"
#include "core/reconstruction/silhouette/segmenter.h"
#include "tests/core/reconstruction/lenses.h"
#include "tests/core/reconstruction/silhouette/segmenter_studio.h"
#include "tests/core/reconstruction/synthetic_pictures.h"

namespace mocap {
namespace {

// A camera on a head in the middle of a large room with pictures on its walls.
class PanTiltSegmenterTest : public ::testing::Test {
 protected:
  PanTiltSegmenterTest() : sensor_(1.5f, 25), camera_(SmallCamera()) {
    camera_.X_CW.R << 1, 0, 0, 0, 0, -1, 0, 1, 0;
    camera_.X_CW.p = {0, 1500, 0};
    camera_.head = PanTiltHead{.pan_axis_W = Vector3::UnitZ(),
                               .pan_point_W = {0, -40, 1450},
                               .tilt_axis_W = Vector3::UnitX(),
                               .tilt_point_W = {0, -30, 1500}};
    for (const double tilt : {-0.1, 0.0, 0.1})
      for (int i = -3; i <= 3; ++i)
        background_.push_back({sensor_.Take(Look({0.1 * i, tilt})), {0.1 * i, tilt}});
  }

  // What the camera sees of walls 4 m away and the floor.
  ExactPicture Look(const PanTiltAngles& angles) const {
    const RigidTransform X_WC = camera_.PoseAt(angles).Inverse();
    ExactPicture picture(kSmallWidth, kSmallHeight);
    for (int y = 0; y < kSmallHeight; ++y) {
      for (int x = 0; x < kSmallWidth; ++x) {
        const Vector3 ray =
            X_WC.R * NormalizedFromPixel(camera_.lens, Vector2(x, y))->homogeneous();
        double reach = (4000 - X_WC.p.y()) / ray.y();
        if (ray.z() < 0) reach = std::min(reach, -X_WC.p.z() / ray.z());
        const Vector3 p = X_WC.p + reach * ray;
        const double u = p.x() / 300, v = (p.z() + p.y()) / 260;
        const double pattern = std::sin(u) * std::cos(v) + 0.3 * std::sin(3 * u + 2 * v);
        const auto grey = static_cast<float>(110 + 30 * pattern);
        picture(x, y) = {0.9f * grey, grey, static_cast<float>(grey + 10 * std::sin(v))};
      }
    }
    return picture;
  }

  NoisySensor sensor_;
  CameraCalibration camera_;
  std::vector<BackgroundFrame> background_;
};

TEST_F(PanTiltSegmenterTest, TheEmptyStudioHasNoSilhouetteBetweenTheLearnedDirections) {
  Segmenter segmenter(camera_, background_, {});
  for (const PanTiltAngles& angles :
       {PanTiltAngles{0.05, 0.05}, {-0.13, -0.02}, {0.24, 0.07}, {0, 0}}) {
    Trimap trimap;
    segmenter.Segment(sensor_.Take(Look(angles)).view(), angles, trimap);
    EXPECT_EQ(CountSet(trimap.person), 0) << angles.pan_rad;
  }
}

TEST_F(PanTiltSegmenterTest, NoiseThatACodecRemovedFromTheEmptyStudioHasNoSilhouette) {
  NoisySensor coded(kNoNoise, 29);
  for (BackgroundFrame& frame : background_) frame.image = coded.Take(Look(frame.angles));
  Segmenter segmenter(camera_, background_, {});
  for (const PanTiltAngles& angles : {PanTiltAngles{0, 0}, {0.2, 0.1}}) {
    Trimap trimap;
    segmenter.Segment(sensor_.Take(Look(angles)).view(), angles, trimap);
    EXPECT_EQ(CountSet(trimap.person), 0) << angles.pan_rad;
  }
}

TEST_F(PanTiltSegmenterTest, APersonIsFoundInAnyDirection) {
  Segmenter segmenter(camera_, background_, {});
  for (const PanTiltAngles& angles : {PanTiltAngles{0.05, 0.05}, {-0.17, -0.06}}) {
    ExactPicture picture = Look(angles);
    Paint(picture, {80, 40, 109, 120}, {40, 40, 160});
    Trimap trimap;
    segmenter.Segment(sensor_.Take(picture).view(), angles, trimap);
    EXPECT_NEAR(CountSet(trimap.person), 30 * 81, 60);
    EXPECT_NEAR(CountSet(trimap.person, {80, 40, 109, 120}), 30 * 81, 60);
  }
}

TEST_F(PanTiltSegmenterTest, WhatWentBeforeDoesNotMatter) {
  std::vector<BackgroundFrame> pictures;
  for (const PanTiltAngles& angles :
       {PanTiltAngles{0.05, 0.05}, {-0.17, -0.06}, {0.24, 0.07}, {0.05, 0.05}}) {
    ExactPicture picture = Look(angles);
    const int left = pictures.size() == 3 ? 20 : 80;
    Paint(picture, {left, 40, left + 29, 120}, {40, 40, 160});
    pictures.push_back({sensor_.Take(picture), angles});
  }
  ExpectSameAsFresh(camera_, background_, pictures);
}

TEST_F(PanTiltSegmenterTest, WhatIsExpectedDoesNotDependOnWhereItIsLookedAtClosely) {
  const auto background = LearnPanTiltBackground(camera_, background_, 0.999);
  const PanTiltAngles angles{0.17, -0.04};
  RegionOfInterest everything, part;
  everything.SetAll(kSmallWidth, kSmallHeight);
  background->CoarsePass(angles, {});
  const ExpectedPicture whole = background->Expect(everything, {});
  Silhouette suspicious((kSmallWidth + 7) / 8, (kSmallHeight + 7) / 8);
  suspicious.Set(3, 0);
  suspicious.Set(12, 9);
  suspicious.Set(24, 18);
  part.Set(suspicious, kSmallWidth, kSmallHeight);
  background->CoarsePass({0.1, 0}, {});
  background->Expect(everything, {});
  background->CoarsePass(angles, {});
  const ExpectedPicture& partly = background->Expect(part, {});
  for (int y = 0; y < kSmallHeight; ++y) {
    part.ForEachMeasured(y, [&](const PixelRun& run) {
      for (int x = run.begin; x < run.end; ++x) {
        const auto i = static_cast<std::size_t>(y * kSmallWidth + x);
        ASSERT_EQ(partly.mean[1][i], whole.mean[1][i]) << x << " " << y;
        ASSERT_EQ(partly.InverseSigmaAt(x, y, 1), whole.InverseSigmaAt(x, y, 1)) << x << " " << y;
      }
    });
  }
}

TEST_F(PanTiltSegmenterTest, WhatWasNeverLearnedIsNotTakenForAPerson) {
  Segmenter segmenter(camera_, background_, {});
  const PanTiltAngles angles{0.55, 0};  // Half of it was never shown.
  Trimap trimap;
  segmenter.Segment(sensor_.Take(Look(angles)).view(), angles, trimap);
  EXPECT_EQ(CountSet(trimap.person), 0);
}

}  // namespace
}  // namespace mocap
