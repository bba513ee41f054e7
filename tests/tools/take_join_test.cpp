#include "tools/take_join.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <toml++/toml.h>

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "config/load_config.h"
#include "config/open_studio.h"
#include "drivers/take/calibration_file.h"
#include "drivers/take/mask_video.h"
#include "drivers/take/take_layout.h"
#include "drivers/take/take_table.h"
#include "drivers/take/toml_text.h"
#include "tests/support/run_command.h"
#include "tests/support/setup_error.h"
#include "tests/support/small_take.h"
#include "tests/support/temporary_folder.h"
#include "tools/simulate.h"
#include "tools/stop_on_signals.h"
#include "tools/take.h"
#include "tools/track.h"

namespace mocap {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::ReadText;
using testing::ReplaceInFile;
using testing::SetupErrorOf;

std::string ListOf(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + TomlText(name);
  return '[' + list + ']';
}

/// Takes some cameras of a take for one that their computer has recorded alone.
void Part(const fs::path& take, const std::vector<std::string>& all,
          const std::vector<std::string>& own, const fs::path& part) {
  fs::copy(take, part, fs::copy_options::recursive);
  const TakeLayout layout{part};
  std::vector<CameraCalibration> kept;
  for (const CameraCalibration& camera : LoadCalibration(layout.Calibration())) {
    if (std::ranges::find(own, camera.name) != own.end()) {
      kept.push_back(camera);
      continue;
    }
    for (const fs::path& file :
         {layout.Video(camera.name), layout.Table(camera.name), layout.BackgroundVideo(camera.name),
          layout.BackgroundTable(camera.name), layout.BackgroundUnseen(camera.name),
          layout.Mask(camera.name)}) {
      fs::remove(file);
    }
  }
  WriteCalibration(layout.Calibration(), kept);
  ReplaceInFile(layout.Description(), "cameras = " + ListOf(all), "cameras = " + ListOf(own));
}

class JoinedTakes : public ::testing::Test {
 protected:
  /// Three cameras, of which one computer has two.
  void Split(const testing::SmallTake& take = {}) {
    testing::WriteSmallTake(whole_, take);
    if (!take.heads)
      WriteMask(TakeLayout{whole_}.BackgroundUnseen("cam3"),
                Silhouette(take.width_px, take.height_px));
    const std::vector<std::string> all = {"cam1", "cam2", "cam3"};
    Part(whole_, all, {"cam1", "cam2"}, left_);
    Part(whole_, all, {"cam3"}, right_);
  }
  JoinedTake Join() { return JoinTakes(std::vector<fs::path>{left_, right_}, joined_); }
  std::string Refusal() {
    const std::string said = SetupErrorOf([this] { Join(); });
    EXPECT_FALSE(fs::exists(joined_)) << said;
    EXPECT_FALSE(fs::exists(joined_.string() + ".partial")) << said;
    return said;
  }
  /// Lets all of a camera's times be later.
  static void Delay(const fs::path& table, std::int64_t by_ns) {
    const TakeTable read = ReadTakeTable(table);
    std::ofstream out(table);
    out << "frame,timestamp_ns\n";
    for (const TakeRow& row : read.rows)
      out << row.frame << ',' << row.timestamp_ns + by_ns << '\n';
  }

  testing::TemporaryFolder folder_;
  const fs::path whole_ = folder_.path() / "whole", left_ = folder_.path() / "left",
                 right_ = folder_.path() / "right", joined_ = folder_.path() / "joined";
};

TEST_F(JoinedTakes, AWalkOfSixCamerasGivesTheSamePosesSplitAndJoined) {
  testing::RunCommand(
      AddSimulateCommand,
      "simulate --motion walk --seconds 0.5 --width 320 --seed 5 --out " + whole_.string());
  const std::vector<std::string> all = {"cam1", "cam2", "cam3", "cam4", "cam5", "cam6"};
  Part(whole_, all, {"cam1", "cam2", "cam3"}, left_);
  Part(whole_, all, {"cam4", "cam5", "cam6"}, right_);
  testing::RunCommand(AddTakeCommand, "take join " + left_.string() + ' ' + right_.string() +
                                          " --out " + joined_.string());
  for (const fs::path& take : {whole_, joined_})
    testing::RunCommand(AddTrackCommand,
                        "track " + take.string() + " --out " + take.string() + "-result");
  const std::string poses = ReadText(whole_.string() + "-result/poses.csv");
  EXPECT_GT(std::ranges::count(poses, '\n'), 10);
  EXPECT_EQ(ReadText(joined_.string() + "-result/poses.csv"), poses);
  const auto body_of = [](const fs::path& take) {
    const std::string body = ReadText(take.string() + "-result/body.toml");
    EXPECT_THAT(body, HasSubstr("[take]\nname = \"" + take.filename().string() + '"'));
    return body.substr(0, body.find("[take]"));
  };
  EXPECT_EQ(body_of(joined_), body_of(whole_));
  for (const char* kept : {"truth.csv", "truth.toml", "silhouette/cam5.mkv"})
    EXPECT_EQ(ReadText(joined_ / kept), ReadText(whole_ / kept)) << kept;
}

TEST_F(JoinedTakes, HaveTheCamerasOfAllInTheOrderOfTheTakes) {
  Split();
  EXPECT_EQ(Join().cameras, 3u);
  EXPECT_TRUE(fs::exists(TakeLayout{joined_}.BackgroundUnseen("cam3")));
  std::vector<std::string> names;
  for (const StudioCamera& camera : OpenTake(joined_, {}).cameras)
    names.push_back(camera.calibration.name);
  EXPECT_EQ(names, (std::vector<std::string>{"cam1", "cam2", "cam3"}));
  EXPECT_EQ(ReadText(joined_ / "calibration.toml"), ReadText(whole_ / "calibration.toml"));
}

TEST_F(JoinedTakes, CamerasOnHeadsKeepTheirAngles) {
  Split({.heads = true});
  Join();
  for (const char* table : {"cam1.csv", "cam3.csv", "background/cam3.csv"})
    EXPECT_EQ(ReadText(joined_ / table), ReadText(whole_ / table)) << table;
}

TEST_F(JoinedTakes, VideosTakeNoRoomAndTablesAreCopies) {
  Split();
  Join();
  EXPECT_TRUE(fs::equivalent(joined_ / "cam3.mkv", right_ / "cam3.mkv"));
  EXPECT_FALSE(fs::equivalent(joined_ / "cam3.csv", right_ / "cam3.csv"));
}

TEST_F(JoinedTakes, KeepTheFramesThatOnlyOneTakeHas) {
  const testing::SmallTake take;
  Split(take);
  Delay(right_ / "cam3.csv", 5 * take.interval_ns);
  const JoinedTake joined = Join();
  for (const char* camera : {"cam1", "cam3"}) {
    EXPECT_EQ(ReadTakeTable(joined_ / (std::string(camera) + ".csv")).rows.size(), 12u) << camera;
  }
  // cam3 begins 2 ms after cam1, and cam2 ends 1 ms after it.
  EXPECT_EQ(joined.common_ns, 6 * take.interval_ns - 1'000'000);
  EXPECT_EQ(joined.all_ns, 16 * take.interval_ns + 2'000'000);
}

TEST_F(JoinedTakes, SayWhatNoTakeContradicts) {
  Split();
  ReplaceInFile(left_ / "take.toml", "source = \"a test\"",
                "source = \"a test\"\ncreated = \"12:00\"\nframes_cam1 = \"12\"");
  ReplaceInFile(right_ / "take.toml", "source = \"a test\"",
                "source = \"a test\"\ncreated = \"12:01\"\n[[person]]\nwhole = [[0, 11]]");
  Join();
  const toml::table said = toml::parse_file((joined_ / "take.toml").string());
  EXPECT_EQ(said["name"].value<std::string>(), "joined");
  EXPECT_EQ(said["fps_nominal"].value<double>(), 25);
  EXPECT_EQ(said["joined"][1].value<std::string>(), "right");
  EXPECT_EQ(said["source"].value<std::string>(), "a test");
  EXPECT_EQ(said["frames_cam1"].value<std::string>(), "12");
  EXPECT_EQ(said["person"][0]["whole"][0][1].value<int>(), 11);
  EXPECT_FALSE(said.contains("created"));
}

TEST_F(JoinedTakes, ACameraInTwoTakesIsRefused) {
  Split();
  const std::string said = SetupErrorOf([this] {
    JoinTakes(std::vector<fs::path>{left_, right_, whole_}, joined_);
  });
  EXPECT_THAT(said, AllOf(HasSubstr("whole: its camera cam1 is in "), HasSubstr("left too")));
}

TEST_F(JoinedTakes, TakesThatDoNotOverlapAreRefusedByHowMuch) {
  Split();
  Delay(right_ / "cam3.csv", 3'600'000'000'000);
  EXPECT_THAT(Refusal(), AllOf(HasSubstr("left: ends 3599.56"), HasSubstr("s before "),
                               HasSubstr("right begins")));
}

TEST_F(JoinedTakes, AnotherRateIsRefused) {
  Split();
  ReplaceInFile(right_ / "take.toml", "fps_nominal = 25", "fps_nominal = 30");
  EXPECT_THAT(Refusal(),
              AllOf(HasSubstr("right: has 30 frames a second, and "), HasSubstr("left has 25")));
}

TEST_F(JoinedTakes, ACameraThatIsCalibratedDifferentlyIsRefused) {
  Split();
  // Both know of all cameras, as where a studio's file is on every computer.
  for (const fs::path& take : {left_, right_})
    fs::copy_file(whole_ / "calibration.toml", take / "calibration.toml",
                  fs::copy_options::overwrite_existing);
  ReplaceInFile(right_ / "calibration.toml", "focal_mm = 5.5", "focal_mm = 5.6");
  EXPECT_THAT(Refusal(),
              AllOf(HasSubstr("right/calibration.toml: cameras.cam2 differs from that in"),
                    HasSubstr("left/calibration.toml")));
}

TEST_F(JoinedTakes, TruthThatDiffersIsRefused) {
  Split();
  testing::WriteText(left_ / "truth.toml", "stature_mm = 1700");
  testing::WriteText(right_ / "truth.toml", "stature_mm = 1800");
  EXPECT_THAT(Refusal(),
              AllOf(HasSubstr("right/truth.toml: differs from "), HasSubstr("left/truth.toml")));
}

TEST_F(JoinedTakes, AFolderThatExistsIsNotTouched) {
  Split();
  fs::create_directory(joined_);
  EXPECT_THAT(SetupErrorOf([this] { Join(); }), HasSubstr("joined: exists"));
  EXPECT_TRUE(fs::is_empty(joined_));
}

TEST_F(JoinedTakes, OneTakeIsNotEnough) {
  CLI::App app("mocap");
  AddTakeCommand(app);
  EXPECT_THROW(app.parse("take join a --out b"), CLI::ParseError);
}

TEST_F(JoinedTakes, AnInterruptedJoinLeavesNothing) {
  Split();
  const auto join_interrupted = [this] {
    StopOnSignals();
    raise(SIGINT);
    try {
      Join();
    } catch (const std::exception&) {
      EndBySignal();
    }
    std::_Exit(0);
  };
  EXPECT_EXIT(join_interrupted(), ::testing::KilledBySignal(SIGINT), "");
  EXPECT_FALSE(fs::exists(joined_));
  EXPECT_FALSE(fs::exists(joined_.string() + ".partial"));
}

}  // namespace
}  // namespace mocap
