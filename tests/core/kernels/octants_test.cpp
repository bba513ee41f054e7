#include "core/kernels/octants.h"

#include <cmath>

#include "core/kernels/octants_reference.h"
#include "tests/core/kernels/each_target.h"

namespace mocap::kernels {
namespace {

// A camera 3 m in front of the origin, which sees a disk.
class OctantKernels : public ::testing::Test {
 protected:
  static constexpr int kColumns = 45, kRows = 35;
  static constexpr int kLeft = 201, kTop = 111, kSide = 240, kWordColumns = kSide / 16;

  OctantKernels() {
    for (int row = 0; row < kRows; ++row) {
      for (int column = 0; column < kColumns; ++column) {
        const float x = static_cast<float>(column) / 20 - 1.1f;
        const float y = static_cast<float>(row) / 20 - 0.85f;
        const float bend = 1 - 0.1f * (x * x + y * y);
        nodes_.push_back({320 + 310 * x * bend, 240 + 310 * y * bend});
        bends_px_.push_back(0.02f + 0.01f * static_cast<float>(column % 3));
      }
    }
    words_.resize(kWindowPlanes * kWordColumns * kSide);
    for (int plane = 0; plane < kWindowPlanes; ++plane)
      for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) SetWindow(plane, x, y);
    camera_.R = {{{0.8f, 0.6f, 0}, {0, 0, -1}, {-0.6f, 0.8f, 0}}};
    camera_.p = {10, 20, 3000};
    camera_.table = {nodes_.data(), kColumns, -1.1f, -0.85f, 20,   kColumns - 1,    kRows - 1,
                     1.3f,          -1.05f,   -0.8f, 1.05f,  0.8f, bends_px_.data()};
    camera_.planes = {words_.data(),
                      kSide,
                      kWordColumns * kSide,
                      kLeft,
                      kTop,
                      kLeft + kSide - 1,
                      kTop + kSide - 1,
                      640,
                      480};
  }

  // Marks windows in the disk, and those well beside it.
  void SetWindow(int plane, int x, int y) {
    constexpr float kRadius = 90;
    const float middle = kSide / 2;
    bool inside = true, outside = true;
    for (const int u : {x, x + (1 << plane) - 1}) {
      for (const int v : {y, y + (1 << plane) - 1}) {
        const float distance =
            std::hypot(static_cast<float>(u) - middle, static_cast<float>(v) - middle);
        inside = inside && distance < kRadius;
        outside = outside && distance > kRadius + 40;
      }
    }
    std::uint32_t& word =
        words_[static_cast<std::size_t>((plane * kWordColumns + x / 16) * kSide + y)];
    word |= static_cast<std::uint32_t>(inside) << x % 16;
    word |= static_cast<std::uint32_t>(outside) << (16 + x % 16);
  }

  // Blocks near the disk, anywhere in front of the camera, and behind it.
  std::array<float, 3> Middle(int i) {
    const float size = i % 2 == 0 ? 900.0f : 4500.0f;
    const std::vector<float> some = numbers_.Floats(3, -size, size);
    return {some[0], some[1], some[2]};
  }
  // Counts decisions of each kind, to see that all occur.
  void Count(OctantBits bits) {
    for (int kind = 0; kind < 4; ++kind) counts_[kind] += std::popcount((bits >> 8 * kind) & 0xff);
  }

  std::vector<PicturePlace> nodes_;
  std::vector<float> bends_px_;
  std::vector<std::uint32_t> words_;
  OctantCamera camera_;
  Numbers numbers_{4};
  std::array<int, 4> counts_{};
};

std::vector<float> NumbersOf(const OctantFrames& frames) {
  std::vector<float> numbers(sizeof frames / sizeof(float));
  std::memcpy(numbers.data(), &frames, sizeof frames);
  return numbers;
}

TEST_F(OctantKernels, OctantsAreProjectedOneByOne) {
  for (int i = 0; i < 600; ++i) {
    const std::array<float, 3> middle = Middle(i);
    const float half = std::array<float, 4>{0, 6, 50, 200}[i % 4], spread = half + 3;
    OctantFrames wanted;
    const OctantBits bits = reference::ProjectOctants(camera_, middle, spread, half, wanted);
    Count(bits);
    ExpectSameBits([&] { return NumbersOf(wanted); },
                   [&] {
                     OctantFrames frames;
                     EXPECT_EQ(ProjectOctants(camera_, middle, spread, half, frames), bits);
                     return NumbersOf(frames);
                   });
  }
  for (const int count : counts_) EXPECT_GT(count, 100);
}

TEST_F(OctantKernels, OctantsAndSamplesAreJudgedByAFrameOneByOne) {
  int judged = 0;
  for (int i = 0; i < 600; ++i) {
    std::array<float, 3> middle = Middle(0);
    OctantFrames frames;
    reference::ProjectOctants(camera_, middle, 50, 50, frames);
    const int octant = i % 8;
    if (frames.error[octant] >= kNoFrame_px) continue;
    for (int axis = 0; axis < 3; ++axis)
      middle[axis] = frames.middle[axis][octant] + static_cast<float>(numbers_.Below(41) - 20);
    for (const float half : {0.0f, 8.0f, 20.0f}) {
      const OctantBits bits =
          reference::JudgeOctants(camera_.planes, frames, octant, middle, half + 4, half);
      Count(bits);
      ForEachTarget([&] {
        EXPECT_EQ(JudgeOctants(camera_.planes, frames, octant, middle, half + 4, half), bits);
      });
    }
    const auto asked = static_cast<unsigned>(numbers_.Below(256));
    const auto decided = [&](const auto& judge) {
      SampleDecisions decisions{};
      const bool is_in_region =
          judge(camera_.planes, frames, octant, middle, 12.0f, 6.0f, asked, decisions);
      judged += is_in_region;
      return std::vector<std::uint64_t>{is_in_region, decisions.inside, decisions.outside,
                                        decisions.unseen, decisions.unknown};
    };
    ExpectSameBits([&] { return decided(reference::JudgeSamples); },
                   [&] { return decided(JudgeSamples); });
  }
  EXPECT_GT(judged, 400);
  for (const int kind : {0, 1, 3}) EXPECT_GT(counts_[kind], 100);
}

}  // namespace
}  // namespace mocap::kernels
