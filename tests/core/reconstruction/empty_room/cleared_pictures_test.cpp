#include "core/reconstruction/empty_room/cleared_pictures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/core/reconstruction/empty_room/walked_room.h"

namespace mocap {
namespace {

using testing::kRoomHeight;
using testing::kRoomPictures;
using testing::kRoomWidth;
using testing::RoomWall;
using Place = EmptyRoom::Place;

Bgr Wall(int, int, int, const Bgr& wall) { return wall; }

class ClearedRoom : public ::testing::Test {
 protected:
  /// All pictures, cleared.
  std::vector<Image<Bgr>> Clear(const EmptyRoom& room, const Image<Bgr>* filling = nullptr) const {
    ClearedPictures cleared(room, shown_.tolerance());
    std::vector<SteadyPicture> steady;
    PictureSteadier steadier;
    for (const Image<Bgr>& picture : pictures_) {
      steady.push_back(steadier.Steady(picture.view()));
      cleared.Note(picture.view(), steady.back());
    }
    std::vector<Image<Bgr>> all;
    for (std::size_t i = 0; i < pictures_.size(); ++i)
      all.push_back(cleared.Clear(pictures_[i].view(), steady[i], filling));
    return all;
  }

  const std::vector<Image<Bgr>> pictures_ = testing::RoomPictures(testing::Walker);
  const ShownColors shown_ = testing::ColorsOf(pictures_);
  EmptyRoom room_ = FindEmptyRoom(shown_, nullptr);
};

TEST_F(ClearedRoom, ShowsTheWallWithTheNoiseAndLightOfItsMoment) {
  const std::vector<Image<Bgr>> empty = testing::RoomPictures(Wall);
  const std::vector<Image<Bgr>> cleared = Clear(room_);
  double sum_sq = 0, sum = 0, worst_mean = 0;
  for (int y = 0; y < kRoomHeight; ++y) {
    for (int x = 0; x < kRoomWidth; ++x) {
      double mean = 0;
      for (int i = 0; i < kRoomPictures; ++i) {
        const double off = cleared[i](x, y).g - 1.0 * empty[i](x, y).g;
        mean += off / kRoomPictures;
        sum += off, sum_sq += off * off;
      }
      worst_mean = std::max(worst_mean, std::abs(mean));
    }
  }
  constexpr double kValues = 1.0 * kRoomWidth * kRoomHeight * kRoomPictures;
  // The wall's own noise is about two grey levels, in both pictures.
  EXPECT_LT(std::sqrt(sum_sq / kValues), 1.5);
  EXPECT_LT(std::abs(sum / kValues), 0.1);
  EXPECT_LT(worst_mean, 2.5);
}

TEST_F(ClearedRoom, IsFilledWhereItWasUnseen) {
  for (int y = 20; y < 30; ++y)
    for (int x = 40; x < 50; ++x)
      room_.places[static_cast<std::size_t>(y) * kRoomWidth + x] = Place::kUnseen;
  const Image<Bgr> filling(kRoomWidth, kRoomHeight, {200, 100, 50});
  for (const Image<Bgr>& picture : Clear(room_, &filling)) {
    EXPECT_NEAR(picture(45, 25).b, 200, 5);
    EXPECT_NEAR(picture(45, 25).g, 100, 3);
    EXPECT_NEAR(picture(39, 25).g, RoomWall(39, 25).g, 12);
  }
  for (const Image<Bgr>& picture : Clear(room_)) EXPECT_EQ(picture(41, 25), picture(39, 25));
}

}  // namespace
}  // namespace mocap
