#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <set>

#include "config/joint_names.h"
#include "config/load_config.h"
#include "core/errors.h"
#include "tests/support/temporary_folder.h"

namespace mocap {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

const JointAxis& AxisOf(const BodyTable& table, int paper_angle) {
  for (const JointAxis& joint : table.joints) {
    if (joint.paper_angle == paper_angle) return joint;
  }
  throw std::logic_error("no such angle");
}

int CarrierOf(const BodyTable& table, Segment segment) {
  return table.carrier[static_cast<int>(segment)];
}

// The axes that move a segment, from the torso outward.
std::vector<int> PaperAnglesOf(const BodyTable& table, Segment segment) {
  std::vector<int> angles;
  for (int j = CarrierOf(table, segment); j >= 0; j = table.joints[j].parent) {
    angles.insert(angles.begin(), table.joints[j].paper_angle);
  }
  return angles;
}

TEST(BodyTables, PaperHasItsSixteenAnglesInTheOrderOfItsProducts) {
  const BodyTable table = LoadBodyTable("mikic2003");
  EXPECT_EQ(table.name, "mikic2003");
  EXPECT_EQ(table.joints.size(), 16u);
  EXPECT_EQ(PaperAnglesOf(table, Segment::kTorso), (std::vector<int>{}));
  EXPECT_EQ(PaperAnglesOf(table, Segment::kPelvis), (std::vector<int>{}));
  EXPECT_EQ(PaperAnglesOf(table, Segment::kHead), (std::vector<int>{1, 2}));
  EXPECT_EQ(PaperAnglesOf(table, Segment::kUpperArmL), (std::vector<int>{3, 5, 7}));
  EXPECT_EQ(PaperAnglesOf(table, Segment::kLowerArmL), (std::vector<int>{3, 5, 7, 9}));
  EXPECT_EQ(PaperAnglesOf(table, Segment::kLowerArmR), (std::vector<int>{4, 6, 8, 10}));
  EXPECT_EQ(PaperAnglesOf(table, Segment::kThighL), (std::vector<int>{11, 13}));
  EXPECT_EQ(PaperAnglesOf(table, Segment::kCalfL), (std::vector<int>{11, 13, 15}));
  EXPECT_EQ(PaperAnglesOf(table, Segment::kCalfR), (std::vector<int>{12, 14, 16}));
}

TEST(BodyTables, ThePapersJointsLieInTheMiddleOfTheTrunkAndPeoplesBehindIt) {
  const JointPlacement paper = LoadBodyTable("mikic2003").placement;
  const JointPlacement people = LoadBodyTable("full").placement;
  EXPECT_EQ(paper.neck_behind, 0);
  EXPECT_EQ(paper.hip_behind, 0);
  EXPECT_EQ(paper.shoulder_behind, 0);
  EXPECT_EQ(paper.head_forward, 0);
  EXPECT_GT(paper.shoulder_below_neck, people.shoulder_below_neck);
  EXPECT_GT(people.neck_behind, 0);
}

TEST(BodyTables, CallThePapersSixteenAnglesByTheSameNames) {
  for (const char* name : {"mikic2003", "full"}) {
    const BodyTable table = LoadBodyTable(name);
    for (int angle = 1; angle <= kPaperAngleCount; ++angle) {
      EXPECT_EQ(AxisOf(table, angle).name, kPaperJointNames[angle - 1]) << name;
    }
  }
}

TEST(BodyTables, FullAddsWaistThirdHipAxisAndTheJointsAtTheLimbsEnds) {
  const BodyTable table = LoadBodyTable("full");
  EXPECT_EQ(PaperAnglesOf(table, Segment::kPelvis), (std::vector<int>{0, 0, 0}));
  EXPECT_EQ(PaperAnglesOf(table, Segment::kThighR), (std::vector<int>{0, 0, 0, 12, 14, 0}));
  EXPECT_EQ(PaperAnglesOf(table, Segment::kShoulderL), (std::vector<int>{0, 0}));
  EXPECT_EQ(PaperAnglesOf(table, Segment::kHandL), (std::vector<int>{0, 0, 3, 5, 7, 9, 0, 0}));
  EXPECT_EQ(PaperAnglesOf(table, Segment::kFootR),
            (std::vector<int>{0, 0, 0, 12, 14, 0, 16, 0, 0}));
  std::set<int> angles;
  for (const JointAxis& joint : table.joints) angles.insert(joint.paper_angle);
  EXPECT_EQ(angles.size(), 17u);
}

// Where a limb's end goes first when the angle grows.
Vector3 Velocity(const JointAxis& joint, const Vector3& along_limb) {
  return joint.axis_T.cross(along_limb);
}

TEST(BodyTables, LimbsBendTheWayPeopleDo) {
  const Vector3 down = -Vector3::UnitZ(), left = Vector3::UnitY();
  for (const char* name : {"mikic2003", "full"}) {
    const BodyTable table = LoadBodyTable(name);
    for (const int knee : {15, 16}) {
      const JointAxis& joint = AxisOf(table, knee);
      EXPECT_LT(Velocity(joint, down).x(), 0) << "a growing knee angle takes the calf backward";
      EXPECT_GT(joint.max_rad, 2);
      EXPECT_GT(joint.min_rad, -0.2);
    }
    // Elbows bend forward: each along its arm, so with opposite signs.
    EXPECT_LT(Velocity(AxisOf(table, 9), left).x(), 0);
    EXPECT_LT(AxisOf(table, 9).min_rad, -2);
    EXPECT_LT(AxisOf(table, 9).max_rad, 0.2);
    EXPECT_GT(Velocity(AxisOf(table, 10), -left).x(), 0);
    EXPECT_GT(AxisOf(table, 10).max_rad, 2);
    EXPECT_GT(AxisOf(table, 10).min_rad, -0.2);
    // Thighs reach further forward than backward.
    for (const int hip : {13, 14}) {
      EXPECT_LT(Velocity(AxisOf(table, hip), down).x(), 0);
      EXPECT_LT(AxisOf(table, hip).min_rad, -AxisOf(table, hip).max_rad);
    }
  }
}

TEST(BodyTables, ArmsReachDownToTheSides) {
  for (const char* name : {"mikic2003", "full"}) {
    const BodyTable table = LoadBodyTable(name);
    EXPECT_LT(Velocity(AxisOf(table, 3), Vector3::UnitY()).dot(-Vector3::UnitZ()), 0);
    EXPECT_LT(AxisOf(table, 3).min_rad, -std::numbers::pi / 2);
    EXPECT_GT(Velocity(AxisOf(table, 4), -Vector3::UnitY()).dot(-Vector3::UnitZ()), 0);
    EXPECT_GT(AxisOf(table, 4).max_rad, std::numbers::pi / 2);
  }
}

TEST(BodyTables, LeftAndRightMirrorEachOther) {
  for (const char* name : {"mikic2003", "full"}) {
    const BodyTable table = LoadBodyTable(name);
    for (const JointAxis& left : table.joints) {
      const std::size_t place = left.name.find("_l_");
      if (place == std::string::npos) continue;
      std::string other = left.name;
      other.replace(place, 3, "_r_");
      const auto right =
          std::find_if(table.joints.begin(), table.joints.end(),
                       [&other](const JointAxis& joint) { return joint.name == other; });
      ASSERT_NE(right, table.joints.end()) << other;
      // Axes are pseudovectors: a mirror keeps the part along its normal.
      const Vector3 mirrored(-left.axis_T.x(), left.axis_T.y(), -left.axis_T.z());
      const bool same_sign = right->axis_T == mirrored;
      EXPECT_TRUE(same_sign || right->axis_T == -mirrored) << other;
      EXPECT_DOUBLE_EQ(right->min_rad, same_sign ? left.min_rad : -left.max_rad) << other;
      EXPECT_DOUBLE_EQ(right->max_rad, same_sign ? left.max_rad : -left.min_rad) << other;
      EXPECT_DOUBLE_EQ(right->rest_rad, same_sign ? left.rest_rad : -left.rest_rad) << other;
      EXPECT_DOUBLE_EQ(right->rest_std_rad, left.rest_std_rad) << other;
      EXPECT_DOUBLE_EQ(right->rise_rad, same_sign ? left.rise_rad : -left.rise_rad) << other;
    }
  }
}

class BodyFile : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto source = std::filesystem::path(MOCAP_SOURCE_DIR) / "config/body/mikic2003.toml";
    std::filesystem::copy_file(source, file_);
  }

  std::string ErrorOnLoading() const {
    try {
      LoadBodyTable(file_.string());
    } catch (const SetupError& error) {
      return error.what();
    }
    return "none";
  }

  testing::TemporaryFolder folder_;
  std::filesystem::path file_ = folder_.path() / "body.toml";
};

TEST_F(BodyFile, PathIsReadAsTheBuiltInOnesAre) {
  testing::ReplaceInFile(file_, "axis = [1, 0, 0]", "axis = [3, 0, 4]");
  const BodyTable table = LoadBodyTable(file_.string());
  EXPECT_EQ(table.joints.size(), 16u);
  EXPECT_TRUE(table.joints[0].axis_T.isApprox(Vector3(0.6, 0, 0.8)));
  EXPECT_EQ(table.joints[0].at, Point::kNeck);
  EXPECT_DOUBLE_EQ(table.joints[0].max_rad, 50 * std::numbers::pi / 180);
}

struct DamagedBody {
  const char* from;
  const char* to;
  const char* says;
};

TEST_F(BodyFile, DamageIsNamedWithFileLineAndKey) {
  const std::string whole = testing::ReadText(file_);
  const DamagedBody cases[] = {
      {"[[joints]]", "[[joints]", "not TOML"},
      {"name = \"mikic2003\"", "", "name is missing"},
      {"name = \"neck_x\"", "name = \"\"", "joints[0].name is empty"},
      {"name = \"neck_y\"", "name = \"neck_x\"", "joints[1].name"},
      {"name = \"neck_x\"", "name = \"neck,x\"", "joints[0].name is \"neck,x\"; expected"},
      {"name = \"neck_x\"", "name = \"theta_1\"", "joints[0].name is \"theta_1\"; expected"},
      {"angle = 1\n", "angle = 17\n", "joints[0].angle is 17"},
      {"angle = 1\n", "angle = 1\nrest_deg = [0, 5]\nrise_deg = 36\n",
       "\"neck_x\" rise, which carries no arm"},
      {"angle = 1\n", "angle = 2\n", "joints[1].angle"},
      {"parent = \"neck_x\"", "parent = \"knee_l_y\"", "joints[1].parent is \"knee_l_y\""},
      {"axis = [1, 0, 0]", "axis = [0, 0, 0]", "joints[0].axis"},
      {"axis = [1, 0, 0]", "axis = [1, 0]", "joints[0].axis"},
      {"at = \"neck\"", "at = \"nose\"", "joints[0].at is \"nose\""},
      {"limits_deg = [-50, 50]", "limits_deg = [50, -50]", "joints[0].limits_deg"},
      {"limits_deg = [-50, 50]", "limits_deg = [-50, 500]", "joints[0].limits_deg"},
      {"limits_deg = [-50, 50]", "limit_deg = [-50, 50]", "joints[0].limits_deg is missing"},
      {"at = \"neck\"", "at = \"neck\"\nrest_deg = [5, 0]", "joints[0].rest_deg has no spread"},
      {"at = \"neck\"", "at = \"neck\"\nmass = 3", "joints[0].mass is unknown"},
      {"neck_behind = 0\n", "neck_behind = 2\n", "placement.neck_behind is 2"},
      {"neck_behind = 0\n", "nose_behind = 0\n", "placement.nose_behind is unknown"},
      {"[segments]", "[segment]", "segments is missing"},
      {"head = \"neck_y\"", "", "segments.head is missing"},
      {"head = \"neck_y\"", "head = \"neck_z\"", "segments.head is \"neck_z\""},
      {"head = \"neck_y\"", "head = \"neck_y\"\ntail = \"\"", "segments.tail is unknown"},
  };
  for (const DamagedBody& damaged : cases) {
    testing::WriteText(file_, whole);
    testing::ReplaceInFile(file_, damaged.from, damaged.to);
    EXPECT_THAT(ErrorOnLoading(), AllOf(HasSubstr(file_.string() + ":"), HasSubstr(damaged.says),
                                        Not(HasSubstr("\n"))))
        << damaged.to;
  }
}

TEST_F(BodyFile, MoreAxesThanTheFilterHoldsAreRefused) {
  std::string text = "name = \"centipede\"\n";
  for (int i = 0; i <= kMaxJoints; ++i) {
    text += "[[joints]]\nname = \"j" + std::to_string(i) +
            "\"\nparent = \"\"\naxis = [1, 0, 0]\nat = \"neck\"\nlimits_deg = [0, 1]\n";
  }
  testing::WriteText(file_, text);
  EXPECT_THAT(ErrorOnLoading(), HasSubstr("more than " + std::to_string(kMaxJoints)));
}

TEST(BodyTables, UnknownNameListsTheKnownOnes) {
  try {
    LoadBodyTable("mikic2004");
    FAIL() << "loaded";
  } catch (const SetupError& error) {
    EXPECT_THAT(error.what(),
                AllOf(HasSubstr("mikic2004"), HasSubstr("\"mikic2003\""), HasSubstr("\"full\"")));
  }
}

}  // namespace
}  // namespace mocap
