#include "drivers/take/keypoint_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "tests/support/setup_error.h"
#include "tests/support/temporary_folder.h"

namespace mocap {
namespace {

using ::testing::HasSubstr;

const std::string kKeypointHead = "camera,timestamp_ns,person,name,x_px,y_px,score\n";

class KeypointTable : public ::testing::Test {
 protected:
  std::vector<KeypointView> Read(const std::string& rows) {
    testing::WriteText(file_, rows);
    return ReadKeypoints(file_);
  }
  std::string Error(const std::string& row) {
    return testing::SetupErrorOf([&] { Read(kKeypointHead + row); });
  }

  testing::TemporaryFolder folder_;
  std::filesystem::path file_ = folder_.path() / "keypoints.csv";
};

TEST_F(KeypointTable, IsReadAsItWasWritten) {
  const std::vector<KeypointView> views = {
      {"cam1", 1000000000, 1, {{Landmark::kNose, {12.5f, -3.25f}, 0.875f}}},
      {"cam2", 1000000000, 1, {{Landmark::kWristL, {1, 2}, 1}, {Landmark::kHeelR, {3, 4}, 0}}}};
  std::ostringstream out;
  WriteKeypoints(out, views);
  EXPECT_EQ(out.str(), kKeypointHead +
                           "cam1,1000000000,1,nose,12.500,-3.250,0.875\n"
                           "cam2,1000000000,1,wrist_l,1.000,2.000,1.000\n"
                           "cam2,1000000000,1,heel_r,3.000,4.000,0.000\n");
  const std::vector<KeypointView> read = Read(out.str());
  ASSERT_EQ(read.size(), 2u);
  EXPECT_EQ(read[0].camera, "cam1");
  EXPECT_EQ(read[0].points[0].px, views[0].points[0].px);
  EXPECT_EQ(read[1].points[1].landmark, Landmark::kHeelR);
  EXPECT_EQ(read[0].points[0].score, 0.875f);
}

TEST_F(KeypointTable, SortsViewsByTimeAndGathersTheRowsOfOne) {
  const std::vector<KeypointView> views = Read(kKeypointHead +
                                               "cam2,20,1,nose,1,1,1\ncam1,10,1,nose,1,1,1\n"
                                               "cam2,20,2,nose,1,1,1\ncam2,20,1,left_knee,1,1,1\n");
  ASSERT_EQ(views.size(), 3u);
  EXPECT_EQ(views[0].camera, "cam1");
  EXPECT_EQ(views[1].points.size(), 2u);
  EXPECT_EQ(views[1].points[1].landmark, Landmark::kKneeL);
  EXPECT_EQ(views[2].person, 2);
}

TEST_F(KeypointTable, MayBeEmpty) { EXPECT_TRUE(Read(kKeypointHead).empty()); }

TEST_F(KeypointTable, SaysWhereARowIsWrong) {
  EXPECT_THAT(Error("cam1,10,1,nose,1,1,1\ncam1,10,1,thumb_l,1,1,1\n"),
              HasSubstr("keypoints.csv:3: name is \"thumb_l\"; expected a landmark"));
  EXPECT_THAT(Error("cam1,10,1,nose,nan,1,1\n"), HasSubstr(":2: x_px is \"nan\""));
  EXPECT_THAT(Error("cam1,10,1,nose,1,inf,1\n"), HasSubstr("y_px is"));
  EXPECT_THAT(Error("cam1,10,1,nose,1,1e9,1\n"), HasSubstr("y_px is"));
  EXPECT_THAT(Error("cam1,10,1,nose,1,1,1.01\n"), HasSubstr("score is"));
  EXPECT_THAT(Error("cam1,10,1,nose,1,1,nan\n"), HasSubstr("score is"));
  EXPECT_THAT(Error("cam1,10,-1,nose,1,1,1\n"), HasSubstr("person is"));
  EXPECT_THAT(Error("../cam,10,1,nose,1,1,1\n"), HasSubstr("camera is"));
  EXPECT_THAT(Error("cam1,1e1,1,nose,1,1,1\n"), HasSubstr("timestamp_ns is"));
  EXPECT_THAT(Error("cam1,10,1,nose,1,1,1\ncam1,10,1,nose,1,1,1\n"), HasSubstr(":3: name is"));
  EXPECT_THAT(testing::SetupErrorOf([&] { Read("camera,time\n"); }), HasSubstr("header camera,"));
}

}  // namespace
}  // namespace mocap
