#include <algorithm>

#include "config/builtin_body_tables.h"
#include "config/joint_names.h"
#include "config/load_config.h"
#include "config/toml_section.h"
#include "core/degrees.h"
#include "core/errors.h"
#include "drivers/nearest_name.h"
#include "drivers/quoted.h"
#include "drivers/take/input_file.h"

namespace mocap {
namespace {

constexpr std::array<const char*, kSegmentCount> kSegmentNames = {
    "torso",       "pelvis",      "head",   "upper_arm_l", "upper_arm_r", "thigh_l",    "thigh_r",
    "lower_arm_l", "lower_arm_r", "calf_l", "calf_r",      "shoulder_l",  "shoulder_r", "hand_l",
    "hand_r",      "foot_l",      "foot_r", "toes_l",      "toes_r"};

// Toes that the table does not name belong to the foot.
constexpr int kToesAfterFoot =
    static_cast<int>(Segment::kToesL) - static_cast<int>(Segment::kFootL);

bool HasCarrier(TomlSection& segments, int segment) {
  return segment < static_cast<int>(Segment::kToesL) || segments.Has(kSegmentNames[segment]);
}

// Index of a joint by its name; -1 for "", the torso.
int FindJoint(TomlSection& section, const std::string& key, const std::vector<JointAxis>& joints) {
  const std::string name = section.Text(key);
  if (name.empty()) return -1;
  const auto joint = std::find_if(joints.begin(), joints.end(),
                                  [&name](const JointAxis& j) { return j.name == name; });
  if (joint == joints.end()) {
    std::vector<std::string> names;
    for (const JointAxis& other : joints) names.push_back(other.name);
    section.Fail(
        key, "is " + Quoted(name) + "; " +
                 WithNearestName(name, names, "expected a joint further up or \"\" for the torso"));
  }
  return static_cast<int>(joint - joints.begin());
}

Vector3 ReadDirection(TomlSection& section, const std::string& key) {
  const Vector3 axis = section.Vector(key);
  if (!(axis.norm() > 1e-6)) section.Fail(key, "has no direction; expected a vector");
  return axis.normalized();
}

JointAxis ReadJoint(TomlSection& section, const std::vector<JointAxis>& joints) {
  JointAxis joint;
  joint.name = section.Text("name");
  joint.paper_angle = static_cast<int>(section.IntegerWithin("angle", 1, kPaperAngleCount, 0));
  joint.parent = FindJoint(section, "parent", joints);
  joint.axis_T = ReadDirection(section, "axis");
  std::vector<std::string> places(kPointNames.begin(), kPointNames.end());
  places.insert(places.end(), kFurtherPointNames.begin(), kFurtherPointNames.end());
  joint.at = static_cast<Point>(section.Choice("at", places));
  const std::vector<double> limits_deg = section.Numbers("limits_deg", 2);
  if (!(limits_deg[0] < limits_deg[1] && limits_deg[0] >= -360 && limits_deg[1] <= 360)) {
    section.Fail("limits_deg", "is not a range; expected [least, most] within 360 degrees");
  }
  joint.min_rad = limits_deg[0] / kDegreesPerRad;
  joint.max_rad = limits_deg[1] / kDegreesPerRad;
  if (section.Has("rest_deg")) {
    const std::vector<double> rest_deg = section.Numbers("rest_deg", 2);
    if (!(rest_deg[1] > 0)) section.Fail("rest_deg", "has no spread; expected [mean, spread]");
    joint.rest_rad = rest_deg[0] / kDegreesPerRad;
    joint.rest_std_rad = rest_deg[1] / kDegreesPerRad;
    joint.rise_rad = section.Number("rise_deg", 0) / kDegreesPerRad;
  } else {
    section.Reserve({"rise_deg"}, "needs rest_deg");
  }
  if (joint.name.empty()) section.Fail("name", "is empty; expected a name");
  if (!IsJointName(joint.name)) {
    section.Fail("name",
                 "is " + Quoted(joint.name) +
                     "; expected lower-case letters, digits and _, and neither theta_... nor "
                     "torso_angle, which are columns of results");
  }
  for (const JointAxis& other : joints) {
    if (other.name == joint.name)
      section.Fail("name", "is " + Quoted(joint.name) + " a second time");
    if (joint.paper_angle > 0 && other.paper_angle == joint.paper_angle) {
      section.Fail("angle", "is the same as that of " + Quoted(other.name));
    }
  }
  section.RejectUnknownKeys();
  return joint;
}

bool CarriesArm(const BodyTable& table, const JointAxis& joint) {
  const int row = static_cast<int>(&joint - table.joints.data());
  return table.Carries(row, Segment::kUpperArmL) || table.Carries(row, Segment::kUpperArmR);
}

JointPlacement ReadPlacement(TomlSection& section) {
  const auto share = [&section](const std::string& key, double least, double average) {
    return section.NumberWithin(key, least, 1, average);
  };
  const JointPlacement people;
  const JointPlacement placement = {
      .neck_behind = share("neck_behind", -1, people.neck_behind),
      .hip_behind = share("hip_behind", -1, people.hip_behind),
      .shoulder_behind = share("shoulder_behind", -1, people.shoulder_behind),
      .shoulder_below_neck = share("shoulder_below_neck", 0, people.shoulder_below_neck),
      .clavicle_below_neck = share("clavicle_below_neck", 0, people.clavicle_below_neck),
      .head_forward = share("head_forward", -1, people.head_forward)};
  section.RejectUnknownKeys();
  return placement;
}

BodyTable ReadBodyTable(TomlSection root) {
  BodyTable table;
  table.name = root.Text("name");
  if (std::optional<TomlSection> section = root.Section("placement")) {
    table.placement = ReadPlacement(*section);
  }
  for (TomlSection& section : root.Sections("joints")) {
    if (table.joints.size() == kMaxJoints) {
      root.Fail("joints", "has more than " + std::to_string(kMaxJoints) + " axes");
    }
    table.joints.push_back(ReadJoint(section, table.joints));
  }
  if (table.joints.empty()) root.Fail("joints", "is empty; expected [[joints]]");
  TomlSection segments = root.NeededSection("segments", "the axis that moves each segment");
  for (int i = 0; i < kSegmentCount; ++i) {
    table.carrier[i] = HasCarrier(segments, i) ? FindJoint(segments, kSegmentNames[i], table.joints)
                                               : table.carrier[i - kToesAfterFoot];
  }
  segments.RejectUnknownKeys();
  for (const JointAxis& joint : table.joints) {
    if (joint.rise_rad != 0 && !CarriesArm(table, joint)) {
      root.Fail("joints", "let " + Quoted(joint.name) + " rise, which carries no arm");
    }
  }
  root.RejectUnknownKeys();
  return table;
}

}  // namespace

BodyTable LoadBodyTable(const std::string& name_or_path) {
  std::vector<std::string> names;
  std::string known;
  for (const BuiltinBodyTable& table : BuiltinBodyTables()) {
    if (table.name == name_or_path) {
      return ReadBodyTable(TomlSection::ReadText(table.toml, "body " + name_or_path));
    }
    names.emplace_back(table.name);
    known += '"' + std::string(table.name) + "\" or ";
  }
  if (!IsThere(name_or_path)) {
    throw SetupError(
        "body " + Quoted(name_or_path) + " is unknown; " +
        WithNearestName(name_or_path, names, "expected " + known + "the path of a body table"));
  }
  return ReadBodyTable(TomlSection::ReadFile(name_or_path));
}

}  // namespace mocap
