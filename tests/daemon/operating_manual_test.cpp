// docs/operating.md against the code: every complaint and every line of the status is explained,
// and nothing is explained that does not exist.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "daemon/status/diagnostics.h"
#include "daemon/status/service_report.h"
#include "daemon/status/status_fields.h"
#include "tests/support/temporary_folder.h"

namespace mocap {
namespace {

/// What stands in the first column of the manual's tables, in backquotes.
std::vector<std::string> FirstColumns() {
  const std::string manual =
      testing::ReadText(std::filesystem::path(MOCAP_SOURCE_DIR) / "docs/operating.md");
  static const std::regex kRow(R"(\| `([^`]+)`)");
  std::vector<std::string> columns;
  std::istringstream lines(manual);
  std::smatch match;
  for (std::string line; std::getline(lines, line);) {
    if (std::regex_search(line, match, kRow, std::regex_constants::match_continuous)) {
      columns.push_back(match[1]);
    }
  }
  return columns;
}

/// Numbers and names differ from case to case.
std::string Pattern(const std::string& text) {
  const std::string without_names = std::regex_replace(text, std::regex("cam\\d+|walk-\\d+"), "@");
  return std::regex_replace(without_names, std::regex(R"([-+]?\d+([.:]\d+)*)"), "#");
}

/// What goes wrong around cameras that are good.
std::vector<ServiceReport> SilentReports() {
  ServiceReport good;
  good.lcm_url = "udpm://239.255.76.67:7667?ttl=0";
  good.fps_nominal = 25;
  good.takes = "/takes";
  good.now.window_ns = 4'000'000'000;
  for (const char* name : {"cam1", "cam2"}) {
    CameraStatus& camera = good.now.status.cameras.emplace_back();
    camera.name = name;
    camera.state = CameraState::kStreaming;
  }
  good.now.frames_per_second = {25, 25};
  good.now.late_per_second = {0, 0};
  std::vector<ServiceReport> reports(8, good);
  reports[0].now.frames_per_second = {0, 0};
  reports[1].now.frames_per_second = {25, 0};
  reports[2].now.sets_per_second = 25;
  reports[2].now.sets_partial_lately = 1;
  reports[3].now.sets_per_second = 25;
  reports[3].now.late_per_second = {25, 0};
  reports[4].age_ns = 12'000'000'000;
  reports[4].disk_stall_ns = 12'000'000'000;
  reports[4].takes_problem = "Read-only file system";
  reports[4].metrics_problem = "/m.prom";
  reports[4].log_fails = true;
  reports[4].delivery.problem = "Network is unreachable";
  reports[5].delivery.channel = {
      .reaches_nobody = true, .other_sender = true, .silent_ns = 12'000'000'000};
  reports[6].delivery.channel.receive_fault = "UDP port 7667 is in use by another program";
  reports[7].now.sets_per_second = 25;
  reports[7].now.frames_per_second = {12, 12.4};
  reports.emplace_back();
  return reports;
}

/// Everything goes wrong that can.
std::vector<std::string> EveryComplaint() {
  ServiceReport report;
  report.fps_nominal = 25;
  report.now.sets_per_second = 25;
  report.now.window_ns = 4'000'000'000;
  report.now.sets_dropped_lately = 12;
  report.keep_free_mb = 500;
  report.takes = "/takes";
  report.calibration.where = "calibration.toml";
  report.calibration_fault = "all cameras hang below the floor";
  report.now.status.people = {9'000'000'000, {}};
  report.nobody_ns = 9'000'000'000;
  report.bytes_free = 3'000'000;
  report.cut_off = {{"/takes/walk-01.partial", 12'300'000'000, 45'296'000'000'000}};
  report.light_change = LightChange{.time_ns = 1, .cameras = {"cam1"}, .factor = 1.4};
  report.moved = {{"cam3", "bottom left, x 8 to 39, y 80 to 111 px", 0.023, 720'000'000'000}};
  report.keypoints.senders.emplace_back().name = "witness";
  report.keypoints.senders.back().agreement = 0.3;
  StageRecorders recorders;
  recorders[Stage::kSpread].Record(15'000'000);
  report.now.recent = StageHistograms(recorders);
  const auto add = [&report](CameraState state, double rate) -> CameraStatus& {
    CameraStatus& camera = report.now.status.cameras.emplace_back();
    camera.name = "cam" + std::to_string(report.now.status.cameras.size());
    camera.state = state;
    report.now.frames_per_second.push_back(rate);
    return camera;
  };
  add(CameraState::kLost, 0);
  add(CameraState::kStarting, 0);
  add(CameraState::kStreaming, 25).is_blind = true;
  CameraStatus& poor = add(CameraState::kStreaming, 20);
  poor.light = 0.4;
  poor.nudged_px = 1.2;
  poor.health = {.moments = 9, .shift_px = {6, 0}, .overlap = 0.7};
  add(CameraState::kStreaming, 25).health.unknown_share = 0.4;
  add(CameraState::kStreaming, 25).health.miss_rate = 0.25;
  for (const char* master : {"cam1", "cam1", "cam3", "cam3"}) {
    add(CameraState::kStreaming, 0).waits_for = master;
  }
  std::set<std::string> all;
  using State = RecordingStatus::State;
  for (const State state : {State::kFailed, State::kComplete, State::kRunning}) {
    report.recording.state = state;
    report.recording.problem = "ended because the disk has 400 MB left";
    report.recording.dropped = 12;
    const std::vector<std::string> some = Diagnostics(report);
    all.insert(some.begin(), some.end());
  }
  report.now.sets_per_second = 0;
  report.now.sets_dropped_lately = 0;
  for (const std::int64_t worked_on : {0, 1}) {
    report.now.status.sets_complete = worked_on;
    const std::vector<std::string> without_sets = Diagnostics(report);
    all.insert(without_sets.begin(), without_sets.end());
  }
  for (ServiceReport& silent : SilentReports()) {
    const std::vector<std::string> some = Diagnostics(silent);
    all.insert(some.begin(), some.end());
  }
  return {all.begin(), all.end()};
}

TEST(OperatingManual, SaysWhatToDoAboutEveryComplaint) {
  const std::vector<std::string> columns = FirstColumns();
  for (const std::string& complaint : EveryComplaint()) {
    EXPECT_TRUE(std::ranges::any_of(columns, [&](const std::string& column) {
      return column.size() > 12 && Pattern(complaint).starts_with(Pattern(column));
    })) << complaint;
  }
}

TEST(OperatingManual, ExplainsEveryLineAndColumnOfTheStatus) {
  const std::vector<std::string> columns = FirstColumns();
  ServiceReport report;
  report.now.status.cameras.emplace_back().name = "cam1";
  report.now.frames_per_second.push_back(0);
  std::istringstream lines(ReportText(report));
  std::set<std::string> labels;
  for (std::string line; std::getline(lines, line);) {
    const std::string first = line.substr(0, line.find(' '));
    if (line.starts_with("  ")) labels.insert(line.substr(2, line.find(' ', 2) - 2));
    if (first == "camera") {
      std::istringstream words(line);
      for (std::string word; words >> word;) labels.insert(word);
    } else if (!first.empty() && first != "cam1" && first != "all" && first != "!") {
      labels.insert(first);
    }
  }
  // Of two words: "off px".
  for (const char* part : {"px", "mocapd"}) labels.erase(part);
  EXPECT_GE(labels.size(), 18u);
  for (const std::string& label : labels) {
    EXPECT_TRUE(std::ranges::any_of(columns, [&](const std::string& column) {
      return column == label || column == label + " px";
    })) << label;
  }
}

TEST(OperatingManual, ExplainsEveryColumnOfPeople) {
  ServiceReport report;
  report.people.emplace_back().id = 1;
  const std::string text = ReportText(report);
  std::string header = text.substr(text.find("\nperson ") + 1);
  header = header.substr(0, header.find('\n'));
  for (const std::string& column : FirstColumns()) {
    if (const std::size_t at = header.find(column); at != std::string::npos) {
      header.replace(at, column.size(), column.size(), ' ');
    }
  }
  EXPECT_EQ(header.find_first_not_of(' '), std::string::npos) << header;
}

TEST(OperatingManual, ExplainsEveryColumnOfKeypoints) {
  const std::vector<std::string> columns = FirstColumns();
  for (const auto& field : KeypointFields()) {
    if (field.column.heading.empty()) continue;
    EXPECT_TRUE(std::ranges::count(columns, field.column.heading)) << field.column.heading;
  }
}

TEST(OperatingManual, TellsOfNoComplaintThatIsNot) {
  std::vector<std::string> patterns;
  for (const std::string& complaint : EveryComplaint()) patterns.push_back(Pattern(complaint));
  for (const std::string& column : FirstColumns()) {
    const bool is_sentence = column.find(' ') != std::string::npos && column.size() > 12;
    if (!is_sentence) continue;
    EXPECT_TRUE(std::ranges::any_of(patterns, [&](const std::string& pattern) {
      return pattern.starts_with(Pattern(column));
    })) << column;
  }
}

}  // namespace
}  // namespace mocap
