#include "drivers/take/picture_coder.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <vector>

#include "drivers/virtual_studio/random.h"
#include "tests/support/pixels.h"

namespace mocap {
namespace {

constexpr int kWidth = 96, kHeight = 64;

/// A texture on a ground that becomes lighter from picture to picture.
std::vector<Image<Bgr>> LighterPictures(int count) {
  std::vector<Image<Bgr>> pictures;
  for (int i = 0; i < count; ++i) {
    simulation::Random random(simulation::Mix(7, static_cast<std::uint64_t>(i)));
    Image<Bgr>& picture = pictures.emplace_back(kWidth, kHeight);
    for (Bgr& pixel : picture.pixels()) {
      const auto value = static_cast<std::uint8_t>(40 + 2 * i + random.Uniform(0, 20));
      pixel = {value, value, value};
    }
  }
  return pictures;
}

std::vector<Image<Bgr>> Coded(const std::vector<Image<Bgr>>& pictures, int crf) {
  PictureCoder coder(kWidth, kHeight, 30, crf);
  std::vector<Image<Bgr>> coded;
  Image<Bgr> next;
  for (const Image<Bgr>& picture : pictures) {
    coder.Add(picture.view());
    while (coder.Take(next)) coded.push_back(next);
  }
  coder.Finish();
  while (coder.Take(next)) coded.push_back(next);
  EXPECT_FALSE(coder.Take(next)) << "all have come back";
  return coded;
}

double MeanOf(const Image<Bgr>& picture) {
  double sum = 0;
  for (const Bgr& pixel : picture.pixels()) sum += pixel.g;
  return sum / static_cast<double>(picture.pixels().size());
}

double MeanDifference(const Image<Bgr>& a, const Image<Bgr>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.pixels().size(); ++i)
    sum += std::abs(a.pixels()[i].g - b.pixels()[i].g);
  return sum / static_cast<double>(a.pixels().size());
}

TEST(PictureCoder, EveryPictureComesBackOnceAndInOrder) {
  for (const int count : {1, 70}) {
    const std::vector<Image<Bgr>> pictures = LighterPictures(count), coded = Coded(pictures, 20);
    ASSERT_EQ(coded.size(), pictures.size());
    for (int i = 0; i < count; ++i)
      EXPECT_NEAR(MeanOf(coded[i]), MeanOf(pictures[i]), 0.9) << "picture " << i;
  }
}

TEST(PictureCoder, AHigherCrfLosesMoreAndTheSameCrfTheSame) {
  const std::vector<Image<Bgr>> pictures = LighterPictures(3);
  const std::vector<Image<Bgr>> fine = Coded(pictures, 4), coarse = Coded(pictures, 35);
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    EXPECT_LT(MeanDifference(fine[i], pictures[i]), 2);
    EXPECT_GT(MeanDifference(coarse[i], pictures[i]), 3);
  }
  const std::vector<Image<Bgr>> again = Coded(pictures, 35);
  for (std::size_t i = 0; i < pictures.size(); ++i)
    EXPECT_EQ(Pixels(again[i].view()), Pixels(coarse[i].view()));
}

}  // namespace
}  // namespace mocap
