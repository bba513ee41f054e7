#include "core/reconstruction/carving/floor_shadows.h"

#include <gtest/gtest.h>

#include <bit>
#include <utility>

#include "core/reconstruction/silhouette/bit_filters.h"
#include "tests/core/reconstruction/synthetic_studio.h"

namespace mocap {
namespace {

constexpr float kShade = -0.1f;
constexpr int kTile_px = Shading::kTile_px;

int CountOf(const Silhouette& silhouette) {
  int count = 0;
  for (const std::uint64_t word : silhouette.words()) count += std::popcount(word);
  return count;
}

Silhouette Without(Silhouette from, const Silhouette& what) {
  Subtract(what, from);
  return from;
}

Silhouette Common(Silhouette a, const Silhouette& b) {
  Intersect(b, a);
  return a;
}

// Somebody whose trousers one camera cannot tell from the floor, and a shadow beside him.
class Trousers : public ::testing::Test {
 protected:
  explicit Trousers(const SyntheticStudio& studio = SyntheticStudio()) : studio_(studio) {
    studio_.Show({{{0, 0, 900}, {0, 0, 1600}, 180}});
    const std::vector<Silhouette> upper = studio_.silhouettes;
    studio_.Show({{{0, -120, 80}, {0, -120, 900}, 90}, {{0, 120, 80}, {0, 120, 900}, 90}});
    for (std::size_t i = 0; i < upper.size(); ++i) {
      const Silhouette legs = Without(studio_.silhouettes[i], upper[i]);
      Silhouette person = upper[i];
      if (i > 0) Unite(legs, person);
      if (i == 0) legs_ = legs;
      shadows_.push_back(Without(Without(ShadowIn(i), legs), upper[i]));
      Silhouette dark = shadows_[i];
      if (i == 0) Unite(legs, dark);
      shadings_.push_back(ShadingOf(dark));
      trimaps_.push_back({person, dark});
    }
  }

  // Between the person and the first camera, half a metre wide.
  Silhouette ShadowIn(std::size_t view) const {
    const CameraCalibration& camera = studio_.cameras[view];
    const RigidTransform X_WC = camera.X_CW.Inverse();
    const Vector3 eye_W = studio_.cameras[0].X_CW.Inverse().p;
    const Vector3 middle_W = 900 * Vector3(eye_W.x(), eye_W.y(), 0).normalized();
    Silhouette shadow(camera.width_px, camera.height_px);
    for (int y = 0; y < camera.height_px; ++y) {
      for (int x = 0; x < camera.width_px; ++x) {
        const auto place = NormalizedFromPixel(camera.lens, Vector2(x, y));
        if (!place) continue;
        const Vector3 direction_W = X_WC.R * Vector3(place->x(), place->y(), 1);
        if (direction_W.z() >= 0) continue;
        const Vector3 floor_W = X_WC.p - X_WC.p.z() / direction_W.z() * direction_W;
        if ((floor_W - middle_W).norm() < 500) shadow.Set(x, y);
      }
    }
    return shadow;
  }

  static Shading ShadingOf(const Silhouette& dark) {
    Shading shading;
    shading.dark = dark;
    shading.tile_columns = dark.width() / kTile_px;
    for (int row = 0; row < dark.height() / kTile_px; ++row) {
      for (int column = 0; column < shading.tile_columns; ++column) {
        int count = 0;
        for (int i = 0; i < kTile_px * kTile_px; ++i)
          count += dark.Test(column * kTile_px + i % kTile_px, row * kTile_px + i / kTile_px);
        shading.shades.push_back(
            Shading::ShadeOf(kShade * static_cast<float>(count) / (kTile_px * kTile_px)));
        if (count == 0) continue;
        shading.dark_tiles.push_back({static_cast<std::int16_t>(column),
                                      static_cast<std::int16_t>(row), Shading::ShadeOf(kShade)});
      }
    }
    return shading;
  }

  std::vector<ShadedView> Complete(std::size_t count) {
    FloorShadows shadows(studio_.cameras);
    const std::vector<CarvingView> carving = studio_.Views();
    std::vector<ShadedView> views;
    for (std::size_t i = 0; i < count; ++i)
      views.push_back({static_cast<int>(i), carving[i].table, studio_.cameras[i].X_CW,
                       &shadings_[i], &trimaps_[i]});
    shadows.Complete(views);
    return views;
  }

  SyntheticStudio studio_;
  std::vector<Trimap> trimaps_;
  std::vector<Silhouette> shadows_;
  std::vector<Shading> shadings_;
  Silhouette legs_;
};

TEST_F(Trousers, AreCompletedWhereOthersSeeABrightFloorBehindThem) {
  const int missing = CountOf(legs_), before = CountOf(Common(trimaps_[0].person, legs_));
  ASSERT_EQ(before, 0);
  EXPECT_TRUE(Complete(6)[0].has_changed);
  EXPECT_GT(CountOf(Common(trimaps_[0].person, legs_)), 0.8 * missing);
}

TEST_F(Trousers, ShadowsStayOutside) {
  Complete(6);
  for (std::size_t i = 0; i < 6; ++i) {
    const int shadow = CountOf(shadows_[i]);
    ASSERT_GT(shadow, 200);
    EXPECT_LT(CountOf(Common(trimaps_[i].person, shadows_[i])), 0.05 * shadow) << i;
  }
}

TEST_F(Trousers, ShadowsThatOthersSeeAreNoLongerUnknown) {
  Complete(6);
  for (std::size_t i = 0; i < 6; ++i)
    EXPECT_LT(CountOf(trimaps_[i].unknown), 0.1 * CountOf(shadows_[i])) << i;
}

TEST_F(Trousers, ShadowsWhereTheCameraDoesNotKnowTheFloorStayUnknown) {
  const Trimap before = trimaps_[2];
  shadings_[2].shades.assign(shadings_[2].shades.size(), Shading::kUnknown);
  Complete(6);
  EXPECT_EQ(trimaps_[2].unknown.words(), before.unknown.words());
}

TEST_F(Trousers, StayMissingWhereTooFewTellOfTheFloor) {
  const Silhouette before = trimaps_[0].person;
  Complete(2);
  EXPECT_EQ(trimaps_[0].person.words(), before.words());
}

TEST_F(Trousers, WhatIsNotKnownOfTheFloorTellsNothing) {
  for (Shading& shading : shadings_)
    shading.shades.assign(shading.shades.size(), Shading::kUnknown);
  EXPECT_FALSE(Complete(6)[0].has_changed);
}

TEST_F(Trousers, WhoIsAskedFirstDoesNotMatter) {
  const std::vector<Trimap> before = trimaps_;
  Complete(6);
  const std::vector<Trimap> completed = std::exchange(trimaps_, before);
  FloorShadows shadows(studio_.cameras);
  const std::vector<CarvingView> carving = studio_.Views();
  std::vector<ShadedView> backwards;
  for (std::size_t i = 6; i-- > 0;)
    backwards.push_back({static_cast<int>(i), carving[i].table, studio_.cameras[i].X_CW,
                         &shadings_[i], &trimaps_[i]});
  shadows.Complete(backwards);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(trimaps_[i].person.words(), completed[i].person.words()) << i;
    EXPECT_EQ(trimaps_[i].unknown.words(), completed[i].unknown.words()) << i;
  }
}

class TrousersAmongMany : public Trousers {
 protected:
  TrousersAmongMany() : Trousers(SyntheticStudio(64)) {}
};

TEST_F(TrousersAmongMany, AreCompletedAndShadowsStayOutside) {
  const int missing = CountOf(legs_);
  EXPECT_TRUE(Complete(64)[0].has_changed);
  EXPECT_GT(CountOf(Common(trimaps_[0].person, legs_)), 0.8 * missing);
  for (const std::size_t i : {0, 1, 31, 32, 63})
    EXPECT_LT(CountOf(Common(trimaps_[i].person, shadows_[i])), 0.05 * CountOf(shadows_[i])) << i;
}

}  // namespace
}  // namespace mocap
