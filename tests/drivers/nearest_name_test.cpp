#include "drivers/nearest_name.h"

#include <gtest/gtest.h>

namespace mocap {
namespace {

const std::vector<std::string> kNames = {"evaluate", "export", "track",        "take",
                                         "fps",      "follow", "--voxel-size", "--out"};

TEST(NearestName, IsTheOneWithTheFewestLettersToChange) {
  EXPECT_EQ(NearestName("evalute", kNames), "evaluate");
  EXPECT_EQ(NearestName("exprot", kNames), "export");
  EXPECT_EQ(NearestName("fsp", kNames), "fps");
  EXPECT_EQ(NearestName("trakc", kNames), "track");
  EXPECT_EQ(NearestName("FPS", kNames), "fps");
}

TEST(NearestName, MayHaveALongerEnding) {
  EXPECT_EQ(NearestName("eval", kNames), "evaluate");
  EXPECT_EQ(NearestName("--voxle", kNames), "--voxel-size");
}

TEST(NearestName, IsNoneWhereNothingResemblesIt) {
  EXPECT_EQ(NearestName("calibrate", kNames), "");
  EXPECT_EQ(NearestName("x", kNames), "");
  EXPECT_EQ(NearestName("", kNames), "");
  EXPECT_EQ(NearestName("fps", {}), "");
  EXPECT_EQ(NearestName(std::string(100'000, 'x'), kNames), "");
}

TEST(NearestName, IsNotTheOneWithAnotherNumber) {
  EXPECT_EQ(NearestName("cam2", {"cam1", "cam3"}), "");
  EXPECT_EQ(NearestName("camera_2", {"camera_1"}), "");
  EXPECT_EQ(NearestName("cma2", {"cam1", "cam2"}), "cam2");
}

TEST(NearestName, StandsBeforeTheListOfWhatThereIs) {
  EXPECT_EQ(ExpectedNames("cam11", {"cam1", "side"}),
            "did you mean cam1? Expected one of cam1, side");
  EXPECT_EQ(ExpectedNames("door", {"cam1", "side"}), "expected one of cam1, side");
  EXPECT_EQ(ExpectedNames("door", {"cam1"}), "expected cam1");
}

}  // namespace
}  // namespace mocap
