#include "daemon/pipeline/tap.h"

#include <gtest/gtest.h>

namespace mocap {
namespace {

bool Offer(Tap<int>& tap, int value) {
  bool was_filled = false;
  tap.Offer([&](int& item) {
    item = value;
    return was_filled = true;
  });
  return was_filled;
}

TEST(Tap, HandsOverNothingWhileItIsHeldAndCountsThat) {
  Doorbell bell;
  Tap<int> tap;
  tap.Open(4, 0, bell);
  EXPECT_TRUE(Offer(tap, 1));
  tap.Hold(true);
  EXPECT_FALSE(Offer(tap, 2));
  EXPECT_FALSE(Offer(tap, 3));
  tap.Hold(false);
  EXPECT_TRUE(Offer(tap, 4));
  EXPECT_EQ(tap.held_back(), 2);
  ASSERT_TRUE(tap.queue().TryPop());
  EXPECT_EQ(tap.queue().front(), 1);
  ASSERT_TRUE(tap.queue().TryPop());
  EXPECT_EQ(tap.queue().front(), 4);
  EXPECT_FALSE(tap.queue().TryPop());
}

TEST(Tap, CountsAnewOnceItIsOpenedAgain) {
  Doorbell bell;
  Tap<int> tap;
  tap.Open(4, 0, bell);
  tap.Hold(true);
  EXPECT_FALSE(Offer(tap, 1));
  tap.Close();
  tap.Open(4, 0, bell);
  EXPECT_EQ(tap.held_back(), 0);
  tap.Hold(false);
  EXPECT_TRUE(Offer(tap, 2));
}

}  // namespace
}  // namespace mocap
