#include "tools/doctor_checks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace mocap {
namespace {

using ::testing::HasSubstr;

TEST(DoctorChecks, FiftyGigabytesAreRoomEnough) {
  const Diagnosis good = JudgeSpace("/takes", 56'000, 500, 800);
  EXPECT_EQ(good.grade, Grade::kGood);
  EXPECT_EQ(
      good.what,
      "/takes: 56.0 GB free, room for about 10 min of takes of six cameras (640 x 480, 30 Hz); "
      "the disk writes 800 MB/s");
  EXPECT_EQ(good.fix, "");
}

TEST(DoctorChecks, ADiskOnWhichNothingCanBeRecordedIsBad) {
  EXPECT_EQ(JudgeSpace("/takes", 20'000, 500, 800).grade, Grade::kAdvice);
  const Diagnosis full = JudgeSpace("/takes", 400, 500, 800);
  EXPECT_EQ(full.grade, Grade::kBad);
  EXPECT_THAT(full.what, HasSubstr("0.4 GB free, and recording.keep_free_mb is 500"));
  EXPECT_THAT(full.fix, HasSubstr("recording.folder"));
}

TEST(DoctorChecks, ASlowDiskIsBad) {
  const Diagnosis slow = JudgeSpace("/takes", 56'000, 500, 20);
  EXPECT_EQ(slow.grade, Grade::kBad);
  EXPECT_THAT(slow.fix, HasSubstr("135 MB/s"));
}

TEST(DoctorChecks, AnAddressIsToldOnce) {
  EXPECT_EQ(CheckMessages("memq://").grade, Grade::kBad);
  const Diagnosis wrong = CheckMessages("nonsense");
  EXPECT_EQ(wrong.grade, Grade::kBad);
  EXPECT_EQ(wrong.fix, "") << "the line itself says what is expected";
}

TEST(DoctorChecks, ANodeWhoseMocapdDoesNotAnswerIsNamed) {
  Config config;
  config.nodes = {{"left", {}, {"/bin/sh", "-c", "printf 'failed\\nnothing answers at x'"}},
                  {"right", {}, {"/bin/false"}}};
  const std::vector<Diagnosis> nodes = CheckNodes(config);
  ASSERT_EQ(nodes.size(), 2u);
  EXPECT_EQ(nodes[0].what, "node left: nothing answers at x");
  EXPECT_THAT(nodes[1].what, ::testing::StartsWith("node right: "));
}

}  // namespace
}  // namespace mocap
