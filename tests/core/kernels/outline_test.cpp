#include "core/kernels/outline.h"

#include <sys/mman.h>

#include <algorithm>

#include "core/kernels/outline_reference.h"
#include "tests/core/kernels/each_target.h"

namespace mocap::kernels {
namespace {

// Random surroundings, of which `share` of eight pixels are inside, and as many outside.
struct SomeSurroundings {
  static constexpr std::ptrdiff_t kStride = 3, kRows = 10;

  SomeSurroundings(std::uint32_t seed, int share) : numbers(seed) {
    for (int i = 0; i < kAround_px * kAroundRows; ++i) {
      const auto level = [&] { return static_cast<std::uint8_t>(numbers.Below(256)); };
      pixels.push_back({level(), level(), level()});
    }
    shifts = numbers.Floats(pixels.size(), -0.5f, 0.3f);
    inside.resize(kStride * kRows), outside.resize(kStride * kRows);
    for (std::size_t i = 0; i < inside.size(); ++i) {
      for (int bit = 0; bit < 64; ++bit) {
        const int kind = numbers.Below(8);
        if (kind < share) inside[i] |= BitWord{1} << bit;
        if (kind >= 8 - share) outside[i] |= BitWord{1} << bit;
      }
    }
    for (WeighedPixels& group : expected)
      for (auto& column : group.mean)
        for (std::uint16_t& mean : column) mean = static_cast<std::uint16_t>(numbers.Below(65536));
  }

  template <typename Judge>
  std::vector<std::uint8_t> Judged(const Judge& judge, int pixel, int first) const {
    const auto decisions =
        judge(OutlineSurroundings{{pixels.data(), kAround_px, kAroundRows},
                                  {shifts.data(), kAround_px, kAroundRows},
                                  &inside[4 * kStride + 1],
                                  &outside[4 * kStride + 1],
                                  kStride,
                                  pixel},
              std::array<float, 3>{1.1f, 0.95f, 1}, {&expected[0], &expected[1]}, first);
    return {decisions[0].told, decisions[0].covered, decisions[1].told, decisions[1].covered};
  }

  Numbers numbers;
  std::vector<Bgr> pixels;
  std::vector<float> shifts;
  std::vector<BitWord> inside, outside;
  std::array<WeighedPixels, 2> expected;
};

// Words that end where memory ends: reading beyond them is a fault.
class WordsAtTheEnd {
 public:
  explicit WordsAtTheEnd(std::size_t words) : words_(words) {
    mprotect(static_cast<char*>(memory_) + kPage, kPage, PROT_NONE);
  }
  WordsAtTheEnd(const WordsAtTheEnd&) = delete;
  WordsAtTheEnd& operator=(const WordsAtTheEnd&) = delete;
  ~WordsAtTheEnd() { munmap(memory_, 2 * kPage); }
  BitWord* data() { return static_cast<BitWord*>(memory_) + kPage / sizeof(BitWord) - words_; }

 private:
  static constexpr std::size_t kPage = 65536;
  std::size_t words_;
  void* memory_ =
      mmap(nullptr, 2 * kPage, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
};

TEST(OutlineKernels, NothingBeyondTheLastRowIsRead) {
  const SomeSurroundings some(1, 2);
  WordsAtTheEnd inside(kAroundRows), outside(kAroundRows);
  std::copy_n(some.inside.begin(), kAroundRows, inside.data());
  std::copy_n(some.outside.begin(), kAroundRows, outside.data());
  const auto judged = [&](const auto& judge) {
    // The last that has all pixels around it in the row.
    constexpr int kPixel = 64 - kAround_px;
    const auto decisions =
        judge(OutlineSurroundings{{some.pixels.data(), kAround_px, kAroundRows},
                                  {some.shifts.data(), kAround_px, kAroundRows},
                                  inside.data() + kOutlineReach_px,
                                  outside.data() + kOutlineReach_px,
                                  1,
                                  kPixel},
              std::array<float, 3>{1, 1, 1}, {&some.expected[0], &some.expected[1]}, 0);
    return std::vector<std::uint8_t>{decisions[0].told, decisions[1].told};
  };
  ExpectSameBits([&] { return judged(reference::JudgeOutline); },
                 [&] { return judged(JudgeOutline); });
}

TEST(OutlineKernels, PixelsAreJudgedOneByOne) {
  int told = 0, covered = 0;
  for (std::uint32_t seed = 0; seed < 60; ++seed) {
    // With none, nothing is decided.
    const SomeSurroundings some(seed, static_cast<int>(seed) % 5);
    for (int pixel = 0; pixel < 64; pixel += kOutlinePixels) {
      for (const int first : {0, 8}) {
        ExpectSameBits([&] { return some.Judged(reference::JudgeOutline, pixel, first); },
                       [&] { return some.Judged(JudgeOutline, pixel, first); });
        const auto decisions = some.Judged(reference::JudgeOutline, pixel, first);
        told += decisions[0] != 0, covered += decisions[1] != 0;
        if (seed % 5 == 0) {
          EXPECT_EQ(decisions, std::vector<std::uint8_t>(4, 0));
        }
      }
    }
  }
  EXPECT_GT(told, 100);
  EXPECT_GT(covered, 100);
}

}  // namespace
}  // namespace mocap::kernels
