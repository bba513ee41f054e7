#include "daemon/recording/keypoint_file.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

#include "drivers/take/keypoint_table.h"
#include "tests/support/temporary_folder.h"

namespace mocap {
namespace {

KeypointView NoseAt(std::int64_t capture_ns, float x_px, int person = 0) {
  return {.camera = "cam1",
          .capture_ns = capture_ns,
          .person = person,
          .points = {{Landmark::kNose, {x_px, 2}, 0.5f}}};
}

TEST(KeypointFile, ComesBackAsItWasWritten) {
  const testing::TemporaryFolder folder;
  const std::filesystem::path place = folder.path() / "keypoints.csv";
  KeypointFile file(place);
  file.Flush();
  EXPECT_FALSE(std::filesystem::exists(place)) << "nothing has come";
  for (int i = 0; i < 3; ++i) file.Write(NoseAt(100 + i, static_cast<float>(i), 7));
  file.Flush();
  const std::vector<KeypointView> views = ReadKeypoints(place);
  ASSERT_EQ(views.size(), 3u);
  EXPECT_EQ(views[2].capture_ns, 102);
  EXPECT_EQ(views[2].person, 7);
  EXPECT_EQ(views[2].points[0].px.x(), 2);
}

TEST(KeypointFile, TwoSendersMayUseTheSameNumber) {
  const testing::TemporaryFolder folder;
  const std::filesystem::path place = folder.path() / "keypoints.csv";
  KeypointFile file(place);
  for (const int person : {1, 1, 0, 1}) file.Write(NoseAt(100, 1, person));
  for (int i = 0; i < 3000; ++i) file.Write(NoseAt(200 + i, 1));
  file.Flush();
  const std::vector<KeypointView> views = ReadKeypoints(place);
  ASSERT_EQ(views.size(), 3004u);
  for (int i = 0; i < 4; ++i) EXPECT_EQ(views[i].capture_ns, 100);
}

TEST(KeypointFile, SaysWhereItCannotBeWritten) {
  const testing::TemporaryFolder folder;
  KeypointFile file(folder.path() / "nowhere" / "keypoints.csv");
  EXPECT_THROW(file.Write(NoseAt(1, 1)), std::runtime_error);
}

}  // namespace
}  // namespace mocap
