#include "core/reconstruction/empty_room/furniture_watch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/core/reconstruction/empty_room/walked_room.h"

namespace mocap {
namespace {

using ::testing::IsEmpty;
using testing::RoomPainter;
using ::testing::SizeIs;
using testing::SmoothWall;
using testing::Walker;

constexpr std::int64_t kLookNs = 2'000'000'000;
constexpr int kSmallest_px = 50;
constexpr PixelBox kChair{32, 24, 47, 47};

bool IsIn(const PixelBox& box, int x, int y) {
  return x >= box.left && x <= box.right && y >= box.top && y <= box.bottom;
}

/// Looks every two seconds. @return  what stands there at last.
std::vector<StillThing> LookAt(FurnitureWatch& watch, const RoomPainter& paint, int looks,
                               int first = 0) {
  std::vector<StillThing> things;
  for (int i = first; i < first + looks; ++i)
    things = watch.Add(testing::RoomPicture(i, paint, 1 + 0.02 * (i % 3)).view(), i * kLookNs);
  return things;
}

/// A chair, behind whoever walks by.
Bgr ChairBehindWalker(int picture, int x, int y, const Bgr& wall) {
  const Bgr seen = Walker(picture, x, y, wall);
  return seen == wall && IsIn(kChair, x, y) ? Bgr{40, 60, 210} : seen;
}

TEST(FurnitureWatch, NamesAChairAfterAMinuteAlthoughSomebodyWalksBeforeIt) {
  FurnitureWatch watch({SmoothWall(), {}}, kSmallest_px);
  EXPECT_THAT(LookAt(watch, Walker, 10), IsEmpty());
  EXPECT_THAT(LookAt(watch, ChairBehindWalker, 20, 10), IsEmpty());
  const std::vector<StillThing> things = LookAt(watch, ChairBehindWalker, 40, 30);
  ASSERT_THAT(things, SizeIs(1));
  EXPECT_NEAR(things[0].box.left, kChair.left, TileGrid::kTile_px);
  EXPECT_NEAR(things[0].box.bottom, kChair.bottom, TileGrid::kTile_px);
  EXPECT_NEAR(things[0].area_px, 16 * 24, 120);
  EXPECT_NEAR(static_cast<double>(things[0].since_ns), 10.0 * kLookNs, 8.0 * kLookNs);
}

TEST(FurnitureWatch, SomebodyWhoSitsThereSwayingIsNone) {
  const auto sitter = [](int picture, int x, int y, const Bgr& wall) {
    const int sway = picture * 7 % 5 - 2;
    return IsIn(kChair, x - sway, y) ? Bgr{40, 60, 210} : wall;
  };
  FurnitureWatch watch({SmoothWall(), {}}, kSmallest_px);
  EXPECT_THAT(LookAt(watch, sitter, 90), IsEmpty());
}

TEST(FurnitureWatch, TheEmptyRoomAndWhatIsUnknownOfItHaveNone) {
  EarlierRoom room{SmoothWall(), Silhouette(testing::kRoomWidth, testing::kRoomHeight)};
  for (int y = kChair.top; y <= kChair.bottom; ++y)
    for (int x = kChair.left; x <= kChair.right; ++x) room.unseen.Set(x, y);
  FurnitureWatch watch(room, kSmallest_px);
  EXPECT_THAT(LookAt(watch, ChairBehindWalker, 60), IsEmpty());
}

TEST(FurnitureWatch, WhatWasTakenAwayIsForgotten) {
  FurnitureWatch watch({SmoothWall(), {}}, kSmallest_px);
  ASSERT_THAT(LookAt(watch, ChairBehindWalker, 60), SizeIs(1));
  EXPECT_THAT(LookAt(watch, Walker, 10, 60), IsEmpty());
}

}  // namespace
}  // namespace mocap
