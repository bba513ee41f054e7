#include "core/reconstruction/carving/octant_view.h"

#include <gtest/gtest.h>

#include <random>

#include "core/reconstruction/silhouette/bit_filters.h"
#include "tests/core/reconstruction/synthetic_studio.h"

namespace mocap {
namespace {

class OctantViewTest : public ::testing::Test {
 protected:
  OctantViewTest() {
    studio_.Show(StandingPerson(0, 0));
    const std::vector<CarvingView> views = studio_.Views();
    windows_.resize(views.size());
    for (std::size_t c = 0; c < views.size(); ++c) {
      Dilate(studio_.silhouettes[c], 2, studio_.unknown[c]);
      Subtract(studio_.silhouettes[c], studio_.unknown[c]);
      windows_[c].Measure(*views[c].silhouette, views[c].unknown, *views[c].Box());
      eyes_.emplace_back().Set(views[c], kOrigin_W, windows_[c]);
    }
  }

  // Holds an octant's decisions against random places within.
  void Check(std::size_t camera, const OctantDecisions& decisions, int octant,
             const Vector3& middle_W, double half) {
    const CarvingView view = studio_.Views()[camera];
    std::uniform_real_distribution<double> within(-half, half);
    const bool inside = decisions.inside >> octant & 1, outside = decisions.outside >> octant & 1;
    const bool unseen = decisions.unseen >> octant & 1, unknown = decisions.unknown >> octant & 1;
    inside_ += inside, outside_ += outside, unseen_ += unseen, unknown_ += unknown;
    if (!inside && !outside && !unseen && !unknown) return;
    EXPECT_EQ(inside + outside + unseen + unknown, 1);
    for (int i = 0; i < 20; ++i) {
      const Vector3 p_W = middle_W + Vector3(within(random_), within(random_), within(random_));
      const Vector3 p_C = view.X_CW * p_W;
      SensorPlaneTable::Pixel pixel;
      if (p_C.z() > 0) pixel = view.table->Lookup(p_C.x() / p_C.z(), p_C.y() / p_C.z());
      ASSERT_EQ(pixel.x < 0, unseen);
      if (unseen) continue;
      const WindowMap::Kind kind = windows_[camera].At(pixel.x, pixel.y);
      ASSERT_EQ(kind == WindowMap::Kind::kInside, inside);
      ASSERT_EQ(kind == WindowMap::Kind::kOutside, outside);
    }
  }

  static Vector3 MiddleOf(const Vector3& middle, double spread, int octant) {
    return middle +
           spread * Vector3((octant & 1) * 2 - 1, (octant >> 1 & 1) * 2 - 1, (octant >> 2) * 2 - 1);
  }

  const Vector3 kOrigin_W{-1500, -1500, -100};
  SyntheticStudio studio_;
  std::vector<WindowMap> windows_;
  std::vector<OctantView> eyes_;
  std::mt19937 random_{4};
  int inside_ = 0, outside_ = 0, unseen_ = 0, unknown_ = 0;
};

TEST_F(OctantViewTest, ADecisionHoldsForEveryPlaceInTheOctant) {
  std::uniform_real_distribution<double> across(-4000, 4000), up(-200, 2600);
  for (int i = 0; i < 6000; ++i) {
    const std::size_t camera = i % eyes_.size();
    // Half of them near the person, the others anywhere in the room.
    Vector3 middle_W(across(random_), across(random_), up(random_));
    if (i % 12 < 6) middle_W.head<2>() /= 8;
    const double half = i % 3 == 0 ? 94 : i % 3 == 1 ? 19 : 0;
    const double spread = i % 3 == 0 ? 100 : i % 3 == 1 ? 25 : 6;
    OctantFrames frames;
    std::uint8_t framed;
    const OctantDecisions decisions =
        eyes_[camera].Project((middle_W - kOrigin_W).cast<float>(), static_cast<float>(spread),
                              static_cast<float>(half), frames, framed);
    for (int octant = 0; octant < OctantFrames::kLanes; ++octant)
      Check(camera, decisions, octant, MiddleOf(middle_W, spread, octant), half);
  }
  for (const int count : {inside_, outside_, unseen_}) EXPECT_GT(count, 500);
}

TEST_F(OctantViewTest, WhatReachesBeyondTheSilhouettesBoxIsNotInside) {
  std::uniform_real_distribution<double> across(-900, 900), up(0, 1800);
  const CarvingView view = studio_.Views()[0];
  const int width = view.silhouette->width(), height = view.silhouette->height();
  const PixelBox box{width / 3, height / 3, width / 2, height / 2};
  Silhouette block(width, height);
  for (int y = box.top; y <= box.bottom; ++y)
    for (int x = box.left; x <= box.right; ++x) block.Set(x, y);
  windows_[0].Measure(block, nullptr, box);
  eyes_[0].Set(view, kOrigin_W, windows_[0]);
  for (int i = 0; i < 20000; ++i) {
    const Vector3 middle_W(across(random_), across(random_), up(random_));
    OctantFrames frames;
    std::uint8_t framed;
    const double half = i % 5;
    const OctantDecisions decisions = eyes_[0].Project((middle_W - kOrigin_W).cast<float>(), 6,
                                                       static_cast<float>(half), frames, framed);
    for (int octant = 0; octant < OctantFrames::kLanes; ++octant)
      Check(0, decisions, octant, MiddleOf(middle_W, 6, octant), half);
  }
  for (const int count : {inside_, outside_}) EXPECT_GT(count, 500);
}

TEST_F(OctantViewTest, AFrameServesForAllThatLiesInItsOctant) {
  std::uniform_real_distribution<double> across(-300, 300), up(0, 1800);
  for (int i = 0; i < 500; ++i) {
    const std::size_t camera = i % eyes_.size();
    const Vector3 middle_W(across(random_), across(random_), up(random_));
    const double spread = 50, half = 43.75;
    OctantFrames frames;
    std::uint8_t framed;
    eyes_[camera].Project((middle_W - kOrigin_W).cast<float>(), static_cast<float>(spread),
                          static_cast<float>(half), frames, framed);
    for (int lane = 0; lane < OctantFrames::kLanes; ++lane) {
      if (~framed >> lane & 1) continue;
      const Vector3 frame_W = MiddleOf(middle_W, spread, lane);
      for (const double side : {50.0, 25.0, 12.5}) {
        const double small_half = side / 2 - 6.25;
        std::uniform_real_distribution<double> shift(side - half + small_half / 2 - side / 2,
                                                     half - side / 2 - small_half / 2);
        const Vector3 offset(0, 0, side < 50 ? shift(random_) / 2 : 0);
        const OctantDecisions decisions = eyes_[camera].JudgeByFrame(
            frames, lane, (frame_W + offset - kOrigin_W).cast<float>(),
            static_cast<float>(side / 2), static_cast<float>(std::max(small_half, 0.0)));
        for (int octant = 0; octant < OctantFrames::kLanes; ++octant)
          Check(camera, decisions, octant, MiddleOf(frame_W + offset, side / 2, octant),
                std::max(small_half, 0.0));
      }
    }
  }
  for (const int count : {inside_, outside_}) EXPECT_GT(count, 500);
}

TEST_F(OctantViewTest, SamplesOfEightVoxelsAreJudgedAsByThemselves) {
  std::uniform_real_distribution<double> across(-300, 300), up(0, 1800);
  for (int i = 0; i < 400; ++i) {
    const std::size_t camera = i % eyes_.size();
    const Vector3 middle_W(across(random_), across(random_), up(random_));
    OctantFrames frames;
    std::uint8_t framed;
    eyes_[camera].Project((middle_W - kOrigin_W).cast<float>(), 25, 18.75f, frames, framed);
    for (int lane = 0; lane < OctantFrames::kLanes; ++lane) {
      if (~framed >> lane & 1) continue;
      const Vector3 frame_W = MiddleOf(middle_W, 25, lane);
      const std::uint8_t asked = i % 2 == 0 ? 0xff : 0x36;
      const SampleDecisions samples = eyes_[camera].JudgeSamplesByFrame(
          frames, lane, (frame_W - kOrigin_W).cast<float>(), 12.5f, 6.25f, asked);
      for (int voxel = 0; voxel < OctantFrames::kLanes; ++voxel) {
        if (~asked >> voxel & 1) continue;
        const auto of_voxel = [voxel](std::uint64_t bits) {
          std::uint8_t samples_of_it = 0;
          for (int sample = 0; sample < OctantFrames::kLanes; ++sample)
            samples_of_it |=
                static_cast<std::uint8_t>((bits >> (8 * sample + voxel) & 1) << sample);
          return samples_of_it;
        };
        const OctantDecisions decisions{of_voxel(samples.inside), of_voxel(samples.outside),
                                        of_voxel(samples.unseen), of_voxel(samples.unknown)};
        const Vector3 voxel_W = MiddleOf(frame_W, 12.5, voxel);
        for (int sample = 0; sample < OctantFrames::kLanes; ++sample)
          Check(camera, decisions, sample, MiddleOf(voxel_W, 6.25, sample), 0);
      }
    }
  }
  for (const int count : {inside_, outside_}) EXPECT_GT(count, 500);
}

TEST_F(OctantViewTest, OfSinglePixelsItTellsWhetherTheyAreUnknown) {
  std::uniform_real_distribution<double> across(-900, 900), up(0, 1800);
  for (int i = 0; i < 4000; ++i) {
    const std::size_t camera = i % eyes_.size();
    const Vector3 middle_W(across(random_), across(random_), up(random_));
    OctantFrames frames;
    std::uint8_t framed;
    const OctantDecisions decisions =
        eyes_[camera].Project((middle_W - kOrigin_W).cast<float>(), 6.25f, 0, frames, framed);
    for (int octant = 0; octant < OctantFrames::kLanes; ++octant)
      Check(camera, decisions, octant, MiddleOf(middle_W, 6.25, octant), 0);
  }
  EXPECT_GT(unknown_, 50);
}

}  // namespace
}  // namespace mocap
