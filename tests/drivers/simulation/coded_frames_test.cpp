#include "drivers/simulation/coded_frames.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "core/errors.h"
#include "drivers/simulation/simulated_studio.h"
#include "tests/support/pixels.h"

namespace mocap {
namespace {

SimulatedStudioOptions SmallCodedStudio() {
  SimulatedStudioOptions options = RecordedSimulation();
  options.width_px = 160;
  options.height_px = 120;
  options.seconds = 2;
  options.cameras = 2;
  options.crf = 23;
  return options;
}

std::vector<std::uint8_t> Bytes(ImageView<const std::uint8_t> mask) {
  return {mask.row(0), mask.row(0) + mask.width() * mask.height()};
}

double MeanGap(const std::vector<Bgr>& a, const std::vector<Bgr>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += std::abs(a[i].g - b[i].g);
  return sum / static_cast<double>(a.size());
}

TEST(CodedFrames, KeepTheirTimesAndMasks) {
  SimulatedStudioOptions options = SmallCodedStudio();
  const SimulatedStudio coded_studio(options);
  options.crf.reset();
  const SimulatedStudio studio(options);
  const auto coded = coded_studio.OpenCamera(1), plain = studio.OpenCamera(1);
  constexpr std::chrono::milliseconds kAtOnce(0);
  for (int session = 0; session < 2; ++session) {
    coded->Start();
    plain->Start();
    Frame a, b;
    for (int i = 0; i < 60; ++i) {
      ASSERT_EQ(coded->Grab(a, kAtOnce), GrabStatus::kFrame) << i;
      ASSERT_EQ(plain->Grab(b, kAtOnce), GrabStatus::kFrame) << i;
      EXPECT_EQ(a.capture_ns, b.capture_ns);
      EXPECT_EQ(a.sequence, b.sequence);
      EXPECT_EQ(Bytes(coded->TrueMask()), Bytes(plain->TrueMask())) << i;
      const double gap = MeanGap(Pixels(a.image), Pixels(b.image));
      EXPECT_GT(gap, 0.5) << i;
      EXPECT_LT(gap, 5) << i;
    }
    EXPECT_EQ(coded->Grab(a, kAtOnce), GrabStatus::kEnd);
    EXPECT_EQ(coded->Grab(a, kAtOnce), GrabStatus::kEnd);
    coded->Stop();
    plain->Stop();
  }
}

TEST(CodedFrames, ThoseOfTheEmptyRoomAreCodedToo) {
  SimulatedStudioOptions options = SmallCodedStudio();
  const std::vector<BackgroundFrame> coded = SimulatedStudio(options).Background(0);
  options.crf.reset();
  const std::vector<BackgroundFrame> plain = SimulatedStudio(options).Background(0);
  ASSERT_EQ(coded.size(), plain.size());
  for (std::size_t i = 0; i < coded.size(); ++i) {
    const double gap = MeanGap(coded[i].image.pixels(), plain[i].image.pixels());
    EXPECT_GT(gap, 0.5) << i;
    EXPECT_LT(gap, 5) << i;
  }
}

// Whatever the memory has held before.
TEST(CodedFrames, AreTheSameEachTime) {
  SimulatedStudioOptions options = SmallCodedStudio();
  options.width_px = 320;
  options.height_px = 240;
  options.cameras = 2;
  options.crf = 28;
  const SimulatedStudio studio(options);
  std::vector<std::vector<BackgroundFrame>> first;
  for (int i = 0; i < options.cameras; ++i) first.push_back(studio.Background(i));
  for (int turn = 0; turn < 3; ++turn) {
    for (int i = 0; i < options.cameras; ++i) {
      const std::vector<BackgroundFrame> again = studio.Background(i);
      for (std::size_t k = 0; k < again.size(); ++k)
        ASSERT_EQ(again[k].image.pixels(), first[i][k].image.pixels()) << i << ' ' << k;
    }
  }
}

TEST(CodedFrames, AreRefusedWhereTheyCannotBe) {
  const auto refuses = [](const auto& change) {
    SimulatedStudioOptions options = SmallCodedStudio();
    change(options);
    EXPECT_THROW(SimulatedStudio{options}, SetupError);
  };
  refuses([](SimulatedStudioOptions& options) { options.crf = -1; });
  refuses([](SimulatedStudioOptions& options) { options.crf = 52; });
  refuses([](SimulatedStudioOptions& options) { options.width_px = 161; });
  refuses([](SimulatedStudioOptions& options) { options.height_px = 121; });
  refuses([](SimulatedStudioOptions& options) { options.realtime = true; });
  refuses([](SimulatedStudioOptions& options) { options.follow = true; });
}

}  // namespace
}  // namespace mocap
