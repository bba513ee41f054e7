#include "tools/camera_health.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "core/errors.h"
#include "tests/support/walking_silhouettes.h"

namespace mocap {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr double kBump_rad = 0.5 * std::numbers::pi / 180;

const TakeSamples& Walk() {
  static const TakeSamples samples = [] {
    const testing::WalkingSilhouettes& seen = testing::WalkOfTenSeconds();
    TakeSamples walk;
    walk.cameras = seen.cameras;
    for (const std::vector<Silhouette>& silhouettes : seen.moments) {
      SampledMoment& moment = walk.moments.emplace_back();
      for (std::size_t c = 0; c < silhouettes.size(); ++c) {
        moment.views.push_back(SampledView{walk.cameras[c].X_CW, {silhouettes[c], {}}, {}});
      }
    }
    return walk;
  }();
  return samples;
}

/// The calibration as it was before a camera was turned.
TakeSamples Bumped(TakeSamples samples, std::size_t camera, const Vector3& turn) {
  const Matrix3 R = ExpRotation(turn);
  RigidTransform& X_CW = samples.cameras[camera].X_CW;
  X_CW = {R * X_CW.R, R * X_CW.p};
  for (SampledMoment& moment : samples.moments) moment.views[camera]->X_CW = X_CW;
  return samples;
}

double TurnBetween(const CameraCalibration& a, const CameraCalibration& b) {
  return LogRotation(a.X_CW.R * b.X_CW.R.transpose()).norm();
}

TEST(CameraHealthTest, LeavesAStudioAloneThatHasNotMoved) {
  const RefinedStudio refined = RefineFromSilhouettes(Walk());
  EXPECT_THAT(refined.moved, IsEmpty());
  for (const CameraShift& shift : refined.before) EXPECT_LT(shift.shift_px.norm(), kMovedPx);
}

TEST(CameraHealthTest, NamesACameraThatWasBumpedByHalfADegreeAndPutsItRight) {
  const Vector3 turn = kBump_rad * Vector3(0.5, -1, 0.2).normalized();
  const RefinedStudio refined = RefineFromSilhouettes(Bumped(Walk(), 3, turn));
  EXPECT_THAT(refined.moved, ElementsAre("cam4"));
  const CameraShift& shift = refined.before[3];
  EXPECT_GT(shift.shift_px.norm(), 2.5);
  const double left_rad = TurnBetween(refined.cameras[3], Walk().cameras[3]);
  // Roll about the axis moves next to nothing in the picture and is not looked for.
  EXPECT_LT(left_rad, 0.3 * kBump_rad);
  EXPECT_LT(refined.after[3].shift_px.norm(), 0.6);
  EXPECT_EQ(refined.cameras[0].X_CW.p, Walk().cameras[0].X_CW.p);
}

/// The recording as it would be through a longer lens.
TakeSamples Zoomed(TakeSamples samples, std::size_t camera, double growth) {
  std::get<TsaiLens>(samples.cameras[camera].lens).focal_mm /= 1 + growth;
  return samples;
}

TEST(CameraHealthTest, NamesTheCameraWhoseZoomWasTouched) {
  for (const CameraShift& shift : MeasureShifts(Walk(), Walk().cameras))
    EXPECT_LT(std::abs(shift.growth), kZoomedShare) << shift.camera;
  const TakeSamples zoomed = Zoomed(Walk(), 2, 0.04);
  EXPECT_GT(MeasureShifts(zoomed, zoomed.cameras)[2].growth, kZoomedShare);
}

TEST(CameraHealthTest, PeopleWhomThePictureCutsOffAreComparedAsFarAsTheyAreSeen) {
  TakeSamples cut = Bumped(Walk(), 3, kBump_rad * Vector3(0.5, -1, 0.2).normalized());
  // Camera 4 no longer shows what is below its 300th row.
  for (SampledMoment& moment : cut.moments) {
    const Silhouette whole = moment.views[3]->trimap.person;
    Silhouette& upper = moment.views[3]->trimap.person;
    upper.Reset(whole.width(), 300);
    for (int y = 0; y < 300; ++y) std::copy_n(whole.row(y), whole.words_per_row(), upper.row(y));
  }
  cut.cameras[3].height_px = 300;
  const RefinedStudio refined = RefineFromSilhouettes(cut);
  EXPECT_THAT(refined.moved, ElementsAre("cam4"));
  EXPECT_LT(TurnBetween(refined.cameras[3], Walk().cameras[3]), 0.4 * kBump_rad);
}

TEST(CameraHealthTest, SaysSoWhenNobodyIsSeen) {
  TakeSamples empty = Walk();
  for (SampledMoment& moment : empty.moments) {
    for (auto& view : moment.views) view->trimap.person = Silhouette(640, 480);
  }
  try {
    RefineFromSilhouettes(empty);
    FAIL() << "accepted";
  } catch (const SetupError& error) {
    EXPECT_THAT(error.what(), HasSubstr("0 cameras see a whole person who moves"));
  }
}

}  // namespace
}  // namespace mocap
