// Senders of keypoints in the status, in all its forms.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "daemon/messages/status_messages.h"
#include "daemon/service/metrics_file.h"
#include "daemon/status/diagnostics.h"

namespace mocap {
namespace {

using ::testing::ContainsRegex;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

/// A witness that agrees, as far as is known.
ServiceReport WithWitness(std::optional<double> agreement) {
  ServiceReport report;
  report.fps_nominal = 25;
  report.now.sets_per_second = 25;
  report.now.window_ns = 4'000'000'000;
  report.now.frames_per_second = {25, 25};
  for (const char* name : {"cam1", "cam2"}) {
    CameraStatus& camera = report.now.status.cameras.emplace_back();
    camera.name = name;
    camera.state = CameraState::kStreaming;
  }
  KeypointSender& sender = report.keypoints.senders.emplace_back();
  sender.name = "the \"witness\"";
  sender.views_per_second = 3.04;
  sender.lag_ms = 80;
  sender.taken = 900;
  sender.refused[static_cast<std::size_t>(KeypointRefusal::kOld)] = 4;
  sender.refused[static_cast<std::size_t>(KeypointRefusal::kFull)] = 1;
  sender.agreement = agreement;
  return report;
}

TEST(KeypointReport, IsInTextJsonAndMetrics) {
  const ServiceReport report = WithWitness(0.83);
  EXPECT_THAT(ReportText(report), ContainsRegex("the \"witness\" +3\\.0 +80 +900 +5 +83 %\n"));
  const std::string json = ReportJson(report);
  EXPECT_THAT(json, HasSubstr("\"views_per_second\":3.04,\"lag_ms\":80,\"taken\":900,"));
  EXPECT_THAT(json, HasSubstr("\"refused_old\":4"));
  EXPECT_THAT(json, HasSubstr("\"agreement\":0.83"));
  const std::string metrics = MetricsText(report);
  EXPECT_THAT(metrics,
              HasSubstr("\nmocapd_keypoint_lag_seconds{sender=\"the \\\"witness\\\"\"} 0.08\n"));
  EXPECT_THAT(
      metrics,
      HasSubstr(
          "mocapd_keypoint_refused_total{sender=\"the \\\"witness\\\"\",reason=\"full\"} 1\n"));
}

TEST(KeypointReport, WithoutSendersHasNoLine) {
  ServiceReport report = WithWitness({});
  report.keypoints.senders.clear();
  EXPECT_THAT(ReportText(report), Not(HasSubstr("keypoints")));
  EXPECT_THAT(ReportJson(report), HasSubstr("\"keypoints\":[]"));
}

TEST(KeypointReport, OnlyASenderThatDisagreesIsADiagnostic) {
  EXPECT_THAT(Diagnostics(WithWitness({})), IsEmpty());
  EXPECT_THAT(Diagnostics(WithWitness(0.5)), IsEmpty());
  EXPECT_THAT(Diagnostics(WithWitness(0.31)),
              ElementsAre(HasSubstr("keypoints of the \"witness\" disagree with the poses "
                                    "(agreement 31 %): check")));
  EXPECT_THAT(MetricsText(WithWitness({})), Not(HasSubstr("keypoint_agreement_ratio{")));
}

TEST(KeypointReport, ComesBackFromItsMessage) {
  for (const std::optional<double> agreement : {std::optional<double>(), {0.31}}) {
    const ServiceReport sent = WithWitness(agreement);
    keypoint_senders_t message{};
    FillKeypointSenders(sent, 5, message);
    EXPECT_EQ(message.utime, 5);
    ServiceReport heard;
    TakeKeypointSenders(message, heard);
    ASSERT_EQ(heard.keypoints.senders.size(), 1u);
    const KeypointSender& before = sent.keypoints.senders[0];
    const KeypointSender& after = heard.keypoints.senders[0];
    EXPECT_EQ(after.name, before.name);
    EXPECT_EQ(after.views_per_second, before.views_per_second);
    EXPECT_EQ(after.lag_ms, before.lag_ms);
    EXPECT_EQ(after.taken, before.taken);
    EXPECT_EQ(after.refused, before.refused);
    EXPECT_EQ(after.agreement, agreement);
  }
}

TEST(KeypointReport, OfAHostileMessageNoMoreIsTakenThanThereCanBe) {
  ServiceReport sent = WithWitness(std::nan(""));
  sent.keypoints.senders.resize(1000, sent.keypoints.senders[0]);
  keypoint_senders_t message{};
  FillKeypointSenders(sent, 5, message);
  message.reason[0] = "another";
  message.lag_ms[0] = std::nan("");
  ServiceReport heard;
  TakeKeypointSenders(message, heard);
  EXPECT_LT(heard.keypoints.senders.size(), 10u);
  EXPECT_EQ(heard.keypoints.senders[0].lag_ms, 0);
  EXPECT_FALSE(heard.keypoints.senders[0].agreement);
}

}  // namespace
}  // namespace mocap
