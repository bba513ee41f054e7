#include "tools/solving/solve_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "config/load_config.h"
#include "tests/support/setup_error.h"
#include "tests/support/temporary_folder.h"

namespace mocap {
namespace {

class Files : public ::testing::Test {
 protected:
  SolveFiles Open(const std::string& mark = "a take") const {
    return {folder_.path() / "work", mark};
  }
  static PoseState At(double x_mm) {
    PoseState pose;
    pose.X_WT = {ExpRotation(Vector3(0.1, 0.2, 0.3)), Vector3(x_mm, 2, 3)};
    pose.theta = JointAngles::LinSpaced(36, -1, 1);
    return pose;
  }
  static void ExpectSame(const PoseState& a, const PoseState& b) {
    EXPECT_EQ(a.X_WT.R, b.X_WT.R);
    EXPECT_EQ(a.X_WT.p, b.X_WT.p);
    EXPECT_EQ(a.theta, b.theta);
  }
  static std::vector<PathStep> Part() {
    return {{At(1), Things(5), false, 0.75}, {}, {At(2), Things(0), true, 1}};
  }
  static void ExpectPart(const std::vector<PathStep>& steps) {
    ASSERT_EQ(steps.size(), 3U);
    ExpectSame(*steps[0].pose, At(1));
    EXPECT_EQ(steps[0].things, Things(5));
    EXPECT_EQ(steps[0].probability, 0.75);
    EXPECT_FALSE(steps[1].pose);
    EXPECT_TRUE(steps[2].jumps);
  }

  const testing::TemporaryFolder folder_;
  const BodyTable table_ = LoadBodyTable("full");
};

TEST_F(Files, KeepTheFirstPass) {
  EXPECT_FALSE(Open().LoadFirstPass(table_));
  BodySizes sizes = AverageSizes(1650);
  sizes.drape_knee = 70;
  FirstPass pass{{{0, 100}, {5, 6}}, {}};
  pass.tracks.emplace(3, PersonTrack{BodyModel(table_, sizes), 1, {At(7), std::nullopt}});
  Open().Save(pass);
  const std::optional<FirstPass> loaded = Open().LoadFirstPass(table_);
  ASSERT_TRUE(loaded);
  EXPECT_EQ(loaded->index.offset, pass.index.offset);
  EXPECT_EQ(loaded->index.capture_ns, pass.index.capture_ns);
  const PersonTrack& track = loaded->tracks.at(3);
  EXPECT_EQ(track.body.sizes(), sizes);
  ExpectSame(*track.At(1), At(7));
  EXPECT_EQ(track.At(2), nullptr);
  EXPECT_EQ(track.end(), 3);
}

TEST_F(Files, KeepThePartsOfAPath) {
  EXPECT_TRUE(Open().LoadPath(1).empty());
  for (int i = 0; i < 2; ++i) Open().AppendPath(1, Part());
  const auto parts = Open().LoadPath(1);
  ASSERT_EQ(parts.size(), 2U);
  for (const auto& part : parts) ExpectPart(part);
  EXPECT_TRUE(Open().LoadPath(2).empty());
}

TEST_F(Files, ForgetAPartThatWasCutOff) {
  Open().AppendPath(1, Part());
  Open().AppendPath(1, Part());
  const std::filesystem::path file = folder_.path() / "work" / "path-1";
  const auto whole = std::filesystem::file_size(file);
  for (const std::uintmax_t cut : {whole - 1, whole / 2 + 4}) {
    std::filesystem::resize_file(file, cut);
    EXPECT_EQ(Open().LoadPath(1).size(), 1U);
    Open().AppendPath(1, Part());
    EXPECT_EQ(std::filesystem::file_size(file), whole);
    for (const auto& part : Open().LoadPath(1)) ExpectPart(part);
  }
}

TEST_F(Files, LeaveOtherFilesAlone) {
  std::filesystem::create_directories(folder_.path() / "work" / "thesis");
  EXPECT_THAT(testing::SetupErrorOf([this] { Open(); }),
              ::testing::HasSubstr("is not an unfinished solve"));
  EXPECT_TRUE(std::filesystem::exists(folder_.path() / "work" / "thesis"));
}

TEST_F(Files, OfAnotherTakeAreRemoved) {
  Open().AppendPath(1, Part());
  EXPECT_TRUE(Open("another take").LoadPath(1).empty());
}

}  // namespace
}  // namespace mocap
