#include "core/reconstruction/silhouette/segmenter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/errors.h"
#include "tests/core/reconstruction/lenses.h"
#include "tests/core/reconstruction/synthetic_pictures.h"

namespace mocap {
namespace {

constexpr int kWidth = 200;
constexpr int kHeight = 150;

CameraCalibration SmallCamera() {
  CameraCalibration camera;
  camera.name = "cam3";
  camera.width_px = kWidth;
  camera.height_px = kHeight;
  camera.lens = OpenCvLens{PinholeMatrix(200, 200, 100, 75), {}};
  return camera;
}

// Paints by the share of each pixel that a shape covers, as a lens does.
template <typename Contains>
double PaintSmoothly(ExactPicture& picture, const std::array<float, 3>& color, Contains contains) {
  double area = 0;
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      int inside = 0;
      for (int k = 0; k < 64; ++k) inside += contains(x + (k % 8 - 3.5) / 8, y + (k / 8 - 3.5) / 8);
      const auto share = static_cast<float>(inside / 64.0);
      area += share;
      for (int c = 0; c < 3; ++c) picture(x, y)[c] += share * (color[c] - picture(x, y)[c]);
    }
  }
  return area;
}

class SegmenterTest : public ::testing::Test {
 protected:
  SegmenterTest()
      : sensor_(2.0f, 21),
        studio_(EmptyStudio(kWidth, kHeight)),
        segmenter_(SmallCamera(), TakeBackground(studio_, 30, sensor_), {}) {}

  Trimap Classify(const ExactPicture& picture, float brightness = 1) {
    Trimap trimap;
    segmenter_.Segment(sensor_.Take(picture, brightness).view(), {}, trimap);
    return trimap;
  }
  Silhouette Segment(const ExactPicture& picture, float brightness = 1) {
    return Classify(picture, brightness).person;
  }

  NoisySensor sensor_;
  ExactPicture studio_;
  Segmenter segmenter_;
};

TEST_F(SegmenterTest, TheEmptyStudioHasNoSilhouette) {
  for (int i = 0; i < 5; ++i) EXPECT_EQ(CountSet(Segment(studio_)), 0);
}

TEST_F(SegmenterTest, FlickeringLightHasNoSilhouette) {
  for (const float brightness : {0.93f, 0.98f, 1.03f})
    EXPECT_EQ(CountSet(Segment(studio_, brightness)), 0);
}

TEST_F(SegmenterTest, ACastShadowIsLeftOut) {
  ExactPicture picture = studio_;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      Dim(picture, {x, y, x, y},
          1 - 0.25f / (1 + std::exp((std::hypot((x - 120) / 2.0f, y - 120.0f) - 18) / 3)));
  PaintSmoothly(picture, {40, 50, 110},
                [](double x, double y) { return std::hypot((x - 80) / 0.4, y - 70) < 50; });
  const Silhouette silhouette = Segment(picture);
  EXPECT_GT(CountSet(silhouette), 2800);
  EXPECT_EQ(CountSet(silhouette, {106, 0, kWidth - 1, kHeight - 1}), 0);
}

TEST_F(SegmenterTest, TheOutlineLiesWhereThePersonCoversHalfAPixel) {
  for (const std::array<float, 3>& color :
       {std::array<float, 3>{40, 50, 110}, std::array<float, 3>{210, 190, 200}}) {
    ExactPicture picture = studio_;
    const double area = PaintSmoothly(
        picture, color, [](double x, double y) { return std::hypot(x - 100.3, y - 60.7) < 30; });
    EXPECT_NEAR(CountSet(Segment(picture)), area, 0.03 * area);
  }
}

TEST_F(SegmenterTest, AThinArmStays) {
  ExactPicture picture = studio_;
  const double trunk = PaintSmoothly(picture, {60, 40, 50}, [](double x, double y) {
    return std::abs(x - 60) < 15 && std::abs(y - 80) < 40;
  });
  const double arm = PaintSmoothly(picture, {100, 130, 190}, [](double x, double y) {
    return x > 75 && x < 150 && std::abs(y - 70 + (x - 75) * 0.3) < 1.5;
  });
  const Silhouette silhouette = Segment(picture);
  EXPECT_NEAR(CountSet(silhouette), trunk + arm, 0.06 * (trunk + arm));
  for (int x = 80; x < 145; ++x)
    EXPECT_TRUE(silhouette.Test(x, static_cast<int>(std::lround(70 - (x - 75) * 0.3)))) << x;
}

TEST_F(SegmenterTest, GreyTrousersInFrontOfAGreyWallHaveNoHoles) {
  ExactPicture picture = studio_;
  // Skirts a shadow's brightness from dark to as light as the wall.
  std::mt19937 random(22);
  std::normal_distribution<float> grain(1, 0.07f);
  for (int y = 20; y < 100; ++y) {
    for (int x = 80; x < 120; ++x) {
      const float grey = (78 + 40 * (static_cast<float>(x - 80) / 40)) * grain(random);
      picture(x, y) = {0.9f * grey, grey, 1.06f * grey};
    }
  }
  EXPECT_GT(CountSet(Segment(picture), {80, 20, 119, 99}), 0.97 * 40 * 80);
}

TEST_F(SegmenterTest, AGapBetweenArmAndTrunkStaysOpen) {
  ExactPicture picture = studio_;
  Paint(picture, {60, 20, 99, 99}, {50, 45, 120});
  for (int y = 40; y < 80; ++y)
    for (int x = 86; x < 94; ++x) picture(x, y) = studio_(x, y);
  EXPECT_LT(CountSet(Segment(picture), {86, 40, 93, 79}), 20);
}

TEST_F(SegmenterTest, WhatThePersonEnclosesAndWhatMayBeAShadowIsUnknown) {
  ExactPicture picture = studio_;
  Paint(picture, {60, 20, 99, 99}, {50, 45, 120});
  const PixelBox like_the_wall{72, 40, 87, 69}, shadow{110, 60, 139, 99};
  for (int y = like_the_wall.top; y <= like_the_wall.bottom; ++y)
    for (int x = like_the_wall.left; x <= like_the_wall.right; ++x) picture(x, y) = studio_(x, y);
  Dim(picture, shadow, 0.85f);
  const Trimap trimap = Classify(picture);
  EXPECT_LT(CountSet(trimap.person, like_the_wall), 60);
  EXPECT_GT(CountSet(trimap.unknown, like_the_wall), 0.85 * 16 * 30);
  EXPECT_EQ(CountSet(trimap.person, shadow), 0);
  EXPECT_GT(CountSet(trimap.unknown, shadow), 0.8 * 30 * 40);
  EXPECT_EQ(CountSet(trimap.unknown, {150, 0, kWidth - 1, kHeight - 1}), 0);
}

TEST_F(SegmenterTest, SpecksAreDropped) {
  ExactPicture picture = studio_;
  Paint(picture, {30, 30, 32, 32}, {200, 20, 20});
  Paint(picture, {100, 50, 120, 90}, {200, 20, 20});
  const Silhouette silhouette = Segment(picture);
  EXPECT_EQ(CountSet(silhouette, {20, 20, 50, 50}), 0);
  EXPECT_NEAR(CountSet(silhouette), 21 * 41, 30);
}

TEST_F(SegmenterTest, APersonAtTheEdgeIsKeptUpToTheEdge) {
  ExactPicture picture = studio_;
  Paint(picture, {0, 60, 30, kHeight - 1}, {40, 50, 110});
  const Silhouette silhouette = Segment(picture);
  EXPECT_NEAR(CountSet(silhouette), 31 * 90, 40);
  EXPECT_TRUE(silhouette.Test(0, kHeight - 1));
}

TEST_F(SegmenterTest, SomebodyWhoWalksInIsSeenFromTheFirstPixelsOn) {
  for (const int right : {7, 15, 31}) {
    ExactPicture picture = studio_;
    Paint(picture, {0, 50, right, 109}, {60, 45, 50});
    EXPECT_NEAR(CountSet(Segment(picture)), 60 * (right + 1), 40 + 2 * right) << right;
  }
}

TEST_F(SegmenterTest, ADriftOfTheWallsHasNoSilhouette) {
  ExactPicture picture = studio_;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const auto drift = static_cast<float>(
          0.8 * (std::sin(x / 15.0) + std::cos(y / 20.0) + std::sin((x + y) / 27.0)));
      picture(x, y)[0] += drift;
      picture(x, y)[1] -= 0.5f * drift;
    }
  }
  EXPECT_EQ(CountSet(Segment(picture)), 0);
  Paint(picture, {80, 40, 109, 119}, {40, 50, 110});
  EXPECT_NEAR(CountSet(Segment(picture)), 30 * 80, 150);
}

// A codec removes the noise of an empty studio that does not move.
constexpr float kNoNoise = 0.01f;

TEST(Segmenter, NoiseThatACodecRemovedFromTheEmptyStudioHasNoSilhouette) {
  const ExactPicture studio = EmptyStudio(kWidth, kHeight);
  NoisySensor coded(kNoNoise, 26), sensor(1.5f, 27);
  Segmenter segmenter(SmallCamera(), TakeBackground(studio, 30, coded), {});
  Trimap trimap;
  for (int i = 0; i < 5; ++i) {
    segmenter.Segment(sensor.Take(studio).view(), {}, trimap);
    EXPECT_EQ(CountSet(trimap.person), 0);
  }
}

TEST(Segmenter, TheHaloOfACodecBesideAPersonIsLeftOut) {
  const ExactPicture studio = EmptyStudio(kWidth, kHeight);
  NoisySensor coded(kNoNoise, 28);
  Segmenter segmenter(SmallCamera(), TakeBackground(studio, 30, coded), {});
  ExactPicture picture = studio;
  for (int y = 32; y < 128; ++y)
    for (int x = 64; x < 128; ++x) picture(x, y)[2] += 0.5f;
  Paint(picture, {80, 48, 111, 111}, {40, 50, 110});
  Trimap trimap;
  segmenter.Segment(coded.Take(picture).view(), {}, trimap);
  EXPECT_NEAR(CountSet(trimap.person), 32 * 64, 40);
}

// Segments pictures in turn, and each by a segmenter that has seen nothing else.
void ExpectSameAsFresh(const CameraCalibration& camera,
                       const std::vector<BackgroundFrame>& background,
                       const std::vector<BackgroundFrame>& pictures) {
  Segmenter seasoned(camera, background, {});
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    SCOPED_TRACE(i);
    Segmenter fresh(camera, background, {});
    Trimap expected, trimap;
    fresh.Segment(pictures[i].image.view(), pictures[i].angles, expected);
    seasoned.Segment(pictures[i].image.view(), pictures[i].angles, trimap);
    EXPECT_EQ(trimap.person.words(), expected.person.words());
    EXPECT_EQ(trimap.unknown.words(), expected.unknown.words());
    EXPECT_EQ(seasoned.shading().dark.words(), fresh.shading().dark.words());
    EXPECT_EQ(seasoned.shading().dark_tiles, fresh.shading().dark_tiles);
    EXPECT_EQ(seasoned.shading().shades, fresh.shading().shades);
    EXPECT_EQ(seasoned.conditions().gain, fresh.conditions().gain);
    EXPECT_EQ(seasoned.conditions().drift, fresh.conditions().drift);
    EXPECT_EQ(seasoned.conditions().shift_px, fresh.conditions().shift_px);
    EXPECT_EQ(seasoned.conditions().displacement, fresh.conditions().displacement);
  }
}

TEST_F(SegmenterTest, WhatWentBeforeDoesNotMatter) {
  std::vector<BackgroundFrame> pictures;
  const auto take = [&](const ExactPicture& picture, float light) {
    pictures.push_back({sensor_.Take(picture, light), {}});
  };
  // Somebody walks, leaps and leaves; something small lies apart; light and walls change.
  for (const int left : {-1, 20, 26, 120, 128, -1, 60}) {
    ExactPicture picture = studio_;
    if (left >= 0) Paint(picture, {left, 40, left + 29, 119}, {70, 80, 110});
    Dim(picture, {140, 100, 189, 139}, 0.85f);
    if (left == 120) Paint(picture, {10, 10, 21, 21}, {40, 50, 110});
    take(picture, left == 26 ? 0.95f : 1);
    if (left != 20) continue;
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x)
        picture(x, y)[2] += static_cast<float>(8 * std::sin(x / 11.0));
    take(picture, 1);
    // A nudge.
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x + 1 < kWidth; ++x) picture(x, y) = picture(x + 1, y);
    take(picture, 1);
  }
  NoisySensor sensor(2.0f, 21);
  ExpectSameAsFresh(SmallCamera(), TakeBackground(studio_, 30, sensor), pictures);
}

TEST_F(SegmenterTest, AThingThatWasMovedIsLeftOutBesideAPerson) {
  ExactPicture picture = studio_;
  Paint(picture, {20, 30, 49, 109}, {40, 50, 110});
  Paint(picture, {150, 60, 164, 74}, {200, 190, 60});
  const Silhouette silhouette = Segment(picture);
  EXPECT_EQ(CountSet(silhouette, {100, 0, kWidth - 1, kHeight - 1}), 0);
  EXPECT_NEAR(CountSet(silhouette), 30 * 80, 50);
}

TEST_F(SegmenterTest, MemoryOfAnotherSizeIsReused) {
  Trimap trimap{Silhouette(640, 480), Silhouette(640, 480)};
  trimap.person.Set(5, 5);
  trimap.unknown.Set(5, 5);
  segmenter_.Segment(sensor_.Take(studio_).view(), {}, trimap);
  for (const Silhouette* const plane : {&trimap.person, &trimap.unknown}) {
    EXPECT_EQ(plane->width(), kWidth);
    EXPECT_EQ(CountSet(*plane), 0);
  }
}

TEST(Segmenter, TooFewBackgroundFramesAreRefused) {
  NoisySensor sensor(2.0f, 23);
  const auto background = TakeBackground(EmptyStudio(kWidth, kHeight), 3, sensor);
  try {
    Segmenter segmenter(SmallCamera(), background, {});
    FAIL();
  } catch (const SetupError& error) {
    EXPECT_STREQ(error.what(), "background of camera cam3: found 3 frames; expected at least 8");
  }
}

TEST(Segmenter, ABackgroundOfAnotherSizeIsRefused) {
  NoisySensor sensor(2.0f, 24);
  auto background = TakeBackground(EmptyStudio(kWidth, kHeight), 9, sensor);
  background[4].image = Image<Bgr>(64, 48);
  try {
    Segmenter segmenter(SmallCamera(), background, {});
    FAIL();
  } catch (const SetupError& error) {
    EXPECT_STREQ(error.what(),
                 "background of camera cam3: found a frame of 64 x 48 px; expected 200 x 150 px as "
                 "in the calibration");
  }
}

TEST(Segmenter, ANudgedCameraIsFollowed) {
  NoisySensor sensor(2.0f, 26);
  const auto look = [](float dx, float dy) {
    ExactPicture picture(kWidth, kHeight);
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        const float u = (static_cast<float>(x) - dx) / 6, v = (static_cast<float>(y) - dy) / 7;
        const float grey = 130 + 50 * std::sin(u) * std::cos(v);
        picture(x, y) = {grey, 0.95f * grey, 0.9f * grey};
      }
    }
    return picture;
  };
  Segmenter segmenter(SmallCamera(), TakeBackground(look(0, 0), 30, sensor), {});
  ExactPicture picture = look(-0.3f, 1.3f);
  Trimap trimap;
  segmenter.Segment(sensor.Take(picture).view(), {}, trimap);
  EXPECT_EQ(CountSet(trimap.person), 0);
  Paint(picture, {80, 40, 109, 119}, {40, 30, 170});
  segmenter.Segment(sensor.Take(picture).view(), {}, trimap);
  EXPECT_NEAR(CountSet(trimap.person), 30 * 80, 80);
}

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
    ExactPicture picture(kWidth, kHeight);
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
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
  everything.SetAll(kWidth, kHeight);
  background->CoarsePass(angles, {});
  const ExpectedPicture whole = background->Expect(everything, {});
  Silhouette suspicious((kWidth + 7) / 8, (kHeight + 7) / 8);
  suspicious.Set(3, 0);
  suspicious.Set(12, 9);
  suspicious.Set(24, 18);
  part.Set(suspicious, kWidth, kHeight);
  background->CoarsePass({0.1, 0}, {});
  background->Expect(everything, {});
  background->CoarsePass(angles, {});
  const ExpectedPicture& partly = background->Expect(part, {});
  for (int y = 0; y < kHeight; ++y) {
    part.ForEachMeasured(y, [&](const PixelRun& run) {
      for (int x = run.begin; x < run.end; ++x) {
        const auto i = static_cast<std::size_t>(y * kWidth + x);
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
