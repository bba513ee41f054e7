#include "daemon/status/service_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "daemon/service/metrics_file.h"
#include "daemon/status/diagnostics.h"
#include "tests/support/temporary_folder.h"

namespace mocap {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

/// Two cameras at 25 frames a second, as it should be.
ServiceReport Good() {
  ServiceReport report;
  report.fps_nominal = 25;
  report.studio = "small";
  report.now.sets_per_second = 25;
  report.now.window_ns = 4'000'000'000;
  for (const char* name : {"cam1", "cam2"}) {
    CameraStatus camera;
    camera.name = name;
    camera.state = CameraState::kStreaming;
    camera.frames = 1000;
    report.now.status.cameras.push_back(camera);
    report.now.frames_per_second.push_back(25);
  }
  return report;
}

TEST(ServiceReport, SaysThatAllIsGood) {
  EXPECT_THAT(Diagnostics(Good()), IsEmpty());
  EXPECT_THAT(ReportText(Good()), StartsWith("all is good\n"));
  EXPECT_THAT(ReportJson(Good()), HasSubstr("\"good\":true"));
}

TEST(ServiceReport, NamesFromOutsideForgeNoLineAndReachNoTerminal) {
  ServiceReport report = Good();
  report.studio = "x\x1b]0;owned\x07\n! forged \xff\xe2\x80\xae";
  report.recording.state = RecordingStatus::State::kFailed;
  report.recording.problem = report.studio;
  report.background.where = report.studio;
  for (const std::string& text : {ReportText(report), BackgroundText(report)}) {
    EXPECT_THAT(text, Not(HasSubstr("\x1b")));
    EXPECT_THAT(text, Not(HasSubstr("\n! forged")));
    EXPECT_THAT(text, HasSubstr("x\\x1b]0;owned\\x07\\x0a! forged \\xff\\u{202e}"));
  }
  EXPECT_THAT(ReportJson(report),
              HasSubstr("\"studio\":\"x\\u001b]0;owned\\u0007\\n! forged \\ufffd\\u202e\""));
}

TEST(ServiceReport, TellsOfEachWhoIsFollowed) {
  ServiceReport report = Good();
  EXPECT_THAT(ReportJson(report), HasSubstr("\"people\":[]"));
  report.now.status.state = CaptureState::kTracking;
  report.people_ns = 100'000'000'000;
  report.people.push_back({.id = 3,
                           .name = "anna",
                           .certainty = 0.962,
                           .state = CaptureState::kTracking,
                           .torso_W = Vector3(1234, -500, 1000),
                           .residual_mm = 11.5,
                           .sizes = AverageSizes(1700),
                           .since_ns = 88'000'000'000});
  EXPECT_THAT(ReportLine(report), Not(HasSubstr("people")));
  report.people.push_back({.id = 4, .state = CaptureState::kLost});
  EXPECT_THAT(ReportLine(report), HasSubstr("2 people"));
  EXPECT_THAT(ReportText(report),
              ::testing::ContainsRegex(
                  "3  anna \\(96 %\\) +tracking +1\\.23 -0\\.50 +12 +1[67].. +12 s\n"));
  EXPECT_THAT(ReportText(report), ::testing::ContainsRegex("\n4 +lost .* - "));
  const std::string json = ReportJson(report);
  EXPECT_THAT(json, HasSubstr("{\"id\":3,\"name\":\"anna\",\"name_certainty\":0.962,"
                              "\"state\":\"tracking\","
                              "\"x_mm\":1234,\"y_mm\":-500,\"z_mm\":1000,"
                              "\"residual_mm\":11.5,"));
  EXPECT_THAT(json, HasSubstr("\"seconds\":12}"));
  EXPECT_THAT(MetricsText(report), HasSubstr("\nmocapd_people 2\n"));
}

TEST(ServiceReport, NamesTheCameraThatIsLostOrSlow) {
  ServiceReport report = Good();
  report.now.status.cameras[0].state = CameraState::kLost;
  report.now.frames_per_second[0] = 0;
  report.now.frames_per_second[1] = 20;
  EXPECT_THAT(Diagnostics(report),
              ElementsAre(StartsWith("cam1 is lost"), StartsWith("cam2 delivers 20.0 of 25.0"),
                          StartsWith("only cam2 delivers frames")));
  EXPECT_THAT(ReportText(report), StartsWith("! cam1 is lost"));
  EXPECT_THAT(ReportLine(report), HasSubstr("1 of 2 cameras; cam1 is lost"));
}

TEST(ServiceReport, SaysOnceOfWhomCamerasWaitForTheTrigger) {
  ServiceReport report = Good();
  CameraStatus third = report.now.status.cameras[1];
  third.name = "cam3";
  third.state = CameraState::kStarting;
  report.now.status.cameras.push_back(third);
  for (const std::size_t i : {1, 2}) report.now.status.cameras[i].waits_for = "cam1";
  report.now.frames_per_second = {25, 25, 0};
  EXPECT_THAT(Diagnostics(report), ElementsAre(StartsWith("no trigger from cam1 reaches cam3: ")));
  report.now.status.cameras[0].state = CameraState::kLost;
  report.now.frames_per_second = {0, 0, 0};
  report.now.sets_per_second = 0;
  EXPECT_THAT(Diagnostics(report),
              ElementsAre(StartsWith("cam1 is lost"),
                          "waiting for the trigger of cam1, which is lost: cam2, cam3"));
}

TEST(ServiceReport, ACameraIsHeldAgainstItsOwnRate) {
  ServiceReport report = Good();
  report.camera_fps = {0, 10};
  report.now.frames_per_second[1] = 10;
  EXPECT_THAT(Diagnostics(report), IsEmpty());
  report.now.frames_per_second[1] = 5;
  EXPECT_THAT(Diagnostics(report), ElementsAre(StartsWith("cam2 delivers 5.0 of 10.0")));
}

TEST(ServiceReport, CamerasWithoutSetsAreNotGood) {
  ServiceReport report = Good();
  report.now.sets_per_second = 0;
  EXPECT_THAT(Diagnostics(report),
              ElementsAre(StartsWith("no frame sets are formed, although 2 of 2")));
}

TEST(ServiceReport, CamerasThatAllFallSilentAreNotGood) {
  ServiceReport report = Good();
  report.now.sets_per_second = 0;
  report.now.frames_per_second = {0, 0};
  EXPECT_THAT(Diagnostics(report), ElementsAre(StartsWith("no camera delivers frames")));
  for (CameraStatus& camera : report.now.status.cameras) camera.state = CameraState::kLost;
  EXPECT_THAT(Diagnostics(report),
              ElementsAre("cam1, cam2 are lost: check their cables and power"));
}

TEST(ServiceReport, OneCameraAloneIsNotGood) {
  ServiceReport report = Good();
  report.now.sets_per_second = 0;
  report.now.frames_per_second = {25, 0};
  EXPECT_THAT(Diagnostics(report), ElementsAre(StartsWith("only cam1 delivers frames")));
  report.now.status.cameras.pop_back();
  report.now.frames_per_second = {25};
  EXPECT_THAT(Diagnostics(report), ElementsAre(StartsWith("only cam1 delivers frames")));
  report.now.sets_per_second = 25;
  EXPECT_THAT(Diagnostics(report), ElementsAre(StartsWith("only cam1 delivers frames")))
      << "sets of one picture carve nobody";
}

TEST(ServiceReport, SetsThatNeverAreCompleteAreNotGood) {
  ServiceReport report = Good();
  report.now.late_per_second = {0, 0};
  report.now.sets_partial_lately = 100;
  EXPECT_THAT(Diagnostics(report), ElementsAre(StartsWith("no frame set is complete")));
  report.now.late_per_second = {0, 25};
  EXPECT_THAT(Diagnostics(report),
              ElementsAre(StartsWith("frames arrive too late for their sets: cam2: ")));
  report.now.sets_complete_lately = 100;
  report.now.late_per_second = {0, 1};
  EXPECT_THAT(Diagnostics(report), IsEmpty()) << "now and then is no matter";
}

TEST(ServiceReport, PosesThatReachNobodyAreNotGood) {
  ServiceReport report = Good();
  report.lcm_url = "udpm://x";
  report.delivery.problem = "Network is unreachable";
  EXPECT_THAT(Diagnostics(report),
              ElementsAre(StartsWith("poses cannot be sent to udpm://x: Network is unreachable")));
  report.delivery = {};
  report.delivery.channel.silent_ns = 9'000'000'000;
  EXPECT_THAT(
      Diagnostics(report),
      ElementsAre(StartsWith("mocapd has received none of its own messages on udpm://x for")));
  report.delivery = {};
  report.delivery.channel = {.receive_fault = "UDP port 7 is in use", .silent_ns = 9'000'000'000};
  EXPECT_THAT(Diagnostics(report),
              ElementsAre("nothing can be received here on udpm://x: UDP port 7 is in use"));
  report.delivery = {};
  report.delivery.channel.other_sender = true;
  EXPECT_THAT(Diagnostics(report), ElementsAre(StartsWith("another mocapd, or a log")));
  report.delivery = {};
  report.delivery.channel.reaches_nobody = true;
  EXPECT_THAT(Diagnostics(report), ElementsAre(StartsWith("poses are not sent to other programs")));
}

TEST(ServiceReport, WhatNobodyRenewedIsNotGood) {
  ServiceReport report = Good();
  report.age_ns = 3'000'000'000;
  EXPECT_THAT(Diagnostics(report), IsEmpty());
  report.age_ns = 12'000'000'000;
  EXPECT_THAT(Diagnostics(report),
              ElementsAre(StartsWith("mocapd's main thread has not responded")));
  EXPECT_THAT(Diagnostics(ServiceReport{}), ElementsAre(StartsWith("no status yet")));
}

TEST(ServiceReport, ADiskThatFailsOrStallsIsNotGood) {
  ServiceReport report = Good();
  report.takes = "/takes";
  report.disk_stall_ns = 12'000'000'000;
  report.takes_problem = "Read-only file system";
  report.metrics_problem = "/m.prom";
  report.log_fails = true;
  EXPECT_THAT(Diagnostics(report),
              ElementsAre(StartsWith("the disk has not responded for 12 s"),
                          StartsWith("takes cannot be written to /takes: Read-only file system"),
                          "metrics cannot be written to /m.prom", StartsWith("the log cannot be")));
}

TEST(ServiceReport, SpaceIsToBeFreedWhereThereIsAFolder) {
  ServiceReport report = Good();
  report.takes = "/disk/takes";
  report.takes_place = "/disk";
  report.bytes_free = 3'000'000;
  report.keep_free_mb = 500;
  EXPECT_THAT(Diagnostics(report), ElementsAre(::testing::EndsWith("free some space in /disk")));
}

TEST(ServiceReport, WhatARecordingLostIsToldWithItsCause) {
  ServiceReport report = Good();
  report.recording.state = RecordingStatus::State::kRunning;
  report.recording.dropped = 12;
  report.recording.cause = LossCause::kOtherWork;
  EXPECT_THAT(Diagnostics(report),
              ElementsAre(StartsWith(
                  "12 frames dropped from the recording: the processor was busy with other")));
}

TEST(ServiceReport, DoesNotBlameCamerasForASetThatTakesLong) {
  ServiceReport report = Good();
  report.now.sets_per_second = 0;
  ++report.now.status.sets_complete;
  EXPECT_THAT(Diagnostics(report), ElementsAre(StartsWith("processing a frame set takes several")));
}

TEST(ServiceReport, SaysNothingOfSetsInTheFirstSeconds) {
  ServiceReport report = Good();
  report.now.window_ns = 1'000'000'000;
  report.now.sets_per_second = 0;
  EXPECT_THAT(Diagnostics(report), IsEmpty());
  ++report.now.status.sets_complete;
  EXPECT_THAT(Diagnostics(report), IsEmpty()) << "the first set may be in processing";
  report.now.frames_per_second = {25, 0};
  EXPECT_THAT(Diagnostics(report), IsEmpty()) << "cam2 may still be starting";
}

TEST(ServiceReport, DoesNotBlameCamerasForSetsThatTheProcessorLeftOut) {
  ServiceReport report = Good();
  report.now.sets_per_second = 0;
  report.now.sets_dropped_lately = 3;
  EXPECT_THAT(Diagnostics(report), ElementsAre(StartsWith("3 frame sets were dropped recently")));
}

TEST(ServiceReport, NamesSetsLeftOutAndCamerasOutOfStep) {
  ServiceReport report = Good();
  report.now.sets_dropped_lately = 3;
  StageRecorders recorders;
  recorders[Stage::kSpread].Record(15'000'000);
  report.now.recent = StageHistograms(recorders);
  EXPECT_THAT(Diagnostics(report),
              ElementsAre(StartsWith("3 frame sets were dropped"), HasSubstr("ms apart")));
}

TEST(ServiceReport, AFailedRecordingComesFirst) {
  ServiceReport report = Good();
  report.now.sets_dropped_lately = 3;
  report.recording.state = RecordingStatus::State::kFailed;
  report.recording.problem = "the disk is gone";
  EXPECT_EQ(Diagnostics(report).front(), "the recording failed: the disk is gone");
}

TEST(ServiceReport, SomebodyWhoIsSeenAndNotFoundIsNotGood) {
  ServiceReport report = Good();
  report.now.status.people = {60'000'000'000, {}};
  report.nobody_ns = 4'000'000'000;
  EXPECT_THAT(Diagnostics(report), IsEmpty()) << "a search may take some seconds";
  report.nobody_ns = 9'000'000'000;
  EXPECT_THAT(Diagnostics(report), ElementsAre(HasSubstr("has not been found for 9 s: check")));
  report.now.status.people.fault = {Severity::kWrong, "cam1 and cam2 are exchanged"};
  EXPECT_THAT(Diagnostics(report),
              ElementsAre(HasSubstr("found for 9 s: cam1 and cam2 are exchanged")));
  report.nobody_ns = 0;
  EXPECT_THAT(Diagnostics(report), IsEmpty());
}

TEST(ServiceReport, WhoHasJustComeIsNotMissedSinceTheRoomWasEmptied) {
  ServiceReport report = Good();
  report.nobody_ns = 9 * 3600'000'000'000;
  report.now.status.people = {6'000'000'000, {}};
  EXPECT_THAT(Diagnostics(report), ElementsAre(HasSubstr("has not been found for 6 s")));
  report.now.sets_per_second = 0;
  for (const std::string& line : Diagnostics(report))
    EXPECT_THAT(line, Not(HasSubstr("person is moving"))) << "without sets nothing is known";
}

TEST(ServiceReport, AnEmptyRoomIsGood) {
  ServiceReport report = Good();
  report.nobody_ns = 3600'000'000'000;
  EXPECT_THAT(Diagnostics(report), IsEmpty());
}

TEST(ServiceReport, ACalibrationThatCannotBeRightIsNotGood) {
  ServiceReport report = Good();
  report.calibration.where = "calibration.toml";
  report.calibration_fault = "z points down";
  EXPECT_THAT(Diagnostics(report), ElementsAre("calibration.toml: z points down"));
}

TEST(ServiceReport, ANodeThatNoStudioHearsIsNotGood) {
  ServiceReport report = Good();
  report.node = "left";
  report.lcm_url = "udpm://239.255.76.67:7667?ttl=0";
  report.link = StudioLink{};
  EXPECT_THAT(Diagnostics(report), IsEmpty());
  report.link->silent_ns = 7'000'000'000;
  EXPECT_THAT(Diagnostics(report),
              ElementsAre(::testing::AllOf(HasSubstr("no studio has been heard"),
                                           HasSubstr("for 7 s"), HasSubstr("ttl=0"))));
  report.lcm_url = "udpm://239.255.76.67:7667?ttl=1";
  EXPECT_THAT(Diagnostics(report), ElementsAre(Not(HasSubstr("ttl=0"))));
  report.link = StudioLink{0, {"cam2"}};
  EXPECT_THAT(Diagnostics(report), ElementsAre(HasSubstr("the studio does not receive cam2")));
  report.now.status.cameras[1].state = CameraState::kLost;
  EXPECT_THAT(Diagnostics(report), ElementsAre(HasSubstr("cam2 is lost")));
}

TEST(ServiceReport, TellsWhatEachCameraDoesNotKnowOrMissesOfThePeopleItHasSeen) {
  ServiceReport report = Good();
  report.now.status.cameras[1].health.unknown_share = 0.125;
  EXPECT_THAT(ReportJson(report), HasSubstr("\"unknown_share\":-1"));
  EXPECT_THAT(ReportJson(report), HasSubstr("\"unknown_share\":0.125"));
  EXPECT_THAT(ReportText(report), HasSubstr("     12 %        -\n"));
  EXPECT_THAT(MetricsText(report),
              HasSubstr("mocapd_camera_unknown_ratio{camera=\"cam2\"} 0.125\n"));
  EXPECT_THAT(MetricsText(report), Not(HasSubstr("unknown_ratio{camera=\"cam1\"}")));
  report.now.status.cameras[1].health.miss_rate = 0.25;
  EXPECT_THAT(ReportJson(report), HasSubstr("\"miss_rate\":0.25"));
  EXPECT_THAT(ReportText(report), HasSubstr(" 25 %\n"));
  EXPECT_THAT(MetricsText(report), HasSubstr("mocapd_camera_miss_ratio{camera=\"cam2\"} 0.25\n"));
}

TEST(ServiceReport, NamesOnlyTheCameraThatIsFarthestFromTheOthers) {
  ServiceReport report = Good();
  report.now.status.cameras[0].health = {.moments = 9, .shift_px = {2.5, 0}, .overlap = 0.8};
  report.now.status.cameras[1].health = {.moments = 9, .shift_px = {0, -6}, .overlap = 0.7};
  EXPECT_THAT(Diagnostics(report), ElementsAre(StartsWith("cam2 sees the person 6.0 px away")));
  report.now.status.cameras[1].health.moments = HealthWatch::kFewestMoments - 1;
  EXPECT_THAT(Diagnostics(report), ElementsAre(StartsWith("cam1 sees the person 2.5 px away")))
      << "what was hardly compared says nothing";
}

TEST(ServiceReport, TellsAgesInWords) {
  ServiceReport report = Good();
  report.epoch_s = 2'000'000;
  report.calibration = {"/etc/c.toml", report.epoch_s - 9 * 86'400};
  report.background = {"/var/b", report.epoch_s - 3 * 3600};
  EXPECT_THAT(ReportText(report), HasSubstr("calibration  9 days old, /etc/c.toml"));
  EXPECT_THAT(BackgroundText(report), StartsWith("3 h old, /var/b\n"));
}

TEST(ServiceReport, ATakeThatWasCutOffIsToldWithWhatItHolds) {
  ServiceReport report = Good();
  report.cut_off = {{"/takes/walk.partial", 12'300'000'000, 45'296'000'000'000}};
  EXPECT_THAT(
      Diagnostics(report),
      ElementsAre(StartsWith("the recording walk was cut off at 12:34:56 UTC after 12.3 s")));
}

TEST(MetricsFile, HasOneHeadForEachFamilyAndOneSampleForEachCamera) {
  const std::string text = MetricsText(Good());
  EXPECT_THAT(text, HasSubstr("# TYPE mocapd_camera_frames_total counter\n"
                              "mocapd_camera_frames_total{camera=\"cam1\"} 1000\n"
                              "mocapd_camera_frames_total{camera=\"cam2\"} 1000\n"));
  EXPECT_THAT(text, HasSubstr("mocapd_state{state=\"searching\"} 1\n"));
  EXPECT_THAT(text, HasSubstr("mocapd_complaints 0\n"));
}

TEST(MetricsFile, APlaceThatCannotBeWrittenIsWeather) {
  const testing::TemporaryFolder folder;
  EXPECT_TRUE(WriteMetrics(folder.path() / "mocapd.prom", MetricsText(Good())));
  EXPECT_FALSE(WriteMetrics(folder.path() / "nowhere" / "mocapd.prom", MetricsText(Good())));
}

}  // namespace
}  // namespace mocap
