#include "tools/view/shown_keypoints.h"

#include <gtest/gtest.h>

#include "tests/tools/view/number_at.h"

namespace mocap {
namespace {

KeypointView ViewAt(std::int64_t capture_ms, int person, const std::string& sender = "a") {
  return {.camera = "cam1",
          .capture_ns = capture_ms * 1'000'000,
          .person = person,
          .points = {{Landmark::kNose, {1, 2}, 0.5F}},
          .sender = sender};
}

/// The times of the views that are shown [ms].
std::vector<double> Times(const ShownKeypoints& shown) {
  constexpr std::size_t kViewBytes = 32;
  const std::string bytes = shown.Bytes(0);
  std::vector<double> times;
  for (std::size_t at = 0; at < bytes.size(); at += kViewBytes)
    times.push_back(testing::NumberAt<double>(bytes, at + 8));
  return times;
}

TEST(ShownKeypoints, TheNewestViewOfEachPersonOfEachSenderIsShown) {
  ShownKeypoints shown;
  shown.Add(ViewAt(5000, 1));
  shown.Add(ViewAt(5100, 2));
  shown.Add(ViewAt(5200, 1));
  shown.Add(ViewAt(5150, 1, "b"));
  shown.Add(ViewAt(5050, 1));
  EXPECT_EQ(Times(shown), (std::vector<double>{5200, 5100, 5150}));
}

TEST(ShownKeypoints, WhatHasFadedIsLeftOut) {
  ShownKeypoints shown;
  shown.Add(ViewAt(5000, 1));
  shown.Add(ViewAt(5500, 2));
  shown.Add(ViewAt(6001, 3));
  EXPECT_EQ(Times(shown), (std::vector<double>{5500, 6001}));
}

TEST(ShownKeypoints, AClockThatWasSetBackIsBelieved) {
  ShownKeypoints shown;
  shown.Add(ViewAt(9000, 1));
  shown.Add(ViewAt(2000, 1));
  EXPECT_EQ(Times(shown), std::vector<double>{2000});
}

TEST(ShownKeypoints, ACrowdIsCutShort) {
  ShownKeypoints shown;
  for (int person = 0; person < 1000; ++person) shown.Add(ViewAt(5000, person));
  EXPECT_EQ(Times(shown).size(), 64u);
}

}  // namespace
}  // namespace mocap
