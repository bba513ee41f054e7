#include "core/reconstruction/carving/hull_agreement.h"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/support/walking_silhouettes.h"

namespace mocap {
namespace {

using testing::WalkOfTenSeconds;

/// One moment of the walk, as the calibration in force has it.
class HullAgreementTest : public ::testing::Test {
 protected:
  std::vector<CarvingView> Views(std::size_t moment) {
    std::vector<CarvingView> views;
    for (std::size_t c = 0; c < tables_.size(); ++c) {
      views.push_back({&tables_[c], &WalkOfTenSeconds().moments[moment][c], X_CW_[c]});
    }
    return views;
  }

  std::vector<SensorPlaneTable> tables_{WalkOfTenSeconds().cameras.begin(),
                                        WalkOfTenSeconds().cameras.end()};
  std::vector<RigidTransform> X_CW_ = [] {
    std::vector<RigidTransform> poses;
    for (const CameraCalibration& camera : WalkOfTenSeconds().cameras) poses.push_back(camera.X_CW);
    return poses;
  }();
  HullAgreement agreement_;
};

TEST_F(HullAgreementTest, CamerasThatStandWhereTheyWereAgree) {
  int compared = 0;
  for (std::size_t moment = 0; moment < 10; ++moment) {
    for (const auto& shift : agreement_.Measure(Views(moment))) {
      if (!shift) continue;
      ++compared;
      EXPECT_LT(shift->shift_px.norm(), 2);
      EXPECT_GT(shift->overlap, 0.7);
    }
  }
  EXPECT_GT(compared, 30);
}

TEST_F(HullAgreementTest, TheOneThatWasTurnedSeesThePersonBesideTheOthers) {
  constexpr double kTurn_rad = 0.7 * std::numbers::pi / 180;
  const Matrix3 turn = ExpRotation(Vector3(0, kTurn_rad, 0));
  X_CW_[3] = {turn * X_CW_[3].R, turn * X_CW_[3].p};
  Vector2 mean = Vector2::Zero();
  int compared = 0;
  for (std::size_t moment = 0; moment < 10; ++moment) {
    const auto& shift = agreement_.Measure(Views(moment))[3];
    if (!shift) continue;
    mean += shift->shift_px;
    ++compared;
  }
  ASSERT_GE(compared, 4);
  mean /= compared;
  EXPECT_GT(mean.norm(), 4);
  EXPECT_GT(std::abs(mean.x()), 3 * std::abs(mean.y())) << "it was turned to the side";
}

TEST_F(HullAgreementTest, WithoutSomebodyNothingIsCompared) {
  const Silhouette nobody(640, 480);
  std::vector<CarvingView> views = Views(0);
  for (CarvingView& view : views) view.silhouette = &nobody;
  for (const auto& shift : agreement_.Measure(views)) EXPECT_FALSE(shift);
  EXPECT_FALSE(agreement_.PlaceOf(views));
}

TEST_F(HullAgreementTest, TwoCamerasCannotJudgeEachOther) {
  std::vector<CarvingView> views = Views(0);
  views.resize(2);
  for (const auto& shift : agreement_.Measure(views)) EXPECT_FALSE(shift);
}

}  // namespace
}  // namespace mocap
