#include "core/kernels/nearest.h"

#include <limits>

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
