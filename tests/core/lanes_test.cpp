#include "core/lanes.h"

#include <gtest/gtest.h>

namespace mocap {
namespace {

TEST(Lanes, AChoiceIsBitsInOrderAndBack) {
  for (unsigned bits = 0; bits < 256; ++bits) {
    const Ints choice = ChoiceOf(bits);
    for (int i = 0; i < kFloats; ++i) EXPECT_EQ(choice[i], (bits >> i & 1) != 0 ? -1 : 0);
    EXPECT_EQ(BitsOf(choice), bits);
  }
}

}  // namespace
}  // namespace mocap
