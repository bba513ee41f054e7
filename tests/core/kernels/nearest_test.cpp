#include "core/kernels/nearest.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "core/kernels/nearest_reference.h"
#include "tests/core/kernels/each_target.h"

namespace mocap::kernels {
namespace {

TEST(NearestKernels, TheFirstOfTheNearestPointsIsFound) {
  for (int count = 0; count < 70; ++count) {
    Numbers numbers(static_cast<std::uint32_t>(count));
    const auto whole = static_cast<std::size_t>((count + kPointStep - 1) / kPointStep * kPointStep);
    std::array<std::vector<double>, 3> axes;
    for (std::vector<double>& axis : axes) {
      axis.resize(whole, std::numeric_limits<double>::infinity());
      // Few different places: many are equally near.
      for (int i = 0; i < count; ++i) axis[static_cast<std::size_t>(i)] = numbers.Below(3);
    }
    const auto found = [&](const auto& find) {
      std::vector<int> indices;
      for (const double place : {0.0, 0.4, 1.5, 3.0})
        indices.push_back(
            find(axes[0].data(), axes[1].data(), axes[2].data(), count, {place, 1, place}));
      return indices;
    };
    ExpectSameBits([&] { return found(reference::FindNearestPoint); },
                   [&] { return found(FindNearestPoint); });
  }
}

TEST(NearestKernels, PointsMayBeAddedAndForgotten) {
  NearestPoint points;
  for (int count = 37; count > 0; count -= 9) {
    points.Clear();
    EXPECT_TRUE(points.empty());
    std::vector<std::array<double, 3>> all;
    for (int i = 0; i < count; ++i) {
      all.push_back({100 * std::sin(3.0 * i), 100 * std::cos(5.0 * i), 10.0 * i});
      points.Add(all.back());
    }
    for (int i = 0; i < 50; ++i) {
      const std::array<double, 3> place{120 * std::cos(7.0 * i), 120 * std::sin(2.0 * i), 8.0 * i};
      const auto distance = [&](const std::array<double, 3>& point) {
        return std::hypot(point[0] - place[0], point[1] - place[1], point[2] - place[2]);
      };
      EXPECT_EQ(points.To(place), *std::ranges::min_element(all, {}, distance));
    }
  }
}

TEST(NearestKernels, TheFarthestRayIsFound) {
  for (int count = 0; count < 9; ++count) {
    for (std::uint32_t seed = 0; seed < 20; ++seed) {
      Numbers numbers(seed);
      std::vector<RayBlock> blocks(static_cast<std::size_t>(count));
      // Few different directions: many go equally far.
      const auto some = [&] { return static_cast<float>(numbers.Below(5) - (seed < 4 ? 5 : 2)); };
      for (RayBlock& block : blocks)
        for (int i = 0; i < RayBlock::kRays; ++i)
          block.x[i] = some(), block.y[i] = some(), block.z[i] = some();
      const auto found = [&](const auto& find) {
        return std::vector<int>{find(blocks.data(), count, {1, 2, 0.5f}),
                                find(blocks.data(), count, {1, 0, 0}),
                                find(blocks.data(), count, {-1, 1, 1})};
      };
      ExpectSameBits([&] { return found(reference::FindFarthestRay); },
                     [&] { return found(FindFarthestRay); });
    }
  }
}

}  // namespace
}  // namespace mocap::kernels
