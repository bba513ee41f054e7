#include "tools/comparison/text_motion.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/setup_error.h"
#include "tests/support/temporary_folder.h"

namespace mocap {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::SetupErrorOf;

class TextMotion : public ::testing::Test {
 protected:
  std::filesystem::path File(const std::string& name, const std::string& text) {
    testing::WriteText(folder_.path() / name, text);
    return folder_.path() / name;
  }
  testing::TemporaryFolder folder_;
};

const std::string kTrcHead =
    "PathFileType\t4\t(X/Y/Z)\ta.trc\n"
    "DataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\tOrigDataRate\tOrigDataStartFrame\t"
    "OrigNumFrames\n100\t100\t2\t2\tm\t100\t1\t2\n";

TEST_F(TextMotion, TrcHasItsUnitGapsAndSubjects) {
  const MotionFile read = ReadTrc(File("a.trc", kTrcHead + "Frame#\tTime\ta:LHEE\t\t\tb:RHEE\t\t\n"
                                                           "\t\tX1\tY1\tZ1\tX2\tY2\tZ2\n\n"
                                                           "1\t0.00\t1\t2\t3\t\t\t\n"
                                                           "2\t0.01\t1.5\t2\t3\t4\t5\t6\r\n"));
  ASSERT_EQ(read.subjects.size(), 2u);
  const RecordedMotion &a = read.subjects[0], &b = read.subjects[1];
  EXPECT_EQ(a.subject, "a");
  EXPECT_EQ(a.points[0].name, "LHEE");
  EXPECT_THAT(a.time_s, ElementsAre(0, 0.01));
  EXPECT_EQ(a.points[0].p_mm[1], Vector3(1500, 2000, 3000));
  EXPECT_FALSE(b.points[0].p_mm[0].allFinite());
  EXPECT_EQ(b.points[0].p_mm[1], Vector3(4000, 5000, 6000));
}

TEST_F(TextMotion, TrcSaysWhereItIsWrong) {
  const auto error = [&](const std::string& rest) {
    return SetupErrorOf([&] { ReadTrc(File("a.trc", kTrcHead + rest)); });
  };
  EXPECT_THAT(error("Frame#\tTime\tA\n1\t0\t1\t1\t1\n2\t0\t1\t1\t1\n"),
              HasSubstr("a.trc:6: time 0.000000 follows 0.000000"));
  EXPECT_THAT(error("Frame#\tTime\tA\n1\tzero\t1\t1\t1\n"), HasSubstr("time is \"zero\""));
  EXPECT_THAT(error("Frame#\tTime\tA\n"), HasSubstr("has no frame"));
  EXPECT_THAT(SetupErrorOf([&] { ReadTrc(File("b.trc", "HIERARCHY\n")); }),
              HasSubstr("b.trc:1: does not begin with PathFileType"));
}

TEST_F(TextMotion, MotIsInDegreesWhateverItsFileIs) {
  const RecordedMotion old = ReadMot(File("a.mot",
                                          "first trial\nnRows=2\nnColumns=2\n\nendheader\n"
                                          "time\tknee_angle_r\n0.4\t-30\n0.5\t-31\n"))
                                 .subjects[0];
  EXPECT_THAT(old.FindAngle("knee_angle_r")->deg, ElementsAre(-30, -31));
  EXPECT_TRUE(old.points.empty());
  const RecordedMotion rad =
      ReadMot(File("a.sto",
                   "Coordinates\nversion=1\ninDegrees=no\nendheader\n"
                   "time /jointset/knee_r/knee_angle_r/value /jointset/knee_r/knee_angle_r/speed "
                   "pelvis_tx pelvis_ty pelvis_tz pelvis_tilt\n0 3.14159265358979 9 1 2 3 0\n"))
          .subjects[0];
  ASSERT_EQ(rad.angles.size(), 2u);
  EXPECT_NEAR(rad.FindAngle("knee_angle_r")->deg[0], 180, 1e-9);
  EXPECT_NE(rad.FindAngle("pelvis_tilt"), nullptr);
  EXPECT_EQ(rad.FindPoint(kPelvisOrigin)->p_mm[0], Vector3(1000, 2000, 3000));
  EXPECT_THAT(SetupErrorOf([&] { ReadMot(File("b.mot", "endheader\ntime a\n0\n")); }),
              HasSubstr("b.mot:3: has 1 number; expected 2"));
}

TEST_F(TextMotion, BvhPlacesJointsByItsChannelsInTheirOrder) {
  const RecordedMotion motion =
      ReadBvh(
          File("a.bvh",
               "HIERARCHY\nROOT mixamorig:Hips\n{\n OFFSET 9 9 9\n CHANNELS 6 Xposition "
               "Yposition Zposition Zrotation Xrotation Yrotation\n JOINT Spine\n {\n  OFFSET 0 "
               "2 0\n  CHANNELS 3 Yrotation Xrotation Zrotation\n  End Site\n  {\n   OFFSET 0 1 "
               "0\n  }\n }\n}\nMOTION\nFrames: 2\nFrame Time: 0.05\n1 2 3 0 0 0 0 0 0\n"
               "1 2 3 90 0 0 0 90 0\n"))
          .subjects[0];
  EXPECT_FALSE(motion.has_unit);
  EXPECT_THAT(motion.time_s, ElementsAre(0, 0.05));
  EXPECT_EQ(motion.FindPoint("SpineEnd")->p_mm[0], Vector3(1, 5, 3));
  // The root's turn about z brings y to -x, and the spine's about its x brings y to z.
  EXPECT_LT((motion.FindPoint("Spine")->p_mm[1] - Vector3(-1, 2, 3)).norm(), 1e-12);
  EXPECT_LT((motion.FindPoint("SpineEnd")->p_mm[1] - Vector3(-1, 2, 4)).norm(), 1e-12);
  ASSERT_EQ(motion.joints.size(), 2u);
  EXPECT_EQ(motion.joints[0].bone, Vector3(0, 2, 0));
}

TEST_F(TextMotion, BvhOfAnyDepthAndShapeIsReadOrTold) {
  std::string deep = "HIERARCHY\n";
  for (int i = 0; i < 5000; ++i) deep += "JOINT a\n{\n";
  EXPECT_THAT(SetupErrorOf([&] { ReadBvh(File("a.bvh", deep)); }), HasSubstr("more than 2000"));
  EXPECT_THAT(SetupErrorOf([&] { ReadBvh(File("b.bvh", "HIERARCHY\nROOT a\n{\n}\n")); }),
              HasSubstr("ends in its hierarchy"));
  EXPECT_THAT(SetupErrorOf([&] {
                ReadBvh(File("c.bvh", "HIERARCHY\nROOT a\n{\nCHANNELS 1 Wrotation\n}\nMOTION\n"));
              }),
              HasSubstr("has the channel \"Wrotation\""));
  EXPECT_THAT(SetupErrorOf([&] {
                ReadBvh(File("d.bvh",
                             "HIERARCHY\nROOT a\n{\nCHANNELS 1 Xrotation\n}\nMOTION\nFrames: 1\n"
                             "Frame Time: 0.1\n1 2\n"));
              }),
              HasSubstr("d.bvh:9: has 2 numbers; expected 1, one per channel"));
}

TEST_F(TextMotion, CsvHasPointsAndAnglesByTheirColumns) {
  const RecordedMotion motion =
      ReadCsvMotion(File("truth.csv",
                         "frame,timestamp_ns,knee_l_x_mm,knee_l_y_mm,knee_l_z_mm,hip_x_mm,a_deg\n"
                         "0,1000000000,1,2,3,4,5\n1,1033000000,,,,4,6\n"))
          .subjects[0];
  EXPECT_THAT(motion.time_s, ElementsAre(0, 0.033));
  ASSERT_EQ(motion.points.size(), 1u);
  EXPECT_EQ(motion.points[0].p_mm[0], Vector3(1, 2, 3));
  EXPECT_FALSE(motion.points[0].p_mm[1].allFinite());
  EXPECT_THAT(motion.FindAngle("a")->deg, ElementsAre(5, 6));
  EXPECT_THAT(SetupErrorOf([&] { ReadCsvMotion(File("a.csv", "x;y\n1;2\n")); }),
              HasSubstr("a.csv:1: has no column of times"));
}

TEST(UnitInMm, KnowsUnitsOfAnyProgram) {
  EXPECT_EQ(UnitInMm("mm"), 1);
  EXPECT_EQ(UnitInMm(" M "), 1000);
  EXPECT_EQ(UnitInMm("Inches"), 25.4);
  EXPECT_FALSE(UnitInMm("parsec"));
}

TEST(ScaleLike, FindsTheUnitByThePersonsSize) {
  RecordedMotion own;
  own.time_s = {0};
  for (const Vector3& p : {Vector3(0, 0, 0), Vector3(300, 0, 900), Vector3(0, 200, 1600)})
    own.points.push_back({"", {p}});
  for (const auto& [unit, mm] : {std::pair{"mm", 1.0}, {"cm", 10.0}, {"m", 1000.0}, {"in", 25.4}}) {
    RecordedMotion other = own;
    // A fifth larger, as by other sizes of a body.
    for (PointTrack& track : other.points) track.p_mm[0] *= 1.2 / mm;
    EXPECT_EQ(ScaleLike(own, other), unit);
    EXPECT_LT((other.points[1].p_mm[0] - 1.2 * own.points[1].p_mm[0]).norm(), 1e-9);
  }
}

TEST(PointAt, FollowsACubicExactlyAndLeavesGaps) {
  RecordedMotion motion;
  std::vector<Vector3> track;
  for (int i = 0; i < 10; ++i) {
    motion.time_s.push_back(0.1 * i + (i > 6 ? 1.0 : 0.0));
    track.emplace_back(i * i * i, i, 1);
  }
  const FrameFinder frames(motion);
  const auto place = frames.Find(0.35);
  ASSERT_TRUE(place);
  EXPECT_LT((PointAt(track, *place) - Vector3(3.5 * 3.5 * 3.5, 3.5, 1)).norm(), 1e-9);
  EXPECT_TRUE(frames.Find(0.6));
  EXPECT_FALSE(frames.Find(0.7));
  EXPECT_FALSE(frames.Find(-0.01));
  EXPECT_FALSE(frames.Find(2.0));
}

}  // namespace
}  // namespace mocap
