#include "core/acquisition/facing_duel.h"

#include <gtest/gtest.h>

namespace mocap {
namespace {

TEST(FacingDuel, IsDecidedBySomeFramesOfTheSameMind) {
  FacingDuel duel;
  for (int i = 0; i < 2; ++i) duel.Add(-3, 0.05);
  EXPECT_FALSE(duel.is_over());
  EXPECT_TRUE(duel.second_leads());
  for (int i = 0; i < 2; ++i) duel.Add(-3, 0.05);
  EXPECT_TRUE(duel.is_over());
}

TEST(FacingDuel, IsNeitherTurnedNorEndedByOneFrameAfterAGap) {
  FacingDuel duel;
  for (int i = 0; i < 4; ++i) duel.Add(0.5, 0.05);
  duel.Add(-0.2, 3);
  EXPECT_FALSE(duel.second_leads());
  EXPECT_FALSE(duel.is_over());
}

}  // namespace
}  // namespace mocap
