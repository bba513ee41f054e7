#include "daemon/service/diagnostic_log.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/heap_bytes.h"

namespace mocap {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr std::int64_t kSecond = 1'000'000'000;

class DiagnosticLogTest : public ::testing::Test {
 protected:
  std::vector<std::string> At(std::int64_t seconds, const std::vector<std::string>& complaints) {
    return log_.Add(complaints, seconds * kSecond);
  }
  DiagnosticLog log_;
};

TEST_F(DiagnosticLogTest, TellsOnceWhatLastsThoughItsNumbersChange) {
  std::vector<std::string> told;
  for (int i = 1; i <= 30; ++i) {
    for (const std::string& line : At(i, {"cam1 gives " + std::to_string(i) + ".5 frames"})) {
      told.push_back(line);
    }
  }
  EXPECT_THAT(told, ElementsAre("cam1 gives 3.5 frames"));
}

TEST_F(DiagnosticLogTest, WhatPassesAtOnceIsNotTold) {
  EXPECT_THAT(At(1, {"a hiccup"}), IsEmpty());
  for (int i = 2; i < 30; ++i) EXPECT_THAT(At(i, {}), IsEmpty());
}

TEST_F(DiagnosticLogTest, SaysWhenAllHasBecomeGood) {
  for (int i = 1; i <= 5; ++i) At(i, {"bad"});
  std::vector<std::string> told;
  for (int i = 6; i <= 40; ++i) {
    for (const std::string& line : At(i, {})) told.push_back(line);
  }
  EXPECT_THAT(told, ElementsAre("all is good again"));
}

TEST_F(DiagnosticLogTest, WhatComesAndGoesDoesNotFillTheLog) {
  std::size_t told = 0;
  for (int i = 1; i < 800; ++i) {
    if (i % 40 < 20) {
      told += At(i, {"now and then"}).size();
    } else {
      At(i, {});
    }
  }
  EXPECT_EQ(told, 1u);
}

TEST_F(DiagnosticLogTest, ForgetsWhatHasNotComeBackForLong) {
  if (!kCountsAllocations) GTEST_SKIP() << "the sanitizer allocates by itself";
  std::vector<std::string> complaints;
  for (char c = 'a'; c <= 'z'; ++c) complaints.emplace_back(200, c);
  At(1, complaints);
  const std::int64_t before = HeapBytes();
  At(2, {});
  EXPECT_EQ(HeapBytes(), before);
  At(20, {});
  EXPECT_LT(HeapBytes() - before, -26 * 200);
}

}  // namespace
}  // namespace mocap
