#include "core/people/people_capture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "tests/support/room.h"

namespace mocap {
namespace {

TEST_F(Room, WhoIsAloneIsFollowedAsIfNobodyElseCouldBeThere) {
  const std::unique_ptr<MotionCapture> alone = Make();
  for (int frame = 0; frame < 5; ++frame) {
    const auto seen = Carve({At(10.0 * frame, 0, 1750, frame)});
    See(seen);
    const CaptureResult& result = alone->Update({seen.hull, seen.outlines}, now_ns_);
    EXPECT_EQ(people_.first().result().state, result.state);
    EXPECT_EQ(people_.first().result().points_W, result.points_W);
    EXPECT_EQ(people_.first().result().voxels, result.voxels);
  }
  EXPECT_EQ(Ids(), std::vector{1});
}

TEST_F(Room, TwoPeopleAreFoundAndFollowedPastEachOther) {
  std::map<int, double> y_before;
  for (int frame = 0; frame < 12; ++frame) {
    const double way_mm = 100.0 * frame;
    const Someone tall = At(-280, -550 + way_mm, 1850, frame);
    const Someone small = At(280, 550 - way_mm, 1600, frame);
    See({tall, small});
    // Tracking begins when the stature is steady, or after six sets.
    if (frame < 5) continue;
    EXPECT_EQ(Ids(), (std::vector{1, 2}));
    EXPECT_LT(ErrorOf(tall), 45) << frame;
    EXPECT_LT(ErrorOf(small), 45) << frame;
    for (const PersonView& view : people_.people()) {
      const double y_mm = view.capture->result().pose.X_WT.p.y();
      const auto [before, is_new] = y_before.try_emplace(view.id, y_mm);
      EXPECT_LT(std::abs(y_mm - before->second), 200);
      before->second = y_mm;
    }
  }
}

TEST_F(Room, WhoComesGetsANumberOfHisOwnAndWhoLeavesIsForgottenAfterASecond) {
  const Someone stays = At(-600, 0, 1750), passes = At(700, 200, 1700);
  const auto one = Carve({stays}), two = Carve({stays, passes});
  for (int i = 0; i < 4; ++i) See(one);
  for (int i = 0; i < 8; ++i) See(two);
  EXPECT_EQ(Ids(), (std::vector{1, 2}));
  EXPECT_LT(ErrorOf(passes), 40);
  EXPECT_LT(ErrorOf(stays), 40);
  for (int i = 0; i < 25; ++i) See(one);
  EXPECT_EQ(Ids(), (std::vector{1, 2}));
  for (int i = 0; i < 10; ++i) See(one);
  EXPECT_EQ(Ids(), std::vector{1});
  for (int i = 0; i < 8; ++i) See(two);
  EXPECT_EQ(Ids(), (std::vector{1, 3}));
}

TEST_F(Room, FleshThatNoCameraShowsByItselfIsNobody) {
  const Someone person = At(-600, 0, 1750);
  RoundStudio::CarvedBody seen = Carve({person, At(800, 300, 1700)});
  const auto real = Carve({person});
  for (int i = 0; i < 4; ++i) See(real);
  // The flesh of two, and the outlines of one.
  seen.outlines = real.outlines;
  for (int i = 0; i < 15; ++i) See(seen);
  EXPECT_EQ(Ids(), std::vector{1});
  EXPECT_LT(ErrorOf(person), 40);
}

class WideRoom : public Room {
 protected:
  WideRoom() : Room(4, nullptr, 4500) {}
};

TEST_F(WideRoom, WhoAppearsInTheMiddleIsNobodyForASecond) {
  const Someone stays = At(-900, 0, 1600), appears = At(50, 0, 1300);
  const auto one = Carve({stays}), two = Carve({stays, appears});
  for (int i = 0; i < 40; ++i) See(one);
  for (int i = 0; i < 29; ++i) See(two);
  EXPECT_EQ(Ids(), std::vector{1});
  for (int i = 0; i < 6; ++i) See(two);
  EXPECT_EQ(Ids(), (std::vector{1, 2}));
  EXPECT_LT(ErrorOf(appears), 40);
}

TEST_F(Room, WhoComesInIsFoundBeforeEnoughCamerasHaveAllOfHim) {
  const Someone stays = At(-600, 0, 1750), comes = At(1650, 0, 1700);
  const auto one = Carve({stays}), two = Carve({stays, comes});
  const Eigen::AlignedBox3d comes_W(Vector3(1450, -200, 0), Vector3(1850, 200, 1700));
  const auto has_all = [&](const CameraEye& eye) { return eye.SeesAllWithin(comes_W); };
  ASSERT_LT(std::ranges::count_if(eyes_, has_all), 4);
  for (int i = 0; i < 40; ++i) See(one);
  for (int i = 0; i < 20; ++i) See(two);
  EXPECT_EQ(Ids(), (std::vector{1, 2}));
  EXPECT_LT(ErrorOf(comes), 60);
}

TEST_F(Room, TheSamePeopleGiveTheSameNumbersAgain) {
  PeopleCapture again([this] { return Make(); }, {.most = 4});
  for (int frame = 0; frame < 5; ++frame) {
    const auto seen = Carve({At(-500, 0, 1800, frame), At(500, 0, 1650, frame)});
    See(seen);
    again.Update({seen.hull, seen.outlines}, eyes_, now_ns_);
    ASSERT_EQ(again.people().size(), people_.people().size());
    for (std::size_t i = 0; i < again.people().size(); ++i)
      EXPECT_EQ(again.people()[i].capture->result().points_W,
                people_.people()[i].capture->result().points_W);
  }
}

TEST_F(Room, ANameStaysWithAPersonUntilHeLeaves) {
  const Someone stays = At(-600, 0, 1750), passes = At(700, 200, 1700);
  const auto one = Carve({stays}), two = Carve({stays, passes});
  for (int i = 0; i < 8; ++i) See(two);
  ASSERT_EQ(Ids(), (std::vector{1, 2}));
  people_.Call(2, "anna");
  people_.Call(7, "nobody");
  See(two);
  EXPECT_EQ(people_.people()[0].name, "");
  EXPECT_EQ(people_.people()[1].name, "anna");
  for (int i = 0; i < 40; ++i) See(one);
  for (int i = 0; i < 8; ++i) See(two);
  ASSERT_EQ(people_.people().size(), 2u);
  EXPECT_EQ(people_.people()[1].name, "") << "somebody else may have come";
}

TEST_F(Room, WhoIsExpectedHasTheName) {
  const auto seen = Carve({At(-500, 0, 1800)});
  people_.Expect(AverageSizes(1800), "anna");
  for (int i = 0; i < 4; ++i) See(seen);
  ASSERT_EQ(people_.people().size(), 1u);
  EXPECT_EQ(people_.people()[0].name, "anna");
  people_.Forget();
  for (int i = 0; i < 4; ++i) See(seen);
  ASSERT_EQ(people_.people().size(), 1u);
  EXPECT_EQ(people_.people()[0].name, "");
}

TEST_F(Room, WhoIsKnownBySizesHasTheNameOnceMeasured) {
  std::vector<RoundStudio::CarvedBody> walk;
  for (int i = 0; i < 8; ++i) walk.push_back(Carve({At(-500, 0, 1800, i), At(500, 200, 1650, i)}));
  const auto see_walk = [&] {
    for (int i = 0; i < 24; ++i) See(walk[static_cast<std::size_t>(i % 8)]);
  };
  see_walk();
  ASSERT_EQ(Ids(), (std::vector{1, 2}));
  const auto sizes_of = [this](std::size_t i) {
    return people_.people()[i].capture->body().sizes();
  };
  const BodySizes sizes = sizes_of(sizes_of(0).Stature() < 1725 ? 0 : 1);
  people_.Forget();
  people_.Know({{"anna", sizes}, {"bertil", AverageSizes(1950)}});
  see_walk();
  ASSERT_EQ(people_.people().size(), 2u);
  for (const PersonView& person : people_.people()) {
    const bool is_anna = person.capture->body().sizes().Stature() < 1725;
    EXPECT_EQ(person.name, is_anna ? "anna" : "");
    if (!is_anna) continue;
    EXPECT_GE(person.certainty, kSureOfName);
    EXPECT_LT(person.certainty, 1);
  }
}

TEST_F(Room, OfTwoWhoAreAlikeOneHasTheName) {
  const auto twins = Carve({At(-500, 0, 1700), At(500, 200, 1700)});
  for (int i = 0; i < 8; ++i) See(twins);
  ASSERT_EQ(people_.people().size(), 2u);
  const BodySizes sizes = people_.first().body().sizes();
  people_.Forget();
  people_.Know({{"anna", sizes}});
  for (int i = 0; i < 24; ++i) See(twins);
  ASSERT_EQ(people_.people().size(), 2u);
  EXPECT_NE(people_.people()[0].name == "anna", people_.people()[1].name == "anna");
}

TEST_F(Room, ForgettingForgetsEverybody) {
  const auto seen = Carve({At(-500, 0, 1800), At(500, 0, 1650)});
  for (int i = 0; i < 4; ++i) See(seen);
  people_.Forget();
  EXPECT_TRUE(people_.people().empty());
  EXPECT_EQ(people_.first().result().state, CaptureState::kSearching);
  for (int i = 0; i < 4; ++i) See(seen);
  EXPECT_EQ(Ids(), (std::vector{3, 4}));
}

TEST_F(RoomWithSide, WhoComesIsLookedForBesideWhoIsFollowed) {
  const auto one = Carve({stays_}), two = Carve({stays_, comes_});
  for (int i = 0; i < 4; ++i) See(one);
  EXPECT_TRUE(desk_.empty());
  for (int i = 0; i < 6; ++i) {
    See(two);
    EXPECT_FALSE(desk_.empty());
    EXPECT_EQ(Ids(), std::vector{1});
    EXPECT_LT(ErrorOf(stays_), 40);
  }
  desk_.DoAll();
  See(two);
  EXPECT_EQ(Ids(), (std::vector{1, 2}));
  EXPECT_LT(ErrorOf(comes_), 40);
  for (int i = 0; i < 3; ++i) See(two);
  EXPECT_TRUE(desk_.empty());
}

TEST_F(RoomWithSide, WhoIsFollowedAlreadyIsFollowedTheSameWay) {
  PeopleCapture plain([this] { return Make(); }, {.most = 4});
  for (int frame = 0; frame < 12; ++frame) {
    const auto seen =
        frame < 4 ? Carve({At(-600, 0, 1750, frame)}) : Carve({At(-600, 0, 1750, frame), comes_});
    See(seen);
    plain.Update({seen.hull, seen.outlines}, eyes_, now_ns_);
    if (frame < 5) {
      EXPECT_EQ(plain.first().result().points_W, people_.first().result().points_W);
    }
    desk_.DoAll();
  }
  EXPECT_EQ(plain.people().size(), 2u);
  EXPECT_EQ(people_.people().size(), 2u);
}

TEST_F(RoomWithSide, WhoLeavesBeforeHeIsFoundIsNobody) {
  const auto one = Carve({stays_}), two = Carve({stays_, comes_});
  for (int i = 0; i < 4; ++i) See(one);
  for (int i = 0; i < 3; ++i) See(two);
  for (int i = 0; i < 12; ++i) See(one);
  desk_.DoAll();
  for (int i = 0; i < 3; ++i) See(one);
  EXPECT_EQ(Ids(), std::vector{1});
}

TEST_F(RoomWithSide, WhoeverIsForgottenWhileLookedForIsLookedForAnew) {
  const auto two = Carve({stays_, comes_});
  for (int i = 0; i < 4; ++i) See(Carve({stays_}));
  for (int i = 0; i < 3; ++i) See(two);
  people_.Forget();
  EXPECT_EQ(people_.first().result().state, CaptureState::kSearching);
  desk_.DoAll();
  for (int i = 0; i < 6; ++i) {
    See(two);
    desk_.DoAll();
  }
  EXPECT_EQ(people_.people().size(), 2u);
}

TEST_F(RoomWithSide, MayGoWhileSomebodyIsLookedFor) {
  {
    PeopleCapture brief([this] { return Make(); }, {.most = 4, .side = &desk_});
    const auto one = Carve({stays_}), two = Carve({stays_, comes_});
    for (int i = 0; i < 6; ++i) {
      const auto& seen = i < 4 ? one : two;
      brief.Update({seen.hull, seen.outlines}, eyes_, now_ns_ += kFrameNs);
    }
  }
  EXPECT_FALSE(desk_.empty());
  desk_.DoAll();
}

class RoomForOne : public Room {
 protected:
  RoomForOne() : Room(1) {}
};

TEST_F(RoomForOne, IsNeverShared) {
  const auto seen = Carve({At(-600, 0, 1800), At(600, 0, 1650)});
  for (int i = 0; i < 4; ++i) See(seen);
  EXPECT_LE(people_.people().size(), 1u);
}

}  // namespace
}  // namespace mocap
