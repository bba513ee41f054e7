#include "tools/recorded_keypoints.h"

#include <gmock/gmock.h>

#include <fstream>

#include "core/errors.h"
#include "tests/support/temporary_folder.h"

namespace mocap {
namespace {

using ::testing::HasSubstr;

const std::vector<std::string> kCameras = {"cam1", "cam2"};

class RecordedKeypointsTest : public ::testing::Test {
 protected:
  std::filesystem::path Write(const std::string& rows) const {
    const auto file = folder_.path() / "keypoints.csv";
    std::ofstream(file) << "camera,timestamp_ns,person,name,x_px,y_px,score\n" << rows;
    return file;
  }
  testing::TemporaryFolder folder_;
};

TEST_F(RecordedKeypointsTest, ComeOnceWithTheSetOfTheirPicture) {
  RecordedKeypoints keypoints(Write("cam1,0,1,nose,10,20,0.9\n"
                                    "cam2,33000000,1,nose,10,20,0.9\n"
                                    "cam1,100000000,1,nose,10,20,0.9\n"),
                              kCameras);
  std::vector<KeypointView> views;
  keypoints.TakeFor(1'000'000, views);
  ASSERT_EQ(views.size(), 1u);
  EXPECT_EQ(views[0].camera, "cam1");
  keypoints.TakeFor(33'000'000, views);
  ASSERT_EQ(views.size(), 1u);
  EXPECT_EQ(views[0].camera, "cam2");
  keypoints.TakeFor(66'000'000, views);
  EXPECT_TRUE(views.empty());
  keypoints.TakeFor(100'000'000, views);
  EXPECT_EQ(views.size(), 1u);
}

TEST_F(RecordedKeypointsTest, OfOtherCamerasAreRefused) {
  try {
    RecordedKeypoints(Write("left,0,1,nose,10,20,0.9\n"), kCameras);
    FAIL();
  } catch (const SetupError& error) {
    EXPECT_THAT(error.what(), HasSubstr("left"));
    EXPECT_THAT(error.what(), HasSubstr("cam1"));
  }
}

}  // namespace
}  // namespace mocap
