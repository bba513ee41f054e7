#include "daemon/pipeline/keypoint_inbox.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace mocap {
namespace {

constexpr std::int64_t kMillisecond = 1'000'000;
constexpr std::int64_t kSecond = 1000 * kMillisecond;
/// Captures and the steady clock begin at different times.
constexpr std::int64_t kApart = 500 * kSecond;

/// An inbox, and a sender whose views arrive 100 ms after their capture.
class KeypointInboxTest : public ::testing::Test {
 protected:
  static KeypointView ViewAt(std::int64_t capture_ns, int points = 1) {
    return {.camera = "cam1",
            .capture_ns = capture_ns,
            .person = 0,
            .points = std::vector<Keypoint>(static_cast<std::size_t>(points))};
  }
  bool Add(std::int64_t capture_ns, std::int64_t lag_ns = 100 * kMillisecond,
           const std::string& sender = "witness") {
    const std::int64_t now_ns = capture_ns + lag_ns;
    return inbox_.Add(sender, ViewAt(capture_ns), 0, now_ns, now_ns - kApart);
  }
  std::size_t TakenFor(std::int64_t capture_ns) {
    inbox_.TakeFor(capture_ns, views_);
    return views_.size();
  }
  KeypointSender Only(std::int64_t now_ns) {
    const KeypointsReport report = inbox_.Report(now_ns - kApart);
    EXPECT_EQ(report.senders.size(), 1u);
    return report.senders.empty() ? KeypointSender() : report.senders.front();
  }
  static std::int64_t CountOf(const KeypointSender& sender, KeypointRefusal reason) {
    return sender.refused[static_cast<std::size_t>(reason)];
  }

  KeypointInbox inbox_;
  std::vector<KeypointView> views_;
};

constexpr std::int64_t kBegin = 1000 * kSecond;

TEST_F(KeypointInboxTest, GivesEachViewOnce) {
  EXPECT_TRUE(Add(kBegin));
  EXPECT_TRUE(Add(kBegin + kMillisecond));
  EXPECT_EQ(TakenFor(kBegin + 100 * kMillisecond), 2u);
  EXPECT_EQ(views_[0].capture_ns, kBegin);
  EXPECT_EQ(views_[1].capture_ns, kBegin + kMillisecond);
  EXPECT_EQ(TakenFor(kBegin + 133 * kMillisecond), 0u);
}

TEST_F(KeypointInboxTest, KeepsViewsOfLaterMomentsForLaterSets) {
  Add(kBegin + 200 * kMillisecond);
  Add(kBegin);
  EXPECT_EQ(TakenFor(kBegin), 1u);
  EXPECT_EQ(TakenFor(kBegin + 199 * kMillisecond), 0u);
  EXPECT_EQ(TakenFor(kBegin + 200 * kMillisecond), 1u);
}

TEST_F(KeypointInboxTest, RefusesWhatIsNotOfItsMemory) {
  EXPECT_TRUE(Add(kBegin, kSecond));
  EXPECT_FALSE(Add(kBegin, kSecond + 1));
  EXPECT_FALSE(Add(kBegin, 3600 * kSecond));
  EXPECT_FALSE(Add(kBegin + 3700 * kSecond, -kSecond - 1));
  const KeypointSender sender = Only(kBegin + 3700 * kSecond);
  EXPECT_EQ(CountOf(sender, KeypointRefusal::kOld), 3) << "the first was never taken";
  EXPECT_EQ(CountOf(sender, KeypointRefusal::kAhead), 1);
  EXPECT_EQ(sender.taken, 0);
  EXPECT_EQ(TakenFor(kBegin + 3700 * kSecond), 0u);
}

TEST_F(KeypointInboxTest, RefusesViewsWithoutPoints) {
  EXPECT_FALSE(inbox_.Add("witness", ViewAt(kBegin, 0), 17, kBegin, kBegin - kApart));
  EXPECT_TRUE(inbox_.Add("witness", ViewAt(kBegin, 3), 2, kBegin, kBegin - kApart));
  const KeypointSender sender = Only(kBegin);
  EXPECT_EQ(CountOf(sender, KeypointRefusal::kEmpty), 1);
  EXPECT_EQ(sender.dropped_points, 2);
}

TEST_F(KeypointInboxTest, ASenderWhoSendsTooMuchDoesNotDisplaceOthers) {
  for (std::size_t i = 0; i < 3 * KeypointInbox::kMostWaiting; ++i) Add(kBegin);
  EXPECT_TRUE(Add(kBegin, 0, "other"));
  EXPECT_EQ(TakenFor(kBegin), KeypointInbox::kMostWaiting + 1);
  const KeypointsReport report = inbox_.Report(kBegin - kApart);
  ASSERT_EQ(report.senders.size(), 2u);
  EXPECT_EQ(report.senders[0].name, "other");
  EXPECT_EQ(report.senders[1].RefusedInAll(), 2 * std::int64_t{KeypointInbox::kMostWaiting});
}

TEST_F(KeypointInboxTest, TooManySendersAreCountedTogether) {
  for (int i = 0; i < 1000; ++i) Add(kBegin, 0, "sender " + std::to_string(i));
  inbox_.Refuse("one more", KeypointRefusal::kCamera, kBegin - kApart);
  inbox_.Refuse("", KeypointRefusal::kInvalid, kBegin - kApart);
  const KeypointsReport report = inbox_.Report(kBegin - kApart);
  EXPECT_EQ(report.senders.size(), KeypointInbox::kMostSenders);
  EXPECT_EQ(report.strangers, 1000 - std::int64_t{KeypointInbox::kMostSenders} + 2);
}

TEST_F(KeypointInboxTest, SilentSendersMakeRoom) {
  for (std::size_t i = 0; i < KeypointInbox::kMostSenders; ++i)
    Add(kBegin, 0, "sender " + std::to_string(i));
  const std::int64_t later_ns = kBegin + KeypointInbox::kForgetNs + kSecond;
  EXPECT_TRUE(Add(later_ns, 0));
  EXPECT_EQ(Only(later_ns).name, "witness");
}

TEST_F(KeypointInboxTest, TellsRateAndLag) {
  for (int i = 0; i < 60; ++i)
    Add(kBegin + i * 100 * kMillisecond, (i % 2 == 0 ? 80 : 90) * kMillisecond);
  const KeypointSender sender = Only(kBegin + 6 * kSecond);
  EXPECT_NEAR(sender.views_per_second, 10, 0.5);
  EXPECT_NEAR(sender.lag_ms, 85, 5);
  EXPECT_EQ(sender.taken + sender.RefusedInAll(), 60);
  EXPECT_EQ(Only(kBegin + 20 * kSecond).views_per_second, 0) << "a while ago";
}

TEST_F(KeypointInboxTest, TellsHowWellASenderAgreesLately) {
  Add(kBegin);
  EXPECT_FALSE(Only(kBegin).agreement);
  const std::int64_t steady_ns = kBegin - kApart;
  for (const double agreement : {0.9, 0.8, 0.1}) inbox_.Tell("witness", agreement, steady_ns);
  inbox_.Tell("witness", std::nan(""), steady_ns);
  inbox_.Tell("nobody", 0.3, steady_ns);
  EXPECT_EQ(Only(kBegin).agreement, 0.8);
  EXPECT_FALSE(Only(kBegin + 10 * kSecond).agreement);
}

}  // namespace
}  // namespace mocap
