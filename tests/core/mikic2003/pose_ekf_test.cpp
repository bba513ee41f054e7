#include "core/mikic2003/pose_ekf.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/core/mikic2003/paper_person.h"

namespace mocap::mikic2003 {
namespace {

TEST(Equation9, OnlyTheAxisDirectionCounts) {
  const Vector3 axis(0.3, -0.5, 0.8);
  EXPECT_LT((TorsoRotation(axis, 1.2) - TorsoRotation(3 * axis, 1.2)).norm(), 1e-12);
  EXPECT_LT((TorsoRotation(axis, 1.2) * axis - axis).norm(), 1e-12);
}

TEST(Table1, StateAndPoseAreTwoWaysToSayTheSame) {
  const PaperPerson person;
  for (const double turned_rad : {-3.0, -1.0, 0.0, 0.5, 3.1}) {
    const PoseState pose = person.Pose(kSpread, turned_rad);
    const PoseState same = PoseOf(person.body, StateOf(person.body, pose));
    EXPECT_LT(same.Minus(pose).norm(), 1e-9);
  }
}

TEST(Equations17To21, AreTheDerivativesOfEveryPoint) {
  const PaperPerson person;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-0.3, 0.3);
  State x = StateOf(person.body, person.Pose(kSpread, 2.5));
  for (int i = 3; i < kStateSize; ++i) x[i] += uniform(random);
  const Posture posture = person.body.PostureAt(PoseOf(person.body, x));
  const BodyPoints points = person.body.PointsAt(posture);
  constexpr double kStep = 1e-5;
  for (int i = 0; i < kPointCount; ++i) {
    const PointJacobian J =
        DifferentiatePoint(person.body, x, posture, static_cast<Point>(i), points.col(i));
    for (int k = 0; k < kStateSize; ++k) {
      const auto at = [&](double step) {
        return person.Place(PoseOf(person.body, x + step * State::Unit(k)), static_cast<Point>(i));
      };
      const Vector3 expected = (at(kStep) - at(-kStep)) / (2 * kStep);
      EXPECT_LT((J.col(k) - expected).norm(), 1e-3) << kPointNames[i] << " by " << k;
    }
  }
}

TEST(PaperFilter, ComesToThePoseThatThePointsShow) {
  const PaperPerson person;
  const PoseState truth = person.Pose(kSpread);
  PoseState start = person.Pose({});
  start.X_WT.p += Vector3(80, -60, 40);
  PoseEkf filter(person.body, start);
  filter.Update(person.body, person.Points(truth), 20);
  EXPECT_LT(
      SumOfDistances(person.body, filter.Pose(person.body), person.Points(truth)) / kPointCount,
      15);
}

TEST(PaperFilter, FollowsAPersonWhoTurnsRoundAndRound) {
  const PaperPerson person;
  PoseEkf filter(person.body, person.Pose(kSpread, 0));
  for (int frame = 1; frame < 80; ++frame) {
    const PoseState truth = person.Pose(kSpread, 0.2 * frame);
    filter.Predict(0.1);
    filter.Update(person.body, person.Points(truth), 5);
    const double mean_mm =
        SumOfDistances(person.body, filter.Pose(person.body), person.Points(truth)) / kPointCount;
    ASSERT_LT(mean_mm, 20) << "frame " << frame;
  }
}

TEST(PaperFilter, HoldsTheLimitsOfJoints) {
  const PaperPerson person;
  Stance stance = kSpread;
  stance.leg_l.knee = -60;
  PoseEkf filter(person.body, person.Pose(kSpread));
  filter.Update(person.body, person.Points(person.Pose(stance)), 20);
  const PoseState pose = filter.Pose(person.body);
  for (int i = 0; i < person.body.joint_count(); ++i) {
    EXPECT_GE(pose.theta[i], person.body.table().joints[i].min_rad);
    EXPECT_LE(pose.theta[i], person.body.table().joints[i].max_rad);
  }
}

TEST(PaperFilter, KnowsLessOfWhatIsNotMeasured) {
  const PaperPerson person;
  const PoseState truth = person.Pose(kSpread);
  MeasuredPoints points = person.Points(truth);
  for (const Point point : {Point::kFingertipsL, Point::kElbowL, Point::kLowerArmL}) {
    At(points, point).reset();
  }
  PoseEkf filter(person.body, truth);
  filter.Update(person.body, points, 5);
  EXPECT_GT(filter.PointCovariance(person.body, Point::kFingertipsL).trace(),
            4 * filter.PointCovariance(person.body, Point::kFingertipsR).trace());
}

}  // namespace
}  // namespace mocap::mikic2003
