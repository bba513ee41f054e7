#include "core/body/chain_equations.h"

#include <gtest/gtest.h>

#include <random>

#include "config/load_config.h"

namespace mocap {
namespace {

Vector3 RandomVector(std::mt19937& random, double size) {
  std::uniform_real_distribution<double> unit(-size, size);
  return {unit(random), unit(random), unit(random)};
}

TEST(ChainEquations, AreTheSumsOfRowsOfTheJacobian) {
  std::mt19937 random(3);
  const BodyModel body(LoadBodyTable("full"), AverageSizes(1750));
  PoseState pose;
  pose.X_WT = {ExpRotation(RandomVector(random, 1)), RandomVector(random, 1000)};
  pose.theta.resize(body.joint_count());
  for (double& angle : pose.theta) angle = RandomVector(random, 0.7).x();
  const Posture posture = body.PostureAt(pose);

  ChainEquations chain;
  chain.Reset(body.table(), posture);
  UpdateEquations by_rows, by_chain;
  by_rows.Reset(body.dof());
  by_chain.Reset(body.dof());
  PoseStep row(body.dof());
  Eigen::Matrix<double, 3, Eigen::Dynamic> J(3, body.dof());
  for (int carrier = -1; carrier < body.joint_count(); ++carrier) {
    const Vector3 p_W = pose.X_WT.p + RandomVector(random, 500), n_W = RandomVector(random, 1);
    const double residual_mm = RandomVector(random, 30).x(), variance = 100 + 10 * carrier;
    body.DirectionalJacobian(posture, carrier, p_W, n_W, row);
    by_rows.Add(row, residual_mm, variance);
    chain.Add(carrier, p_W, n_W, residual_mm, variance);
    const Vector3 way_W = RandomVector(random, 30);
    body.PointJacobian(posture, carrier, p_W, J);
    by_rows.AddPoint(J, way_W, 2 * variance);
    chain.AddPoint(carrier, p_W, way_W, 2 * variance);
  }
  chain.AddTo(by_chain);

  const PoseCovariance wanted = by_rows.information();
  EXPECT_TRUE(by_chain.information().isApprox(wanted, 1e-12));
  EXPECT_TRUE(by_chain.gradient().isApprox(by_rows.gradient(), 1e-12));
}

}  // namespace
}  // namespace mocap
