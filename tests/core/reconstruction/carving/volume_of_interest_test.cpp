#include "core/reconstruction/carving/volume_of_interest.h"

#include <gtest/gtest.h>

#include "core/reconstruction/carving/convex_volume.h"
#include "tests/core/reconstruction/synthetic_studio.h"

namespace mocap {
namespace {

Eigen::AlignedBox3d BoxOf(const std::vector<DrawnCapsule>& capsules) {
  Eigen::AlignedBox3d box;
  for (const DrawnCapsule& c : capsules) {
    for (const Vector3& end : {c.a_W, c.b_W}) {
      box.extend(end + Vector3::Constant(c.radius_mm));
      box.extend(end - Vector3::Constant(c.radius_mm));
    }
  }
  return box;
}

TEST(ConvexVolume, ACornerCutOffACubeLeavesTheRest) {
  ConvexVolume volume;
  volume.Reset(Eigen::AlignedBox3d(Vector3::Zero(), Vector3::Ones()));
  volume.Clip({1, 1, 1}, 1);
  EXPECT_NEAR((volume.Extent().max() - Vector3::Ones()).norm(), 0, 1e-12);
  volume.Clip({-1, 0, 0}, -0.5);
  // What is left is the tetrahedron at (0.5..1, 0..0.5, 0..0.5).
  EXPECT_NEAR((volume.Extent().min() - Vector3(0.5, 0, 0)).norm(), 0, 1e-12);
  EXPECT_NEAR((volume.Extent().max() - Vector3(1, 0.5, 0.5)).norm(), 0, 1e-12);
}

TEST(ConvexVolume, CutsBeyondItChangeNothingAndCutsBeforeItLeaveNothing) {
  ConvexVolume volume;
  volume.Reset(Eigen::AlignedBox3d(Vector3::Zero(), Vector3::Ones()));
  volume.Clip({0, 0, 1}, 2);
  EXPECT_NEAR((volume.Extent().max() - Vector3::Ones()).norm(), 0, 1e-12);
  volume.Clip({0, 0, 1}, -0.1);
  EXPECT_TRUE(volume.empty());
}

TEST(VolumeOfInterest, HoldsThePersonAndLittleMore) {
  SyntheticStudio studio;
  for (const Vector2& at : {Vector2(0, 0), Vector2(900, -600)}) {
    const std::vector<DrawnCapsule> person = StandingPerson(at.x(), at.y());
    studio.Show(person);
    const std::optional<Eigen::AlignedBox3d> volume = VolumeOfInterest().Find(studio.Views());
    ASSERT_TRUE(volume.has_value());
    // What no pixel's centre hits, 13 mm apart, is not seen.
    const Eigen::AlignedBox3d box = BoxOf(person);
    EXPECT_TRUE(((volume->min() - box.min()).array() < 13).all());
    EXPECT_TRUE(((box.max() - volume->max()).array() < 13).all());
    // Arms along x, seen from all around, leave as much room along y.
    const Vector3 slack =
        volume->sizes() - Vector3(box.sizes().x(), box.sizes().x(), box.sizes().z());
    EXPECT_LT(slack.maxCoeff(), 500) << volume->sizes().transpose();
  }
}

TEST(VolumeOfInterest, ASideThatRunsOutOfThePictureBoundsNothing) {
  SyntheticStudio studio;
  const std::vector<DrawnCapsule> person = StandingPerson(0, 0);
  // One camera sees the legs only, one the left arm only, one a shoulder from close by.
  studio.cameras[1].X_CW = LookAt({100, -2900, 2000}, {0, 0, -600});
  studio.cameras[3].X_CW = LookAt({2900, 2700, 2200}, {3000, -2500, 900});
  studio.cameras[4].X_CW = LookAt({-150, 700, 1600}, {0, 0, 1300});
  studio.Show(person);
  const std::optional<Eigen::AlignedBox3d> volume = VolumeOfInterest().Find(studio.Views());
  ASSERT_TRUE(volume.has_value());
  const Eigen::AlignedBox3d box = BoxOf(person);
  EXPECT_TRUE(((volume->min() - box.min()).array() < 13).all());
  EXPECT_TRUE(((box.max() - volume->max()).array() < 13).all());
}

TEST(VolumeOfInterest, DoesNotReachBelowTheFloorsTolerance) {
  SyntheticStudio studio;
  studio.Show({{{0, 0, -400}, {0, 0, 500}, 100}});
  const std::optional<Eigen::AlignedBox3d> volume = VolumeOfInterest().Find(studio.Views());
  ASSERT_TRUE(volume.has_value());
  EXPECT_NEAR(volume->min().z(), -50, 1e-6);
}

TEST(VolumeOfInterest, OneCameraAloneCannotPlaceAPerson) {
  SyntheticStudio studio;
  studio.Show(StandingPerson(0, 0));
  for (std::size_t c = 1; c < studio.silhouettes.size(); ++c) studio.silhouettes[c].Reset(320, 240);
  EXPECT_FALSE(VolumeOfInterest().Find(studio.Views()).has_value());
}

TEST(VolumeOfInterest, ConesThatDoNotMeetLeaveNothing) {
  SyntheticStudio studio;
  studio.Show({{{-1500, 0, 1000}, {-1500, 0, 1000}, 80}});
  const std::vector<Silhouette> left = studio.silhouettes;
  studio.Show({{{1500, 0, 1000}, {1500, 0, 1000}, 80}});
  studio.silhouettes[0] = left[0];
  studio.silhouettes[3] = left[3];
  EXPECT_FALSE(VolumeOfInterest().Find(studio.Views()).has_value());
}

}  // namespace
}  // namespace mocap
