#include "core/reconstruction/empty_room/empty_room.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/reconstruction/empty_room/moved_things.h"
#include "core/reconstruction/empty_room/stayed_people.h"
#include "core/reconstruction/empty_room/tile_groups.h"
#include "tests/core/reconstruction/empty_room/walked_room.h"

namespace mocap {
namespace {

using testing::ColorsOf;
using testing::kRoomHeight;
using testing::kRoomWidth;
using testing::LargestDifference;
using testing::RoomPictures;
using testing::SmoothWall;
using testing::Walker;
using Place = EmptyRoom::Place;

/// A box in which something is shown instead of what else is there.
testing::RoomPainter WithBox(const PixelBox& box, const testing::RoomPainter& inside,
                             const testing::RoomPainter& outside = Walker) {
  return [=](int picture, int x, int y, const Bgr& wall) {
    const bool is_inside = x >= box.left && x <= box.right && y >= box.top && y <= box.bottom;
    return (is_inside ? inside : outside)(picture, x, y, wall);
  };
}

/// A colour that is another one in every picture.
Bgr Unsteady(int picture, int, int, const Bgr&) {
  const auto value = static_cast<std::uint8_t>(10 + picture * 97 % 230);
  return {value, static_cast<std::uint8_t>(picture * 53 % 250), 128};
}

int WorstDifference(const EmptyRoom& room, const Image<Bgr>& wall) {
  int worst = 0;
  for (std::size_t i = 0; i < room.places.size(); ++i) {
    if (room.places[i] == Place::kUnseen) continue;
    worst = std::max(worst, LargestDifference(room.color.pixels()[i], wall.pixels()[i]));
  }
  return worst;
}

TEST(EmptyRoom, IsSeenBehindSomebodyWhoWalksInFlickeringLight) {
  const EmptyRoom room = FindEmptyRoom(ColorsOf(RoomPictures(Walker)), nullptr);
  EXPECT_EQ(room.ShareOf(Place::kUnseen), 0);
  EXPECT_LE(WorstDifference(room, SmoothWall()), 2);
}

TEST(EmptyRoom, AShadowThatLiesThereHalfOfTheTimeIsNotItsColour) {
  const auto shaded = [](int picture, int, int, const Bgr& wall) {
    const double light = picture % 9 < 5 ? 0.85 + 0.01 * (picture % 5) : 1;
    return Bgr{static_cast<std::uint8_t>(wall.b * light), static_cast<std::uint8_t>(wall.g * light),
               static_cast<std::uint8_t>(wall.r * light)};
  };
  const EmptyRoom room =
      FindEmptyRoom(ColorsOf(RoomPictures(WithBox({20, 20, 50, 50}, shaded))), nullptr);
  EXPECT_EQ(room.ShareOf(Place::kUnseen), 0);
  EXPECT_LE(WorstDifference(room, SmoothWall()), 3);
}

TEST(EmptyRoom, AShadowAsSoftAsTheNoiseDoesNotDarkenIt) {
  const auto shaded = [](int picture, int, int, const Bgr& wall) {
    const int by = picture % 9 < 4 ? 5 : 0;
    return Bgr{static_cast<std::uint8_t>(wall.b - by), static_cast<std::uint8_t>(wall.g - by),
               static_cast<std::uint8_t>(wall.r - by)};
  };
  const EmptyRoom room =
      FindEmptyRoom(ColorsOf(RoomPictures(WithBox({20, 20, 50, 50}, shaded))), nullptr);
  const Image<Bgr> wall = SmoothWall();
  double darker = 0;
  for (int y = 24; y < 47; ++y)
    for (int x = 24; x < 47; ++x) darker += (wall(x, y).g - room.color(x, y).g) / (23.0 * 23.0);
  EXPECT_LT(std::abs(darker), 0.5);
}

TEST(EmptyRoom, WhatNeverSettlesIsUnseen) {
  const EmptyRoom room =
      FindEmptyRoom(ColorsOf(RoomPictures(WithBox({20, 20, 50, 50}, Unsteady))), nullptr);
  // Means around two pixels at each side show it, too.
  constexpr double kBoxShare = 35.0 * 35 / (kRoomWidth * kRoomHeight);
  EXPECT_NEAR(room.ShareOf(Place::kUnseen), kBoxShare, 0.01);
  EXPECT_LE(WorstDifference(room, SmoothWall()), 4);
}

TEST(EmptyRoom, SomebodyWhoStaysForHalfOfTheTimeIsUnseenUnlessTheWallIsKnown) {
  const auto stays = [](int picture, int, int, const Bgr& wall) {
    return picture >= 30 ? Bgr{30, 160, 40} : wall;
  };
  const ShownColors shown = ColorsOf(RoomPictures(WithBox({20, 20, 50, 50}, stays)));
  const EmptyRoom unknown = FindEmptyRoom(shown, nullptr);
  EXPECT_EQ(unknown.places[35 * kRoomWidth + 35], Place::kUnseen);
  EXPECT_LE(WorstDifference(unknown, SmoothWall()), 3);
  const EarlierRoom wall{SmoothWall(), {}};
  const EmptyRoom known = FindEmptyRoom(shown, &wall);
  EXPECT_EQ(known.places[35 * kRoomWidth + 35], Place::kSeen);
  EXPECT_LE(LargestDifference(known.color(35, 35), wall.color(35, 35)), 2);
}

TEST(EmptyRoom, WhatWasUnknownBeforeIsSeenNowAndHasNotMoved) {
  EarlierRoom earlier{SmoothWall(), Silhouette(kRoomWidth, kRoomHeight)};
  for (int y = 20; y < 40; ++y) {
    for (int x = 20; x < 40; ++x) {
      earlier.unseen.Set(x, y);
      earlier.color(x, y) = {10, 220, 240};
    }
  }
  const EmptyRoom room = FindEmptyRoom(ColorsOf(RoomPictures(Walker)), &earlier);
  EXPECT_EQ(room.ShareOf(Place::kSeen), 1);
  EXPECT_LE(WorstDifference(room, SmoothWall()), 2);
}

/// Somebody in a striped shirt who stands there, swaying, on feet that stand still.
Bgr Swaying(int picture, int x, int y, const Bgr& wall) {
  const int sway = picture * 7 % 5, nod = picture / 5 * 2 % 5;
  const bool is_trunk = x >= 40 + sway && x < 60 + sway && y >= 6 + nod && y < 46 + nod;
  const bool is_feet = x >= 44 && x < 58 && y >= 50 && y < 53;
  if (!is_trunk && !is_feet) return wall;
  if (is_feet) return {20, 20, 25};
  return y / 9 % 2 == 0 ? Bgr{200, 60, 30} : Bgr{20, 160, 60};
}

TEST(StayedPeople, AreUnseenWithWhatSettlesWithinThemAndWithTheirFeet) {
  EmptyRoom room = FindEmptyRoom(ColorsOf(RoomPictures(Swaying)), nullptr);
  ASSERT_EQ(room.places[30 * kRoomWidth + 52], Place::kSeen) << "nothing settled within";
  HideStayedPeople(nullptr, 20, room);
  for (int y = 12; y < 53; ++y) {
    for (int x = 45; x < 58; ++x)
      ASSERT_EQ(room.places[y * kRoomWidth + x], Place::kUnseen) << x << " " << y;
  }
  EXPECT_LT(room.ShareOf(Place::kUnseen), 40.0 * 60 / (kRoomWidth * kRoomHeight));
  EXPECT_LE(WorstDifference(room, SmoothWall()), 10) << "a part of him is taken for a wall";
}

TEST(StayedPeople, AreNobodyWhereTooLittleIsUnseenOrTheWallIsKnown) {
  const ShownColors shown = ColorsOf(RoomPictures(Swaying));
  EmptyRoom room = FindEmptyRoom(shown, nullptr);
  const std::vector<Place> before = room.places;
  HideStayedPeople(nullptr, kRoomWidth * kRoomHeight, room);
  EXPECT_EQ(room.places, before);
  const EarlierRoom wall{SmoothWall(), {}};
  HideStayedPeople(&wall, 20, room);
  EXPECT_EQ(room.places, before);
}

TEST(MovedThings, AreNamedByTheirPlaceUnlessTheyAreTiny) {
  const auto chair = [](int, int, int, const Bgr&) { return Bgr{40, 60, 200}; };
  const PixelBox seat{24, 16, 47, 39}, speck{80, 50, 82, 52};
  const EarlierRoom wall{SmoothWall(), {}};
  EmptyRoom room =
      FindEmptyRoom(ColorsOf(RoomPictures(WithBox(seat, chair, WithBox(speck, chair)))), &wall);
  const std::vector<MovedThing> things = FindMoved(room, 50);
  ASSERT_EQ(things.size(), 1u);
  EXPECT_NEAR(things[0].box.left, seat.left, TileGrid::kTile_px);
  EXPECT_NEAR(things[0].box.top, seat.top, TileGrid::kTile_px);
  EXPECT_NEAR(things[0].box.right, seat.right, TileGrid::kTile_px);
  EXPECT_NEAR(things[0].box.bottom, seat.bottom, TileGrid::kTile_px);
  EXPECT_NEAR(things[0].area_px, 24 * 24, 100);
  EXPECT_EQ(room.places[20 * kRoomWidth + 30], Place::kMoved);
  room.ForgetMoved();
  EXPECT_EQ(room.places[20 * kRoomWidth + 30], Place::kUnseen);
  EXPECT_TRUE(FindMoved(room, 50).empty());
}

TEST(MovedThings, HaveWhatDiffersSlightlyBesideThem) {
  const auto darker = [](int by) {
    return [by](int, int, int, const Bgr& wall) {
      return Bgr{static_cast<std::uint8_t>(wall.b - by), static_cast<std::uint8_t>(wall.g - by),
                 static_cast<std::uint8_t>(wall.r - by)};
    };
  };
  const auto chair = [](int, int, int, const Bgr&) { return Bgr{40, 60, 200}; };
  const PixelBox seat{24, 16, 39, 31}, shadow{40, 16, 55, 31}, sunless{70, 40, 85, 55};
  const EarlierRoom wall{SmoothWall(), {}};
  const EmptyRoom room =
      FindEmptyRoom(ColorsOf(RoomPictures(WithBox(
                        seat, chair, WithBox(shadow, darker(12), WithBox(sunless, darker(12)))))),
                    &wall);
  EXPECT_EQ(room.places[22 * kRoomWidth + 48], Place::kMoved);
  EXPECT_EQ(room.places[48 * kRoomWidth + 78], Place::kSeen) << "light alone changed";
}

TEST(PictureSteadier, TellsTheLightOfEachPictureWhateverWalksThere) {
  PictureSteadier steadier;
  steadier.Steady(testing::RoomPicture(0, Walker).view());
  for (const double light : {0.8, 1.0, 1.1}) {
    const SteadyPicture steady = steadier.Steady(testing::RoomPicture(1, Walker, light).view());
    for (const double gain : steady.light) EXPECT_NEAR(gain, light, 0.01);
    EXPECT_LE(LargestDifference(steady.color(2, 3), SmoothWall()(2, 3)), 3);
  }
}

}  // namespace
}  // namespace mocap
