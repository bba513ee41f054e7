// Which video belongs to which camera.
#include "tools/import/camera_videos.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/errors.h"
#include "tests/support/setup_error.h"

namespace mocap {
namespace {

const std::vector<std::string> kNames = {"cam1", "cam2", "cam10"};

std::string Matches(const std::vector<std::string>& arguments,
                    const std::vector<std::string>& names = kNames) {
  std::vector<std::string> remarks;
  std::string text;
  for (const NamedVideo& video : MatchVideos(arguments, names, "", remarks))
    text += video.camera + '=' + video.file.string() + ' ';
  return text + std::string(remarks.size(), '!');
}

TEST(MatchVideos, GoesByTheNameOfTheFile) {
  EXPECT_EQ(Matches({"a/cam2.mp4", "walk_CAM1.mov", "cam10.mp4"}),
            "cam1=walk_CAM1.mov cam2=a/cam2.mp4 cam10=cam10.mp4 ");
}

TEST(MatchVideos, GoesByTheNameOfTheFolder) {
  EXPECT_EQ(Matches({"x/cam10/IMG_0001.MOV", "x/cam1/IMG_0001.MOV"}),
            "cam1=x/cam1/IMG_0001.MOV cam10=x/cam10/IMG_0001.MOV ");
}

TEST(MatchVideos, GoesByTheGivenName) {
  EXPECT_EQ(Matches({"cam2=IMG_1.MOV", "cam1=cam2.mp4"}), "cam1=cam2.mp4 cam2=IMG_1.MOV ");
}

TEST(MatchVideos, GoesByOrderIfNoneHasAName) {
  EXPECT_EQ(Matches({"c.mp4", "a.mp4", "b.mp4"}), "cam1=c.mp4 cam2=a.mp4 cam10=b.mp4 !");
}

TEST(MatchVideos, RefusesWhatIsNotClear) {
  EXPECT_THROW(Matches({"a.mp4", "b.mp4"}), SetupError);
  EXPECT_THROW(Matches({"cam1.mp4", "b.mp4", "c.mp4"}), SetupError);
  EXPECT_THROW(Matches({"cam1.mp4", "x/cam1.mp4"}), SetupError);
  EXPECT_THROW(Matches({"cam1_cam2.mp4"}), SetupError);
  EXPECT_THROW(Matches({"cam3=a.mp4"}), SetupError);
}

}  // namespace
}  // namespace mocap
