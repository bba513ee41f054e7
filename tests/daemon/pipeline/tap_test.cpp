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

TEST(Tap, GoesOnHandingOverWhileItIsHeld) {
  Doorbell bell;
  Tap<int> tap;
  tap.Open(4, 0, bell);
  tap.Hold(true);
  EXPECT_TRUE(Offer(tap, 1));
  EXPECT_TRUE(Offer(tap, 2));
  EXPECT_TRUE(tap.is_held()) << "whoever takes out is told to wait";
  EXPECT_EQ(tap.queue().dropped(), 0);
  ASSERT_TRUE(tap.queue().TryPop());
  EXPECT_EQ(tap.queue().front(), 1);
}

TEST(Tap, CountsAnewOnceItIsOpenedAgain) {
  Doorbell bell;
  Tap<int> tap;
  tap.Open(1, 0, bell);
  EXPECT_TRUE(Offer(tap, 1));
  EXPECT_TRUE(Offer(tap, 2));
  EXPECT_EQ(tap.queue().dropped(), 1);
  tap.Close();
  tap.Open(1, 0, bell);
  EXPECT_EQ(tap.queue().dropped(), 0);
  EXPECT_EQ(tap.queue().pushed(), 0);
}

}  // namespace
}  // namespace mocap
