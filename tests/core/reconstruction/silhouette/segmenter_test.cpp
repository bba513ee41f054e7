#include "core/reconstruction/silhouette/segmenter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/errors.h"
#include "tests/core/reconstruction/lenses.h"
#include "tests/core/reconstruction/silhouette/segmenter_studio.h"
#include "tests/core/reconstruction/synthetic_pictures.h"

namespace mocap {
namespace {

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
        studio_(EmptyStudio(kSmallWidth, kSmallHeight)),
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
  for (int y = 0; y < kSmallHeight; ++y)
    for (int x = 0; x < kSmallWidth; ++x)
      Dim(picture, {x, y, x, y},
          1 - 0.25f / (1 + std::exp((std::hypot((x - 120) / 2.0f, y - 120.0f) - 18) / 3)));
  PaintSmoothly(picture, {40, 50, 110},
                [](double x, double y) { return std::hypot((x - 80) / 0.4, y - 70) < 50; });
  const Silhouette silhouette = Segment(picture);
  EXPECT_GT(CountSet(silhouette), 2800);
  EXPECT_EQ(CountSet(silhouette, {106, 0, kSmallWidth - 1, kSmallHeight - 1}), 0);
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
  EXPECT_EQ(CountSet(trimap.unknown, {150, 0, kSmallWidth - 1, kSmallHeight - 1}), 0);
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
  Paint(picture, {0, 60, 30, kSmallHeight - 1}, {40, 50, 110});
  const Silhouette silhouette = Segment(picture);
  EXPECT_NEAR(CountSet(silhouette), 31 * 90, 40);
  EXPECT_TRUE(silhouette.Test(0, kSmallHeight - 1));
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
  for (int y = 0; y < kSmallHeight; ++y) {
    for (int x = 0; x < kSmallWidth; ++x) {
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

TEST(Segmenter, NoiseThatACodecRemovedFromTheEmptyStudioHasNoSilhouette) {
  const ExactPicture studio = EmptyStudio(kSmallWidth, kSmallHeight);
  NoisySensor coded(kNoNoise, 26), sensor(1.5f, 27);
  Segmenter segmenter(SmallCamera(), TakeBackground(studio, 30, coded), {});
  Trimap trimap;
  for (int i = 0; i < 5; ++i) {
    segmenter.Segment(sensor.Take(studio).view(), {}, trimap);
    EXPECT_EQ(CountSet(trimap.person), 0);
  }
}

TEST(Segmenter, TheHaloOfACodecBesideAPersonIsLeftOut) {
  const ExactPicture studio = EmptyStudio(kSmallWidth, kSmallHeight);
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
    for (int y = 0; y < kSmallHeight; ++y)
      for (int x = 0; x < kSmallWidth; ++x)
        picture(x, y)[2] += static_cast<float>(8 * std::sin(x / 11.0));
    take(picture, 1);
    // A nudge.
    for (int y = 0; y < kSmallHeight; ++y)
      for (int x = 0; x + 1 < kSmallWidth; ++x) picture(x, y) = picture(x + 1, y);
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
  EXPECT_EQ(CountSet(silhouette, {100, 0, kSmallWidth - 1, kSmallHeight - 1}), 0);
  EXPECT_NEAR(CountSet(silhouette), 30 * 80, 50);
}

TEST_F(SegmenterTest, MemoryOfAnotherSizeIsReused) {
  Trimap trimap{Silhouette(640, 480), Silhouette(640, 480)};
  trimap.person.Set(5, 5);
  trimap.unknown.Set(5, 5);
  segmenter_.Segment(sensor_.Take(studio_).view(), {}, trimap);
  for (const Silhouette* const plane : {&trimap.person, &trimap.unknown}) {
    EXPECT_EQ(plane->width(), kSmallWidth);
    EXPECT_EQ(CountSet(*plane), 0);
  }
}

TEST(Segmenter, TooFewBackgroundFramesAreRefused) {
  NoisySensor sensor(2.0f, 23);
  const auto background = TakeBackground(EmptyStudio(kSmallWidth, kSmallHeight), 3, sensor);
  try {
    Segmenter segmenter(SmallCamera(), background, {});
    FAIL();
  } catch (const SetupError& error) {
    EXPECT_STREQ(error.what(), "background of camera cam3: found 3 frames; expected at least 8");
  }
}

TEST(Segmenter, ABackgroundOfAnotherSizeIsRefused) {
  NoisySensor sensor(2.0f, 24);
  auto background = TakeBackground(EmptyStudio(kSmallWidth, kSmallHeight), 9, sensor);
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
    ExactPicture picture(kSmallWidth, kSmallHeight);
    for (int y = 0; y < kSmallHeight; ++y) {
      for (int x = 0; x < kSmallWidth; ++x) {
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

}  // namespace
}  // namespace mocap
