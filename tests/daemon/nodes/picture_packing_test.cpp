#include "daemon/nodes/picture_packing.h"

#include <gtest/gtest.h>

#include <random>

namespace mocap {
namespace {

constexpr int kTile_px = Shading::kTile_px;

struct Picture {
  Trimap trimap;
  Shading shading;
};

/// Runs of random lengths: among them whole rows, single pixels, and words' ends.
Silhouette RandomRuns(int width, int height, std::mt19937& random) {
  Silhouette picture(width, height);
  for (int y = 0; y < height; ++y) {
    if (random() % 3 == 0) continue;
    bool is_set = random() % 2 == 0;
    for (int x = 0; x < width; is_set = !is_set) {
      const int end = std::min(width, x + 1 + static_cast<int>(random() % (random() % 150 + 1)));
      for (; x < end; ++x)
        if (is_set) picture.Set(x, y);
    }
  }
  return picture;
}

Picture RandomPicture(int width, int height, std::mt19937& random) {
  Picture picture{{RandomRuns(width, height, random), RandomRuns(width, height, random)}, {}};
  picture.shading.dark = RandomRuns(width, height, random);
  const int columns = (width + kTile_px - 1) / kTile_px;
  const int rows = (height + kTile_px - 1) / kTile_px;
  picture.shading.tile_columns = columns;
  for (int tile = 0; tile < columns * rows; ++tile) {
    const auto shade = static_cast<Shading::Shade>(-static_cast<int>(random() % 65));
    picture.shading.shades.push_back(random() % 5 == 0 ? Shading::kUnknown : shade);
    if (random() % 4 == 0)
      picture.shading.dark_tiles.push_back({static_cast<std::int16_t>(tile % columns),
                                            static_cast<std::int16_t>(tile / columns), shade});
  }
  return picture;
}

void ExpectEqual(const Picture& a, const Picture& b) {
  EXPECT_EQ(a.trimap.person.words(), b.trimap.person.words());
  EXPECT_EQ(a.trimap.person.BoundingBox(), b.trimap.person.BoundingBox());
  EXPECT_EQ(a.trimap.unknown.words(), b.trimap.unknown.words());
  EXPECT_EQ(a.shading.dark.words(), b.shading.dark.words());
  EXPECT_EQ(a.shading.tile_columns, b.shading.tile_columns);
  EXPECT_EQ(a.shading.shades, b.shading.shades);
  EXPECT_EQ(a.shading.dark_tiles, b.shading.dark_tiles);
}

TEST(PicturePacking, KeepsEveryBit) {
  std::mt19937 random(1);
  std::vector<std::uint8_t> bytes;
  Picture unpacked;
  for (const auto& [width, height] : {std::pair{640, 480}, {64, 8}, {65, 9}, {1, 1}, {129, 33}}) {
    const Picture picture = RandomPicture(width, height, random);
    PackPicture(picture.trimap, picture.shading, bytes);
    ASSERT_TRUE(UnpackPicture(bytes, width, height, unpacked.trimap, unpacked.shading));
    ExpectEqual(unpacked, picture);
  }
}

TEST(PicturePacking, AnEmptyPictureIsAFewBytes) {
  Picture picture{{Silhouette(640, 480), {}}, {}};
  picture.trimap.unknown = picture.shading.dark = picture.trimap.person;
  picture.shading.tile_columns = 80;
  picture.shading.shades.assign(80 * 60, 0);
  std::vector<std::uint8_t> bytes;
  PackPicture(picture.trimap, picture.shading, bytes);
  EXPECT_LT(bytes.size(), 10u);
  Picture unpacked;
  ASSERT_TRUE(UnpackPicture(bytes, 640, 480, unpacked.trimap, unpacked.shading));
  ExpectEqual(unpacked, picture);
}

TEST(PicturePacking, RefusesBytesOfAnotherPicture) {
  std::mt19937 random(2);
  const Picture picture = RandomPicture(96, 40, random);
  std::vector<std::uint8_t> bytes;
  PackPicture(picture.trimap, picture.shading, bytes);
  Picture unpacked;
  EXPECT_FALSE(UnpackPicture(bytes, 88, 40, unpacked.trimap, unpacked.shading));
  EXPECT_FALSE(UnpackPicture(bytes, 96, 32, unpacked.trimap, unpacked.shading));
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_FALSE(
        UnpackPicture(std::span(bytes).first(size), 96, 40, unpacked.trimap, unpacked.shading))
        << size;
  }
  bytes.push_back(0);
  EXPECT_FALSE(UnpackPicture(bytes, 96, 40, unpacked.trimap, unpacked.shading));
}

// What gets through is a picture all the same: no pixel lies outside of it, and no tile.
TEST(PicturePacking, DamageStaysWithinThePicture) {
  std::mt19937 random(3);
  const Picture picture = RandomPicture(100, 40, random);
  std::vector<std::uint8_t> bytes;
  PackPicture(picture.trimap, picture.shading, bytes);
  Picture unpacked;
  int accepted = 0;
  for (int i = 0; i < 3000; ++i) {
    std::vector<std::uint8_t> damaged = bytes;
    damaged[random() % damaged.size()] = static_cast<std::uint8_t>(random());
    if (!UnpackPicture(damaged, 100, 40, unpacked.trimap, unpacked.shading)) continue;
    ++accepted;
    EXPECT_EQ(unpacked.shading.shades.size(), 13u * 5u);
    for (int y = 0; y < 40; ++y) {
      EXPECT_EQ(unpacked.trimap.person.row(y)[1] >> 36, 0u);
      EXPECT_EQ(unpacked.trimap.unknown.row(y)[1] >> 36, 0u);
    }
    for (const Shading::DarkTile& tile : unpacked.shading.dark_tiles) {
      EXPECT_LT(tile.column, 13);
      EXPECT_LT(tile.row, 5);
    }
  }
  EXPECT_GT(accepted, 0);
}

}  // namespace
}  // namespace mocap
