// Offsets by sounds that all recordings heard.
#include "tools/import/sound_offsets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <vector>

namespace mocap {
namespace {

/// A clap: noise that fades within milliseconds.
void AddClap(double at_s, double loudness, std::vector<double>& sound) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  for (double t_s = 0; t_s < 0.03; t_s += 1.0 / kSoundRate_hz) {
    const double sample = loudness * normal(random) * std::exp(-t_s / 0.005);
    const auto at = std::llround((at_s + t_s) * kSoundRate_hz);
    if (at >= 0 && at < std::ssize(sound)) sound[static_cast<std::size_t>(at)] += sample;
  }
}

struct Phone {
  double begin_s = 0;  ///< When its recording begins.
  double loudness = 5000;
  double noise = 30;
  unsigned seed = 1;
  double rate = 1;  ///< Seconds of its clock in a second.
};

SoundTrack Heard(const Phone& phone, const std::vector<double>& claps_s, double length_s) {
  std::mt19937 random(phone.seed);
  std::normal_distribution<double> normal(0, phone.noise);
  std::vector<double> sound(static_cast<std::size_t>(length_s * kSoundRate_hz));
  for (double& sample : sound) sample = normal(random);
  std::uniform_real_distribution<double> echo_s(0.01, 0.08);
  for (const double clap_s : claps_s) {
    const double at_s = (clap_s - phone.begin_s) * phone.rate;
    AddClap(at_s, phone.loudness, sound);
    for (int i = 0; i < 5; ++i) AddClap(at_s + echo_s(random), phone.loudness / 4, sound);
  }
  SoundTrack track;
  for (const double sample : sound)
    track.samples.push_back(static_cast<std::int16_t>(std::clamp(sample, -32000.0, 32000.0)));
  return track;
}

constexpr double kWithin_s = 0.001;

TEST(SoundOffset, IsFoundByOneClap) {
  const SoundTrack first = Heard({10, 5000, 30, 1}, {12.3}, 6);
  const SoundTrack second = Heard({8.75, 900, 60, 2}, {12.3}, 8);
  const auto offset = SoundOffset(first, second);
  ASSERT_TRUE(offset);
  // The clap is at 2.3 s of the first and at 3.55 s of the second one.
  EXPECT_NEAR(offset->ahead_s, -1.25, kWithin_s);
  EXPECT_GT(offset->clearness, 1.5);
}

TEST(SoundOffset, CountsFromTheFirstSamples) {
  SoundTrack first = Heard({10, 5000, 30, 1}, {12.3}, 6);
  const SoundTrack second = Heard({10, 5000, 30, 2}, {12.3}, 6);
  first.first_ns = 500'000'000;
  const auto offset = SoundOffset(first, second);
  ASSERT_TRUE(offset);
  EXPECT_NEAR(offset->ahead_s, 0.5, kWithin_s);
}

TEST(SoundOffset, IsTheOneOfSeveralClapsThatAgree) {
  const std::vector<double> claps_s = {3, 4, 5, 7.2, 11};
  const auto offset =
      SoundOffset(Heard({0, 5000, 30, 1}, claps_s, 20), Heard({2.5, 2000, 30, 2}, claps_s, 20));
  ASSERT_TRUE(offset);
  EXPECT_NEAR(offset->ahead_s, 2.5, kWithin_s);
}

TEST(SoundOffset, IsNotFoundWithoutACommonSound) {
  EXPECT_FALSE(SoundOffset(Heard({0, 0, 30, 1}, {}, 6), Heard({0, 0, 30, 2}, {}, 6)));
  EXPECT_FALSE(SoundOffset(SoundTrack{}, Heard({0, 5000, 30, 2}, {1}, 6)));
  const SoundTrack silence{0, std::vector<std::int16_t>(40000)};
  EXPECT_FALSE(SoundOffset(silence, silence));
}

TEST(SoundOffset, TellsTheDriftOfLongRecordings) {
  std::vector<double> claps_s;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> pause_s(5, 15);
  for (double at_s = 2; at_s < 590; at_s += pause_s(random)) claps_s.push_back(at_s);
  constexpr double kDrift = 50e-6;
  const auto offset = SoundOffset(Heard({0, 5000, 30, 1}, claps_s, 600),
                                  Heard({0, 3000, 30, 2, 1 - kDrift}, claps_s, 600));
  ASSERT_TRUE(offset && offset->rate_ppm);
  EXPECT_NEAR(*offset->rate_ppm, 1e6 * kDrift, 3);
  EXPECT_NEAR(offset->ahead_s, kDrift * offset->at_s, kWithin_s);
}

TEST(SoundOffsets, ComparesAllThatHaveSound) {
  const std::vector<std::optional<SoundTrack>> tracks = {
      Heard({0, 5000, 30, 1}, {1.5}, 5), std::nullopt, Heard({0.25, 3000, 30, 2}, {1.5}, 5)};
  const std::vector<PairOffset> pairs = SoundOffsets(tracks, [] {});
  ASSERT_EQ(pairs.size(), 1u);
  EXPECT_EQ(pairs[0].first, 0);
  EXPECT_EQ(pairs[0].second, 2);
  EXPECT_NEAR(pairs[0].ahead_s, 0.25, kWithin_s);
}

}  // namespace
}  // namespace mocap
