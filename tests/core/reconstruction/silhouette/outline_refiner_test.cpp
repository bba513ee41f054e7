#include "core/reconstruction/silhouette/outline_refiner.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <random>

#include "core/image.h"
#include "core/reconstruction/background/expected_picture.h"
#include "core/reconstruction/silhouette/bit_filters.h"

namespace mocap {
namespace {

constexpr int kOutlineWidth = 300, kOutlineHeight = 90;
constexpr std::array<float, 3> kGain = {1.1f, 0.9f, 1.0f};

// A person of other colours than the room, its edges torn, a pixel to the right of its silhouette,
// and all of it noisy.
struct Scene {
  explicit Scene(unsigned seed)
      : expected(kOutlineWidth, kOutlineHeight),
        image(kOutlineWidth, kOutlineHeight),
        alpha_shift(kOutlineWidth, kOutlineHeight) {
    std::mt19937 random(seed);
    const auto number = [&](int from, int to) {
      return std::uniform_int_distribution<int>(from, to)(random);
    };
    Silhouette person(kOutlineWidth, kOutlineHeight);
    for (const auto& [x, y, size] : {std::array{0, 0, 20},
                                     {50, 30, 25},
                                     {140, 10, 30},
                                     {200, 60, 40},
                                     {226, 20, 9},
                                     {90, 80, 4}})
      for (int v = std::max(y - size / 2, 0); v < std::min(y + size, person.height()); ++v)
        for (int u = std::max(x - size / 2 + number(-2, 2), 0);
             u < std::min(x + size + number(-2, 2), person.width()); ++u)
          person.Set(u, v);
    silhouette = person;
    for (int y = 0; y < kOutlineHeight; ++y) {
      for (int x = 0; x < kOutlineWidth; ++x) {
        const bool is_person = x > 0 && person.Test(x - 1, y);
        const auto channel = [&](int level) {
          return static_cast<std::uint8_t>(level + number(0, 40));
        };
        image(x, y) = is_person ? Bgr{channel(60), channel(90), channel(20)}
                                : Bgr{channel(80), channel(90), channel(100)};
        alpha_shift(x, y) = static_cast<float>(number(-100, 100)) / 500;
        const auto level = [&](int middle) { return static_cast<float>(middle + number(0, 30)); };
        expected.SetPixel(static_cast<std::size_t>(y) * kOutlineWidth + x,
                          {level(80), level(90), level(110)}, {2, 2, 2});
      }
      expected.Weigh(0, y, 0, kOutlineWidth);
    }
  }
  ExpectedPicture expected;
  Image<Bgr> image;
  Image<float> alpha_shift;
  Silhouette silhouette;
};

// What is around the block of two by two pixels that begins at a pixel.
struct Block {
  Block(const Scene& scene, const Silhouette& inside, const Silhouette& near, int x, int y) {
    for (const int v : {y - 3, y - 1, y + 2, y + 4}) {
      for (int u = x - 3; u < x + 5; ++u) {
        if (u < 0 || v < 0 || u >= inside.width() || v >= inside.height()) continue;
        const Bgr& p = scene.image(u, v);
        if (inside.Test(u, v)) person[0] += p.b, person[1] += p.g, person[2] += p.r, ++inside_count;
        if (!near.Test(u, v)) alpha += scene.alpha_shift(u, v), ++outside_count;
      }
    }
    for (double& sum : person) sum /= inside_count;
    alpha = 1 + alpha / outside_count;
  }
  // How far a pixel lies from the background's colour towards the person's, if they differ.
  std::optional<double> CoverOf(const Scene& scene, int x, int y) const {
    if (inside_count == 0 || outside_count == 0) return std::nullopt;
    const Bgr& p = scene.image(x, y);
    const std::array<double, 3> color = {double(p.b), double(p.g), double(p.r)};
    double along = 0, contrast_sq = 0;
    for (int c = 0; c < 3; ++c) {
      const double background = scene.expected.MeanAt(x, y, c) * alpha;
      const double contrast = person[c] * kGain[c] - background;
      along += contrast * (color[c] * kGain[c] - background);
      contrast_sq += contrast * contrast;
    }
    if (contrast_sq < 16) return std::nullopt;
    return along / contrast_sq;
  }
  std::array<double, 3> person{};
  double alpha = 0;
  int inside_count = 0, outside_count = 0;
};

TEST(OutlineRefiner, KeepsWhatThePersonCoversByHalf) {
  OutlineRefiner refiner;
  for (const unsigned seed : {1u, 2u, 3u}) {
    const Scene scene(seed);
    Silhouette refined = scene.silhouette, inside, near;
    Erode(scene.silhouette, 1, inside);
    Dilate(scene.silhouette, 1, near);
    refiner.Refine(scene.expected, scene.image.view(), kGain, scene.alpha_shift.view(), refined);
    int changed = 0;
    for (int y = 0; y < refined.height(); ++y) {
      for (int x = 0; x < refined.width(); ++x) {
        const bool was_set = scene.silhouette.Test(x, y);
        bool is_set = was_set;
        // Rows are judged in pairs, and columns in eights, if all that is around them is known.
        const int top = y - (y + 1) % 2, left = x / 8 * 8;
        const bool is_at_edge = top < 3 || top + 5 > kOutlineHeight ||
                                left < OutlineRefiner::kMargin_px || left + 12 > kOutlineWidth;
        if (near.Test(x, y) && !inside.Test(x, y) && !is_at_edge) {
          const Block block(scene, inside, near, x - (x + 1) % 2, y - (y + 1) % 2);
          const std::optional<double> cover = block.CoverOf(scene, x, y);
          // What is that close depends on rounding.
          if (cover && std::abs(*cover - 0.4) < 1e-4) continue;
          if (cover) is_set = *cover > 0.4;
        }
        EXPECT_EQ(refined.Test(x, y), is_set) << x << " " << y;
        changed += is_set != was_set;
      }
    }
    EXPECT_GT(changed, 100);
  }
}

}  // namespace
}  // namespace mocap
