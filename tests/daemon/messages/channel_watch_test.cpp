#include "daemon/messages/channel_watch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <memory>
#include <mocap/status_t.hpp>
#include <thread>

#include "core/errors.h"
#include "daemon/messages/open_lcm.h"
#include "tests/support/setup_error.h"
#include "tests/support/taken_port.h"

namespace mocap {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr std::int64_t kOneSecond = 1'000'000'000;

TEST(StatusRegister, OnesOwnStatusesAreNobodyElses) {
  StatusRegister heard;
  for (int i = 0; i < 100; ++i) {
    heard.NoteSent(1000 + i, i * kOneSecond);
    heard.NoteHeard(1000 + i, i * kOneSecond + 1);
    EXPECT_FALSE(heard.Status(i * kOneSecond + 2).other_sender);
    EXPECT_EQ(heard.Status(i * kOneSecond + 2).silent_ns, 0);
  }
}

TEST(StatusRegister, AStatusThatOneDidNotSendIsSomebodyElsesForAWhile) {
  StatusRegister heard;
  heard.NoteSent(1, 0);
  heard.NoteHeard(2, kOneSecond);
  EXPECT_TRUE(heard.Status(2 * kOneSecond).other_sender);
  EXPECT_FALSE(heard.Status(60 * kOneSecond).other_sender) << "it has ended";
}

TEST(StatusRegister, StatusesThatDoNotComeBackAreTold) {
  StatusRegister heard;
  for (int i = 0; i < 8; ++i) heard.NoteSent(i, i * kOneSecond);
  EXPECT_EQ(heard.Status(8 * kOneSecond).silent_ns, 8 * kOneSecond);
  heard.NoteHeard(7, 8 * kOneSecond);
  EXPECT_EQ(heard.Status(9 * kOneSecond).silent_ns, 0);
}

TEST(StatusRegister, SaysNothingBeforeSomethingWasSent) {
  const StatusRegister heard;
  EXPECT_EQ(heard.Status(60 * kOneSecond).silent_ns, 0);
}

TEST(ChannelWatch, WhatStaysInTheProcessReachesNobody) {
  LcmConfig config;
  config.url = "memq://";
  lcm::LCM lcm(config.url);
  LcmSender sender(lcm, LcmProvider::kMemory);
  EXPECT_TRUE(ChannelWatch(config, sender).Status().reaches_nobody);
}

class MulticastChannel : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!HasMulticastRoute()) GTEST_SKIP() << "there is no multicast route";
    config_.url = "udpm://239.255.76.67:" + std::to_string(20000 + getpid() % 40000) + "?ttl=0";
  }
  void Send(lcm::LCM& lcm, const std::string& channel, std::int64_t utime) {
    status_t status{};
    status.utime = utime;
    lcm.publish(channel, &status);
  }
  LcmConfig config_;
};

TEST_F(MulticastChannel, AnotherSenderOfTheSamePrefixIsHeardAndOneOfAnotherIsNot) {
  lcm::LCM lcm(config_.url);
  LcmSender sender(lcm, LcmProvider::kMulticast);
  config_.prefix = "a.b_";
  ChannelWatch watch(config_, sender);
  std::int64_t utime = 0;
  // Until the watch listens, nothing comes back.
  watch.NoteSent(++utime);
  Send(lcm, "axb_MOCAP_STATUS", 1'000'000);
  Send(lcm, "a.b_MOCAP_STATUS", utime);
  EXPECT_FALSE(watch.Status().other_sender);
  while (!watch.Status().other_sender) {
    Send(lcm, "a.b_MOCAP_STATUS", 2'000'000);
    std::this_thread::yield();
  }
  EXPECT_TRUE(watch.Status().other_sender);
  EXPECT_FALSE(watch.Status().reaches_nobody);
}

TEST_F(MulticastChannel, APortOfAnotherProgramIsToldAndLcmPrintsNothing) {
  const testing::TakenPort taken;
  config_.url = taken.Url();
  const std::string said = "UDP port " + taken.number() + " is in use by another program";
  ::testing::internal::CaptureStderr();
  EXPECT_THAT(testing::SetupErrorOf([&] { OpenLcmToListen(config_.url); }),
              AllOf(HasSubstr(config_.url), HasSubstr(said), HasSubstr("ss -ulpn")));
  EXPECT_TRUE(OpenLcm(config_.url)->good()) << "sending needs no port";
  lcm::LCM lcm(config_.url);
  LcmSender sender(lcm, LcmProvider::kMulticast);
  {
    const ChannelWatch watch(config_, sender);
    while (watch.Status().receive_fault.empty()) std::this_thread::yield();
    EXPECT_THAT(watch.Status().receive_fault, HasSubstr(said));
  }
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

TEST_F(MulticastChannel, WithoutAFreeDescriptorThePortIsNotBlamed) {
  rlimit usual{};
  ASSERT_EQ(getrlimit(RLIMIT_NOFILE, &usual), 0);
  const rlimit none{0, usual.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_NOFILE, &none), 0);
  const std::string fault = ReceiveFault(ParseLcmUrl(config_.url));
  ASSERT_EQ(setrlimit(RLIMIT_NOFILE, &usual), 0);
  EXPECT_THAT(fault, ::testing::EndsWith("cannot be used: Too many open files"));
}

TEST_F(MulticastChannel, APortThatListenersShareIsFree) {
  const std::unique_ptr<lcm::LCM> one = OpenLcmToListen(config_.url);
  one->subscribeFunction<int*>(
      "X", [](const lcm::ReceiveBuffer*, const std::string&, int*) {}, nullptr);
  EXPECT_EQ(ReceiveFault(ParseLcmUrl(config_.url)), "");
  EXPECT_TRUE(OpenLcmToListen(config_.url));
}

TEST_F(MulticastChannel, ASecondWayReachesTheSameListeners) {
  lcm::LCM listener(config_.url);
  bool is_heard = false;
  listener.subscribeFunction<bool*>(
      "X", [](const lcm::ReceiveBuffer*, const std::string&, bool* heard) { *heard = true; },
      &is_heard);
  const std::unique_ptr<lcm::LCM> beside = OpenLcmBeside(config_.url);
  ASSERT_TRUE(beside);
  while (!is_heard) {
    beside->publish("X", "x", 1);
    listener.handleTimeout(10);
  }
}

TEST(LcmSender, AMessageThatCannotBeSentIsCountedWithItsReason) {
  // Writing to this device fails as on a full disk.
  lcm::LCM lcm("file:///dev/full?mode=w");
  LcmSender sender(lcm, LcmProvider::kFile);
  const std::string much(100'000, 'x');
  for (int i = 0; i < 3; ++i) sender.Send("X", much.data(), much.size());
  EXPECT_GT(sender.Status().failed, 0);
  EXPECT_EQ(sender.Status().error, ENOSPC);
  EXPECT_GT(sender.Status().last_failed_ns, 0);
}

TEST(LcmSender, ALostServerIsNotAskedForEachMessage) {
  // Nobody listens there, which LCM finds out with the first message.
  lcm::LCM lcm("tcpq://127.0.0.1:9");
  LcmSender sender(lcm, LcmProvider::kTcp);
  EXPECT_FALSE(sender.Send("X", "x", 1));
  EXPECT_TRUE(sender.is_down());
  ::testing::internal::CaptureStderr();
  for (int i = 0; i < 10; ++i) EXPECT_FALSE(sender.Send("X", "x", 1));
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "") << "LCM would have told each time";
  EXPECT_EQ(sender.Status().failed, 11);
}

TEST(OpenLcm, AServerThatIsNotThereIsRefusedAtOnceAndInOneLine) {
  // The port of a service that nobody has.
  for (const auto& open : {+[](const std::string& url) { OpenLcm(url); }, +CheckLcm}) {
    EXPECT_THROW(open("tcpq://127.0.0.1:9"), SetupError);
  }
}

TEST(OpenLcm, ALogAndAProcessHaveNoSecondWay) {
  EXPECT_EQ(OpenLcmBeside("file:///nowhere/x.lcm?mode=w"), nullptr);
  EXPECT_EQ(OpenLcmBeside("memq://"), nullptr);
}

TEST(OpenLcm, ALogThatCannotBeWrittenIsRefused) {
  EXPECT_THROW(OpenLcm("file:///nowhere/x.lcm?mode=w"), SetupError);
  EXPECT_THROW(CheckLcm("file:///nowhere/x.lcm?mode=w"), SetupError);
}

}  // namespace
}  // namespace mocap
