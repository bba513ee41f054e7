#include "core/hypotheses/pose_filter.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>
#include <random>

#include "config/load_config.h"
#include "core/objective/pose_priors.h"

namespace mocap {
namespace {

class Filter : public ::testing::Test {
 protected:
  PoseState Upright() const {
    PoseState pose;
    pose.X_WT.p = Vector3(100, 200, 1200);
    pose.theta = JointAngles::Zero(body_.joint_count());
    for (int i = 0; i < body_.joint_count(); ++i) {
      const JointAxis& joint = body_.table().joints[i];
      pose.theta[i] = 0.5 * (joint.min_rad + joint.max_rad);
    }
    return pose;
  }

  // Measures all 23 points of a true pose.
  PoseFilter::Linearize PointsOf(const PoseState& truth, double std_mm) const {
    return Measuring(body_.PointsAt(body_.PostureAt(truth)), std_mm);
  }
  // νᵀS⁻¹ν of points that are measured with this error.
  double SquaredInnovation(const PoseFilter& filter, const BodyPoints& measured_W,
                           double std_mm) const {
    const Posture posture = body_.PostureAt(filter.pose());
    const BodyPoints points_W = body_.PointsAt(posture);
    Eigen::MatrixXd J(3 * kPointCount, body_.dof());
    for (int i = 0; i < kPointCount; ++i) {
      Eigen::Matrix<double, 3, Eigen::Dynamic> J_point(3, body_.dof());
      body_.PointJacobian(posture, body_.CarrierOf(static_cast<Point>(i)), points_W.col(i),
                          J_point);
      J.middleRows<3>(3 * i) = J_point;
    }
    Eigen::MatrixXd S = J * filter.covariance() * J.transpose();
    S.diagonal().array() += std_mm * std_mm;
    const Eigen::VectorXd innovation = (measured_W - points_W).reshaped();
    return innovation.dot(S.llt().solve(innovation));
  }
  // What an update must not take: no number at all.
  static PoseFilter::Linearize Nonsense() {
    return [](const PoseState& pose, UpdateEquations& equations) {
      PoseStep J = PoseStep::Ones(pose.dof());
      equations.Add(J, std::numeric_limits<double>::quiet_NaN(), 1);
    };
  }
  PoseFilter::Linearize Measuring(const BodyPoints& measured_W, double std_mm) const {
    return [this, measured_W, std_mm](const PoseState& pose, UpdateEquations& equations) {
      const Posture posture = body_.PostureAt(pose);
      const BodyPoints points_W = body_.PointsAt(posture);
      Eigen::Matrix<double, 3, Eigen::Dynamic> J(3, body_.dof());
      for (int i = 0; i < kPointCount; ++i) {
        body_.PointJacobian(posture, body_.CarrierOf(static_cast<Point>(i)), points_W.col(i), J);
        equations.AddPoint(J, measured_W.col(i) - points_W.col(i), std_mm * std_mm);
      }
    };
  }

  BodyModel body_{LoadBodyTable("mikic2003"), AverageSizes(1750)};
};

TEST_F(Filter, DrawsThePoseToWhereAnUpdateMovesIt) {
  PoseState truth = Upright();
  truth.X_WT.p += Vector3(30, -40, 20);
  truth.theta.array() += 0.1;
  PoseFilter updated{MotionNoise{}};
  updated.Reset(Upright(), 200, 1);
  PoseFilter drawn = updated;
  const PoseCovariance before = drawn.covariance();
  updated.Update(PointsOf(truth, 1), {5, 5});
  drawn.Draw(PointsOf(truth, 1), {5, 5});
  EXPECT_EQ(drawn.pose().X_WT.p, updated.pose().X_WT.p);
  EXPECT_EQ(drawn.pose().theta, updated.pose().theta);
  EXPECT_EQ(drawn.covariance(), before);
}

TEST_F(Filter, FindsThePoseWhosePointsWereMeasured) {
  PoseState truth = Upright();
  truth.X_WT.R = ExpRotation(Vector3(0.1, -0.2, 0.4));
  truth.X_WT.p += Vector3(30, -40, 20);
  truth.theta.array() += 0.15;
  PoseFilter filter{MotionNoise{}};
  filter.Reset(Upright(), 200, 1);
  filter.Update(PointsOf(truth, 1), {8, 8});
  EXPECT_NEAR(filter.pose().Minus(truth).norm(), 0, 0.05);
}

TEST_F(Filter, AMeasurementThatIsNoNumberLosesTheTrackAndLeavesThePose) {
  PoseFilter filter{MotionNoise{}};
  filter.Reset(Upright(), 50, 0.3);
  EXPECT_TRUE(filter.is_sound());
  filter.Update(Nonsense(), Iterations{});
  EXPECT_FALSE(filter.is_sound());
  EXPECT_TRUE(filter.pose().IsFinite());
  filter.Draw(Nonsense(), Iterations{});
  EXPECT_FALSE(filter.is_sound());
  EXPECT_TRUE(filter.pose().IsFinite());
  filter.Update(PointsOf(Upright(), 10), Iterations{});
  EXPECT_TRUE(filter.is_sound());
}

TEST_F(Filter, FollowsAConstantMotionWithoutLag) {
  constexpr double kFrameS = 1.0 / 30;
  constexpr double kSpeed = 1500;  // mm/s
  PoseState truth = Upright();
  PoseFilter filter{MotionNoise{}};
  filter.Reset(truth, 50, 0.3);
  for (int frame = 0; frame < 30; ++frame) {
    truth.X_WT.p.x() += kSpeed * kFrameS;
    filter.Predict(kFrameS);
    filter.Update(PointsOf(truth, 10), {3, 3});
  }
  filter.Predict(kFrameS);
  const double predicted = filter.pose().X_WT.p.x() - truth.X_WT.p.x();
  EXPECT_GT(predicted, 0.8 * kSpeed * kFrameS);
  EXPECT_LT(predicted, 1.1 * kSpeed * kFrameS);
}

TEST_F(Filter, PredictsInTwoStepsWhatItPredictsInOne) {
  PoseState truth = Upright();
  PoseFilter once{MotionNoise{}};
  once.Reset(truth, 50, 0.3);
  for (int frame = 0; frame < 5; ++frame) {
    truth.X_WT.p.x() += 30;
    once.Predict(1.0 / 30);
    once.Update(PointsOf(truth, 10), {3, 3});
  }
  PoseFilter twice = once;
  once.Predict(0.1);
  twice.Predict(0.03);
  twice.Predict(0.07);
  EXPECT_LT((once.covariance() - twice.covariance()).norm(), 1e-9 * once.covariance().norm());
  EXPECT_LT(once.pose().Minus(twice.pose()).norm(), 1e-6);
}

// Bar-Shalom, Li and Kirubarajan 2001, §5.4: the squares of a filter's innovations, normalized by
// their covariance, add up to a chi-square variable.
TEST_F(Filter, ForeseesHowFarMeasurementsWillBeOff) {
  constexpr double kFrameS = 1.0 / 30;
  constexpr double kStdMm = 15;
  constexpr int kFrames = 60;
  const MotionNoise noise{.translation_mm = 1500, .rotation_rad = 2, .joint_rad = 2};
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  PoseState truth = Upright();
  PoseStep velocity = PoseStep::Zero(body_.dof());
  PoseFilter filter(noise);
  filter.Reset(truth, 20, 0.1);
  const double decay = std::exp(-kFrameS / noise.velocity_decay_s);
  double sum = 0;
  for (int frame = 0; frame < kFrames; ++frame) {
    constexpr int kSubsteps = 20;
    for (int i = 0; i < kSubsteps; ++i) {
      for (int row = 0; row < body_.dof(); ++row) {
        const double density = row < 3           ? noise.translation_mm
                               : row < kTorsoDof ? noise.rotation_rad
                                                 : noise.joint_rad;
        velocity[row] += density * std::sqrt(kFrameS / kSubsteps) * normal(random);
      }
      velocity *= std::pow(decay, 1.0 / kSubsteps);
      truth.Add(velocity * (kFrameS / kSubsteps));
    }
    filter.Predict(kFrameS);
    BodyPoints measured_W = body_.PointsAt(body_.PostureAt(truth));
    for (double& coordinate : measured_W.reshaped()) coordinate += kStdMm * normal(random);
    sum += SquaredInnovation(filter, measured_W, kStdMm);
    filter.Update(Measuring(measured_W, kStdMm), {3, 3});
  }
  constexpr double kFreedom = 3.0 * kPointCount * kFrames;
  EXPECT_NEAR(sum, kFreedom, 3.3 * std::sqrt(2 * kFreedom));  // 99.9 %
}

TEST_F(Filter, KeepsItsCovarianceSymmetricAndPositiveOverHours) {
  PoseFilter filter{MotionNoise{}};
  filter.Reset(Upright(), 50, 0.3);
  for (int frame = 0; frame < 20000; ++frame) {
    filter.Predict(frame % 7 == 0 ? 0.2 : 1.0 / 30);
    if (frame % 3 != 0) filter.Update(PointsOf(Upright(), 5), {1, 1});
  }
  const PoseCovariance& P = filter.covariance();
  EXPECT_EQ((P - P.transpose()).norm(), 0);
  EXPECT_GT(Eigen::SelfAdjointEigenSolver<PoseCovariance>(P).eigenvalues().minCoeff(), 0);
}

TEST_F(Filter, HoldsAJointAtItsLimitAndMovesTheRest) {
  PoseState beyond = Upright();
  const int knee = 15 - 1;
  int row = -1;
  for (int i = 0; i < body_.joint_count(); ++i) {
    if (body_.table().joints[i].paper_angle == knee + 1) row = i;
  }
  ASSERT_GE(row, 0);
  beyond.theta[row] = body_.table().joints[row].min_rad - 0.5;  // a knee that bends forward
  PoseFilter filter{MotionNoise{}};
  PoseState start = beyond;
  start.theta[row] = 0.2;
  filter.Reset(start, 200, 1);
  const PoseFilter::Linearize points = PointsOf(beyond, 20);
  filter.Update(
      [&](const PoseState& pose, UpdateEquations& equations) {
        points(pose, equations);
        LinearizeJoints(body_.table(), pose, equations);
      },
      {10, 10});
  EXPECT_GT(filter.pose().theta[row], body_.table().joints[row].min_rad - 0.05);
}

TEST_F(Filter, GoesOnWhileItGoesFar) {
  PoseState far = Upright();
  far.X_WT.p += Vector3(400, 0, 0);
  far.theta.array() += 0.5;
  const auto calls = [&](const PoseState& truth, const Iterations& iterations) {
    PoseFilter filter{MotionNoise{}};
    filter.Reset(Upright(), 500, 1);
    int count = 0;
    const PoseFilter::Linearize points = PointsOf(truth, 1);
    filter.Update(
        [&](const PoseState& pose, UpdateEquations& equations) {
          ++count;
          points(pose, equations);
        },
        iterations);
    return count;
  };
  EXPECT_EQ(calls(far, {1, 1}), 1);
  EXPECT_GT(calls(far, {1, 9}), 1);
  EXPECT_LT(calls(far, {1, 9}), 9) << "it has come to rest";
  EXPECT_EQ(calls(Upright(), {1, 9}), 1);
}

TEST_F(Filter, LearnsNothingFromNoMeasurement) {
  PoseFilter filter{MotionNoise{}};
  filter.Reset(Upright(), 50, 0.3);
  const PoseCovariance before = filter.covariance();
  filter.Update([](const PoseState&, UpdateEquations&) {}, {2, 2});
  EXPECT_NEAR((filter.covariance() - before).norm() / before.norm(), 0, 1e-9);
  EXPECT_NEAR(filter.pose().Minus(Upright()).norm(), 0, 1e-9);
}

}  // namespace
}  // namespace mocap
