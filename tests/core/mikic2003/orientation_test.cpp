#include "core/mikic2003/orientation.h"

#include <gtest/gtest.h>

#include "tests/core/mikic2003/paper_person.h"

namespace mocap::mikic2003 {
namespace {

double FacingOf(const PaperPerson& person, const OrientedBody& found, const PoseState& truth) {
  return found.best().Pose(person.body).X_WT.R.col(0).dot(truth.X_WT.R.col(0));
}

TEST(Figure14, BentKneesTellFrontFromBack) {
  const PaperPerson person;
  Stance stance = kSpread;
  stance.leg_l = {.hip = 60, .spread = 10, .knee = 70};
  const PoseState truth = person.Pose(stance);
  const MeasuredPoints points = person.Points(truth);
  const Matrix3 R_turned = truth.X_WT.R * ExpRotation(EIGEN_PI * Vector3::UnitZ());
  EXPECT_GT(FacingOf(person, OrientedBody(person.body, truth.X_WT.R, points), truth), 0.9);
  EXPECT_GT(FacingOf(person, OrientedBody(person.body, R_turned, ExchangeSides(points)), truth),
            0.9);
}

TEST(Figure14, ADecisionThatIsNotClearIsDeferred) {
  const PaperPerson person;
  Stance straight;
  straight.arm_l = straight.arm_r = {.raise = 0, .elbow = 0};
  straight.leg_l = straight.leg_r = {.hip = 0, .spread = 10, .knee = 0};
  const PoseState first = person.Pose(straight);
  const Matrix3 R_turned = first.X_WT.R * ExpRotation(EIGEN_PI * Vector3::UnitZ());
  OrientedBody found(person.body, R_turned, ExchangeSides(person.Points(first)));
  Stance bent = straight;
  bent.leg_l = {.hip = 60, .spread = 10, .knee = 70};
  const PoseState second = person.Pose(bent);
  found.Predict(0.1);
  const bool is_turned = FacingOf(person, found, first) < 0;
  const MeasuredPoints points = person.Points(second);
  found.Update(person.body, is_turned ? ExchangeSides(points) : points, true);
  EXPECT_GT(FacingOf(person, found, second), 0.9);
}

TEST(Figure14, ExchangingSidesTwiceChangesNothing) {
  const PaperPerson person;
  const MeasuredPoints points = person.Points(person.Pose(kSpread));
  const MeasuredPoints exchanged = ExchangeSides(points);
  EXPECT_EQ(At(exchanged, Point::kKneeL), At(points, Point::kKneeR));
  EXPECT_EQ(At(exchanged, Point::kCalfR), At(points, Point::kCalfL));
  EXPECT_EQ(At(exchanged, Point::kNeck), At(points, Point::kNeck));
  EXPECT_EQ(ExchangeSides(exchanged), points);
}

}  // namespace
}  // namespace mocap::mikic2003
