#include "daemon/service/service_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "daemon/service/complaints.h"
#include "daemon/service/metrics_file.h"
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
  EXPECT_THAT(Complaints(Good()), IsEmpty());
  EXPECT_THAT(ReportText(Good()), StartsWith("all is good\n"));
  EXPECT_THAT(ReportJson(Good()), HasSubstr("\"good\": true"));
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
              HasSubstr("\"studio\": \"x\\u001b]0;owned\\u0007\\u000a! forged \\ufffd\\u202e\""));
}

TEST(ServiceReport, NamesTheCameraThatIsLostOrSlow) {
  ServiceReport report = Good();
  report.now.status.cameras[0].state = CameraState::kLost;
  report.now.frames_per_second[0] = 0;
  report.now.frames_per_second[1] = 20;
  EXPECT_THAT(Complaints(report),
              ElementsAre(StartsWith("cam1 is lost"), StartsWith("cam2 gives 20.0 of 25.0")));
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
  EXPECT_THAT(Complaints(report), ElementsAre(StartsWith("no trigger of cam1 reaches cam3: ")));
  report.now.status.cameras[0].state = CameraState::kLost;
  report.now.frames_per_second = {0, 0, 0};
  report.now.sets_per_second = 0;
  EXPECT_THAT(Complaints(report),
              ElementsAre(StartsWith("cam1 is lost"),
                          "waiting for the trigger of cam1, which is lost: cam2, cam3"));
}

TEST(ServiceReport, ACameraIsHeldAgainstItsOwnRate) {
  ServiceReport report = Good();
  report.camera_fps = {0, 10};
  report.now.frames_per_second[1] = 10;
  EXPECT_THAT(Complaints(report), IsEmpty());
  report.now.frames_per_second[1] = 5;
  EXPECT_THAT(Complaints(report), ElementsAre(StartsWith("cam2 gives 5.0 of 10.0")));
}

TEST(ServiceReport, CamerasWithoutSetsAreNotGood) {
  ServiceReport report = Good();
  report.now.sets_per_second = 0;
  EXPECT_THAT(Complaints(report),
              ElementsAre(StartsWith("no frame sets come about, though 2 of 2")));
  report.now.frames_per_second = {0, 0};
  EXPECT_THAT(Complaints(report), IsEmpty()) << "nothing was counted yet";
}

TEST(ServiceReport, DoesNotBlameCamerasForASetThatTakesLong) {
  ServiceReport report = Good();
  report.now.sets_per_second = 0;
  ++report.now.status.sets_complete;
  EXPECT_THAT(Complaints(report), ElementsAre(StartsWith("a frame set has been worked on")));
}

TEST(ServiceReport, DoesNotBlameCamerasForSetsThatTheProcessorLeftOut) {
  ServiceReport report = Good();
  report.now.sets_per_second = 0;
  report.now.sets_dropped_lately = 3;
  EXPECT_THAT(Complaints(report), ElementsAre(StartsWith("3 frame sets were left out lately")));
}

TEST(ServiceReport, NamesSetsLeftOutAndCamerasOutOfStep) {
  ServiceReport report = Good();
  report.now.sets_dropped_lately = 3;
  StageRecorders recorders;
  recorders[Stage::kSpread].Record(15'000'000);
  report.now.recent = StageHistograms(recorders);
  EXPECT_THAT(Complaints(report),
              ElementsAre(StartsWith("3 frame sets were left out"), HasSubstr("ms apart")));
}

TEST(ServiceReport, AFailedRecordingComesFirst) {
  ServiceReport report = Good();
  report.now.sets_dropped_lately = 3;
  report.recording.state = RecordingStatus::State::kFailed;
  report.recording.problem = "the disk is gone";
  EXPECT_EQ(Complaints(report).front(), "the recording failed: the disk is gone");
}

TEST(ServiceReport, NamesOnlyTheCameraThatIsFarthestFromTheOthers) {
  ServiceReport report = Good();
  report.now.status.cameras[0].health = {.moments = 9, .shift_px = {2.5, 0}, .overlap = 0.8};
  report.now.status.cameras[1].health = {.moments = 9, .shift_px = {0, -6}, .overlap = 0.7};
  EXPECT_THAT(Complaints(report), ElementsAre(StartsWith("cam2 sees the person 6.0 px beside")));
  report.now.status.cameras[1].health.moments = HealthWatch::kFewestMoments - 1;
  EXPECT_THAT(Complaints(report), ElementsAre(StartsWith("cam1 sees the person 2.5 px beside")))
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
      Complaints(report),
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
  EXPECT_TRUE(WriteMetrics(folder.path() / "mocapd.prom", Good()));
  EXPECT_FALSE(WriteMetrics(folder.path() / "nowhere" / "mocapd.prom", Good()));
}

}  // namespace
}  // namespace mocap
