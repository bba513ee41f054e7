#include "tools/view/refusals.h"

#include <gtest/gtest.h>

namespace mocap {
namespace {

TEST(Refusals, TheFirstIsToldAtOnceAndTheRestTogether) {
  Refusals refusals;
  EXPECT_EQ(refusals.Line(1), "");
  refusals.Add("a request");
  EXPECT_EQ(refusals.Line(1), "refused 1 × a request");
  for (int i = 0; i < 300; ++i) refusals.Add("a request");
  refusals.Add("a connection");
  EXPECT_EQ(refusals.Line(2), "");
  EXPECT_EQ(refusals.Line(1 + Refusals::kPeriodNs), "refused 1 × a connection, 300 × a request");
  EXPECT_EQ(refusals.Line(1 + 3 * Refusals::kPeriodNs), "");
}

}  // namespace
}  // namespace mocap
