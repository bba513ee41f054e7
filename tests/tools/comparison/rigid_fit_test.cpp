#include "tools/comparison/rigid_fit.h"

#include <gtest/gtest.h>

#include <random>

namespace mocap {
namespace {

const RigidTransform kTurned{ExpRotation({0.4, -0.7, 1.9}), {812, -345, 120}};

std::vector<PlacePair> TurnedPlaces(int count) {
  std::mt19937 random(7);
  const auto number = [&] { return static_cast<double>(random() % 2000) - 1000; };
  std::vector<PlacePair> pairs;
  for (int i = 0; i < count; ++i) {
    const Vector3 place(number(), number(), number());
    pairs.push_back({place, kTurned * place});
  }
  return pairs;
}

TEST(RigidFit, FindsATransformExactly) {
  const auto X = FitRigid(TurnedPlaces(3));
  ASSERT_TRUE(X);
  EXPECT_LT((X->R - kTurned.R).norm(), 1e-12);
  EXPECT_LT((X->p - kTurned.p).norm(), 1e-9);
}

TEST(RigidFit, NeverMirrors) {
  std::vector<PlacePair> pairs = TurnedPlaces(10);
  for (PlacePair& pair : pairs) pair.other.x() *= -1;
  const auto X = FitRigid(pairs);
  ASSERT_TRUE(X);
  EXPECT_NEAR(X->R.determinant(), 1, 1e-12);
}

TEST(RigidFit, PlacesOnALineDoNotShowATurn) {
  std::vector<PlacePair> pairs;
  for (int i = 0; i < 10; ++i) pairs.push_back({Vector3(i, 2 * i, 0), Vector3(0, i, 2 * i)});
  EXPECT_FALSE(FitRigid(pairs));
  EXPECT_FALSE(FitRobustly(pairs));
}

TEST(RigidFit, AThirdOfOutliersDoesNotMoveTheRobustFit) {
  std::vector<PlacePair> pairs = TurnedPlaces(90);
  for (std::size_t i = 0; i < 30; ++i) pairs[i].own += Vector3(400, 300, -900);
  const auto fit = FitRobustly(pairs);
  ASSERT_TRUE(fit);
  EXPECT_LT((fit->X.p - kTurned.p).norm(), 0.1);
  EXPECT_GT((FitRigid(pairs)->p - kTurned.p).norm(), 100);
}

}  // namespace
}  // namespace mocap
