#include "tools/comparison/c3d_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>

#include "tests/support/moving_body.h"
#include "tests/support/setup_error.h"
#include "tests/support/temporary_folder.h"
#include "tests/tools/comparison/c3d_bytes.h"
#include "tools/comparison/comparison.h"
#include "tools/comparison/text_motion.h"
#include "tools/interchange/c3d_writer.h"

namespace mocap {
namespace {

using testing::C3dMaker;
using testing::C3dMaking;
using ::testing::HasSubstr;
using testing::SetupErrorOf;

const Vector3 kUnseen = Vector3::Constant(std::nan(""));

std::vector<std::vector<Vector3>> SomeFrames() {
  return {{{1, -2, 3.5}, {100, 200, 300}}, {kUnseen, {-1000.5, 0, 42}}, {{7, 8, 9}, kUnseen}};
}

std::string ExportedC3d(const Result& result) {
  const ExportSubject subject{"", result};
  std::ostringstream file;
  WriteC3d({std::span(&subject, 1), result.poses, "walk.c3d"}, file);
  return file.str();
}

TEST(C3dFile, IsReadAlikeFromEveryProcessorAndAsIntegersAndFloats) {
  for (const C3dMaker maker : {C3dMaker::kIntel, C3dMaker::kDec, C3dMaker::kMips}) {
    for (const double scale : {-0.1, 0.05}) {
      const std::string bytes =
          C3dMaking(maker, scale).File({"LHEE", "RHEE"}, SomeFrames(), 120, "mm");
      const C3dFile c3d = ParseC3d(bytes, "a.c3d");
      EXPECT_THAT(c3d.labels, ::testing::ElementsAre("LHEE", "RHEE"));
      EXPECT_DOUBLE_EQ(c3d.rate_hz, 120);
      ASSERT_EQ(c3d.points.size(), 2u);
      for (std::size_t f = 0; f < 3; ++f) {
        for (std::size_t i = 0; i < 2; ++i) {
          const Vector3 wanted = SomeFrames()[f][i], read = c3d.points[i][f];
          EXPECT_EQ(read.allFinite(), wanted.allFinite()) << f << ' ' << i;
          if (!wanted.allFinite()) continue;
          EXPECT_LT((read - wanted).norm(), 0.05) << f << ' ' << i;
        }
      }
    }
  }
}

TEST(C3dFile, OurExportIsReadBack) {
  const Result result = testing::SwingingResult(10);
  const C3dFile c3d = ParseC3d(ExportedC3d(result), "a.c3d");
  ASSERT_EQ(c3d.points.front().size(), 10u);
  EXPECT_NEAR(c3d.rate_hz, 25, 1e-4);
  for (std::size_t i = 0; i < static_cast<std::size_t>(kPointCount); ++i)
    for (std::size_t f = 0; f < 10; ++f)
      EXPECT_LT((c3d.points[i][f] - result.poses[f].points_W.col(static_cast<int>(i))).norm(),
                1e-3);
}

TEST(C3dFile, AFileThatIsCutOffAnywhereIsToldOrReadInPart) {
  const std::string bytes = ExportedC3d(testing::SwingingResult(3));
  for (std::size_t size = 0; size < bytes.size(); size += 41) {
    try {
      EXPECT_LE(ParseC3d(bytes.substr(0, size), "a.c3d").points.front().size(), 3u);
    } catch (const SetupError& error) {
      EXPECT_THAT(error.what(), ::testing::StartsWith("a.c3d: "));
    }
  }
}

TEST(C3dFile, BytesThatWereChangedNeverLeadOutOfTheFile) {
  const std::string bytes = ExportedC3d(testing::SwingingResult(2));
  for (std::size_t at = 0; at < 4096; at += 3) {
    for (const char value : {'\0', '\x7f', '\xff'}) {
      std::string changed = bytes;
      changed[at] = value;
      try {
        EXPECT_LE(ParseC3d(changed, "a.c3d").points.size(), 65535u);
      } catch (const SetupError& error) {
        EXPECT_THAT(error.what(), ::testing::StartsWith("a.c3d: "));
      }
    }
  }
}

TEST(C3dFile, WhatIsNoneIsTold) {
  EXPECT_THAT(SetupErrorOf([] { ParseC3d("HIERARCHY", "a.c3d"); }), HasSubstr("is no C3D file"));
  std::string bytes = ExportedC3d(testing::SwingingResult(2));
  bytes[512 + 3] = 12;
  EXPECT_THAT(SetupErrorOf([&] { ParseC3d(bytes, "a.c3d"); }), HasSubstr("processor number 12"));
}

TEST(C3dFile, AFileOfViconIsReadAsOpenSimDoes) {
  const std::filesystem::path folder = std::filesystem::path(MOCAP_SHARED_DIR) / "data/mocap_io";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "needs OpenSim's files in " << folder;
  const RecordedMotion c3d = ReadMotionFile(folder / "walking2.c3d").subjects.at(0);
  const RecordedMotion trc = ReadMotionFile(folder / "std_walking2_markers.trc").subjects.at(0);
  ASSERT_EQ(trc.points.size(), 44u);
  int compared = 0;
  for (const PointTrack& track : trc.points) {
    const PointTrack* same = c3d.FindPoint(track.name);
    ASSERT_NE(same, nullptr) << track.name;
    for (std::size_t i = 0; i < trc.time_s.size(); ++i) {
      const Vector3& p = same->p_mm.at(static_cast<std::size_t>(std::lround(250 * trc.time_s[i])));
      EXPECT_EQ(p.allFinite(), track.p_mm[i].allFinite()) << track.name << ' ' << i;
      if (!p.allFinite() || !track.p_mm[i].allFinite()) continue;
      EXPECT_LT((p - track.p_mm[i]).cwiseAbs().maxCoeff(), 0.051);
      ++compared;
    }
  }
  EXPECT_GT(compared, 1000);
}

}  // namespace
}  // namespace mocap
