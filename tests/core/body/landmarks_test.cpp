#include "core/body/landmarks.h"

#include <gtest/gtest.h>

#include "config/load_config.h"

namespace mocap {
namespace {

TEST(Landmarks, HaveTheNamesOfAllLibraries) {
  for (const char* name : {"shoulder_l", "left_shoulder", "LShoulder", "LEFT_SHOULDER"})
    EXPECT_EQ(LandmarkNamed(name), Landmark::kShoulderL) << name;
  EXPECT_EQ(LandmarkNamed("right_foot_index"), Landmark::kBigToeR);
  EXPECT_EQ(LandmarkNamed("RBigToe"), Landmark::kBigToeR);
  EXPECT_EQ(LandmarkNamed("Hip"), Landmark::kHipMiddle);
  EXPECT_EQ(LandmarkNamed("hip_r"), Landmark::kHipR);
  EXPECT_EQ(LandmarkNamed("Head"), Landmark::kTopOfHead);
  EXPECT_EQ(LandmarkNamed("mouth_left"), Landmark::kMouthL);
  for (const char* name : {"", "left", "shoulder", "left_thumb", "nose_l", "left_eye_inner"})
    EXPECT_EQ(LandmarkNamed(name), std::nullopt) << name;
}

TEST(Landmarks, AreFoundByTheirOwnNames) {
  for (int i = 0; i < kLandmarkCount; ++i) {
    const auto landmark = static_cast<Landmark>(i);
    EXPECT_EQ(LandmarkNamed(NameOf(landmark)), landmark) << NameOf(landmark);
    EXPECT_EQ(Mirrored(Mirrored(landmark)), landmark);
  }
}

TEST(Landmarks, OfLeftAndRightAreMirrored) {
  const BodyModel body(LoadBodyTable("full"), AverageSizes(1750));
  const LandmarkPlaces places = PlaceLandmarks(body);
  for (int i = 0; i < kLandmarkCount; ++i) {
    const Vector3& other_T = places[static_cast<int>(Mirrored(static_cast<Landmark>(i)))].p_T;
    EXPECT_TRUE(places[i].p_T.isApprox(other_T.cwiseProduct(Vector3(1, -1, 1)), 1e-9)) << i;
  }
}

TEST(Landmarks, OfTheFaceAreBeforeTheHead) {
  const BodyModel body(LoadBodyTable("full"), AverageSizes(1750));
  const LandmarkPlaces places = PlaceLandmarks(body);
  const auto place = [&](Landmark landmark) { return places[static_cast<int>(landmark)].p_T; };
  EXPECT_GT(place(Landmark::kNose).x(), place(Landmark::kEarL).x() + 50);
  EXPECT_GT(place(Landmark::kEyeL).z(), place(Landmark::kMouthL).z() + 30);
  EXPECT_GT(place(Landmark::kEarL).y(), place(Landmark::kEarR).y() + 100);
}

}  // namespace
}  // namespace mocap
