#include "daemon/nodes/host_clock_care.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cctype>

namespace mocap {
namespace {

using ::testing::AnyOf;
using ::testing::SizeIs;

TEST(ClockKeeper, IsFoundAmongProcessesAndUnits) {
  EXPECT_EQ(FindClockKeeper({"bash", "chronyd", "sshd"}), "chronyd");
  EXPECT_EQ(FindClockKeeper({"ssh.service", "systemd-timesyncd.service"}), "systemd-timesyncd");
  EXPECT_EQ(FindClockKeeper({"bash", "ssh.service"}), "");
}

TEST(ClockKeeper, IsWhatKeepsPtpWhereThatRuns) {
  EXPECT_EQ(FindClockKeeper({"chrony.service", "ptp4l@eth0.service", "phc2sys@eth0.service"}),
            "phc2sys");
}

TEST(BootName, IsTheSameWhoeverTellsIt) {
  const std::string name = BootName();
  EXPECT_THAT(name, AnyOf(SizeIs(0), SizeIs(32)));
  for (const char digit : name) EXPECT_TRUE(std::isxdigit(digit)) << name;
}

}  // namespace
}  // namespace mocap
