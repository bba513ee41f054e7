#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "tests/support/room.h"

namespace mocap {
namespace {

constexpr std::int64_t kOneSecondNs = 1'000'000'000;

// In these tests nothing is ever done at the desk: a busy computer may leave no time for it.
class RoomOfABusyComputer : public RoomWithSide {
 protected:
  void See(const RoundStudio::CarvedBody& seen, int sets) {
    for (int i = 0; i < sets; ++i) Room::See(seen);
  }
};

TEST_F(RoomOfABusyComputer, FindsWhoMovedDuringAGap) {
  See(Carve({stays_}), 4);
  now_ns_ += 3 * kOneSecondNs;
  See(Carve({comes_}), 36);
  EXPECT_LT(ErrorOf(comes_), 45);
}

TEST_F(RoomOfABusyComputer, FindsAllWhoMovedDuringAGap) {
  const Someone third = At(500, -900, 1800);
  See(Carve({stays_}), 4);
  now_ns_ += 3 * kOneSecondNs;
  See(Carve({comes_, third}), 36);
  EXPECT_LT(ErrorOf(comes_), 45);
  EXPECT_LT(ErrorOf(third), 45);
}

TEST_F(RoomOfABusyComputer, FindsWhoeverIsLeftWhenTheOneWhoWasFollowedGoes) {
  See(Carve({stays_}), 4);
  See(Carve({stays_, comes_}), 4);
  EXPECT_FALSE(desk_.empty());
  See(Carve({comes_}), 36);
  EXPECT_LT(ErrorOf(comes_), 45);
}

TEST_F(RoomOfABusyComputer, StillExpectsTheGivenSizesAfterAGap) {
  people_.Expect(comes_.body.sizes(), "anna");
  See(Carve({At(-600, 0, 1700)}), 4);
  now_ns_ += 3 * kOneSecondNs;
  See(Carve({comes_}), 36);
  ASSERT_EQ(people_.people().size(), 1u);
  EXPECT_EQ(people_.people()[0].name, "anna");
  EXPECT_EQ(people_.first().body().sizes(), comes_.body.sizes());
}

// The person turns up elsewhere after each gap, and some cameras are missing.
TEST_F(RoomOfABusyComputer, FollowsSomebodyAgainAfterAnyLosses) {
  std::mt19937 random(7);
  const auto walker_at = [this](std::size_t place) {
    const double angle = static_cast<double>(place);
    return At(900 * std::cos(angle), 900 * std::sin(angle), 1750);
  };
  std::vector<RoundStudio::CarvedBody> walk;
  for (std::size_t place = 0; place < 6; ++place) walk.push_back(Carve({walker_at(place)}));
  for (int trial = 0; trial < 4; ++trial) {
    for (int i = 0; i < 6; ++i) {
      now_ns_ += static_cast<std::int64_t>(random() % 50) * kFrameNs;
      RoundStudio::CarvedBody seen = walk[random() % walk.size()];
      for (Outline& outline : seen.outlines)
        if (random() % 3 == 0) outline.clear();
      See(seen, 1);
    }
    const std::size_t place = random() % walk.size();
    See(walk[place], 36);
    EXPECT_LT(ErrorOf(walker_at(place)), 45) << trial;
  }
}

TEST_F(Room, WhoIsThereAfterAShortGapIsTheSamePerson) {
  const auto seen = Carve({At(0, 0, 1750)}), moved = Carve({At(300, 0, 1750)});
  for (int i = 0; i < 4; ++i) See(seen);
  now_ns_ += 3 * kOneSecondNs;
  for (int i = 0; i < 4; ++i) See(moved);
  EXPECT_EQ(Ids(), std::vector{1});
}

// Two sets a second, as on a computer that is busy with other programs.
TEST_F(RoomOfABusyComputer, KeepsWhoWalksOnWhileSetsAreDropped) {
  See(Carve({At(-900, 0, 1750)}), 4);
  for (int i = 1; i < 4; ++i) {
    now_ns_ += kOneSecondNs / 2;
    See(Carve({At(-900 + 600 * i, 0, 1750, i)}), 4);
    EXPECT_EQ(Ids(), std::vector{1});
  }
  EXPECT_TRUE(desk_.empty());
}

TEST_F(Room, OneEmptySetAfterAGapForgetsNobody) {
  const auto seen = Carve({At(0, 0, 1750)});
  for (int i = 0; i < 4; ++i) See(seen);
  now_ns_ += 3 * kOneSecondNs;
  See(Carve({}));
  EXPECT_EQ(people_.first().result().state, CaptureState::kLost);
  for (int i = 0; i < 4; ++i) See(seen);
  EXPECT_EQ(Ids(), std::vector{1});
}

TEST_F(Room, WhoIsLostIsSearchedForAgainAfterAGap) {
  const auto seen = Carve({At(0, 0, 1750)});
  for (int i = 0; i < 4; ++i) See(seen);
  See(Carve({}));
  ASSERT_EQ(people_.first().result().state, CaptureState::kLost);
  now_ns_ += 3 * kOneSecondNs;
  RoundStudio::CarvedBody half = seen;
  for (Outline& outline : half.outlines) outline.clear();
  See(half);
  EXPECT_NE(people_.first().result().state, CaptureState::kSearching);
}

// Wide enough for people to appear inside it.
class RoomToAppearIn : public DeskFirst, public Room {
 protected:
  explicit RoomToAppearIn(int most = 4) : Room(most, &desk_, 4500) {}

  const Someone stays_ = At(-900, 0, 1600);
  const Someone appears_ = At(50, 0, 1300);
};

TEST_F(RoomToAppearIn, WhoIsSeenBeforeAndAfterAGapHasNotWaitedMeanwhile) {
  const auto one = Carve({stays_}), two = Carve({stays_, appears_});
  for (int i = 0; i < 40; ++i) See(one);
  See(two);
  now_ns_ += 2 * kOneSecondNs;
  See(two);
  EXPECT_TRUE(desk_.empty());
}

class SlowRoomForTwo : public RoomToAppearIn {
 protected:
  SlowRoomForTwo() : RoomToAppearIn(2) {}

  // At 3 Hz.
  void See(const RoundStudio::CarvedBody& seen, int sets) {
    for (int i = 0; i < sets; ++i) {
      now_ns_ += kOneSecondNs / 3 - kFrameNs;
      Room::See(seen);
    }
  }
};

TEST_F(SlowRoomForTwo, WhoVanishesBeforeHeIsFoundTakesNobodysPlace) {
  See(Carve({stays_}), 8);
  See(Carve({stays_, appears_}), 1);
  EXPECT_TRUE(desk_.empty());
  See(Carve({stays_}), 3);
  See(Carve({stays_, At(1000, 0, 1700)}), 9);
  EXPECT_FALSE(desk_.empty());
  EXPECT_EQ(Ids(), std::vector{1});
}

TEST_F(Room, WhoIsThereAfterALongGapIsMeasuredAnew) {
  const auto tall = Carve({At(0, 0, 1850)});
  for (int i = 0; i < 100; ++i) See(tall);
  people_.Call(1, "anna");
  now_ns_ += 600 * kOneSecondNs;
  const Someone child = At(100, 0, 1300);
  const auto small = Carve({child});
  for (int i = 0; i < 12; ++i) See(small);
  EXPECT_LT(ErrorOf(child), 45);
  EXPECT_EQ(Ids(), std::vector{2});
  EXPECT_EQ(people_.people()[0].name, "");
}

}  // namespace
}  // namespace mocap
