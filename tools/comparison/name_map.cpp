#include "tools/comparison/name_map.h"

#include <algorithm>
#include <optional>

#include "config/toml_section.h"
#include "core/body/body_part.h"
#include "drivers/quoted.h"
#include "tools/comparison/result_motion.h"
#include "tools/kinematics/joint_angles.h"

namespace mocap {
namespace {

/// The point that a name means: a name of poses.csv, or the first of a convention.
std::optional<std::string> OwnPoint(const std::string& name) {
  const std::vector<std::string> points = PointsNamed(name);
  if (points.empty()) return {};
  return points.front();
}

std::vector<std::string> TextOrTexts(TomlSection& section, const std::string& key) {
  if (section.IsArray(key)) return section.Texts(key);
  return {section.Text(key)};
}

void AddPoint(TomlSection& section, const std::string& key, NameMap& map) {
  const std::vector<std::string> values = TextOrTexts(section, key);
  if (values.empty()) section.Fail(key, "is empty; expected a marker's name");
  NamedPair pair;
  const std::optional<std::string> own = OwnPoint(key);
  const std::optional<std::string> own_value =
      values.size() == 1 ? OwnPoint(values[0]) : std::nullopt;
  if (own) {
    pair = {*own, values};
  } else if (own_value) {
    pair = {*own_value, {key}};
  } else {
    section.Fail(key, "= " + Quoted(values[0]) +
                          " names no point of ours; expected one of poses.csv, such as heel_l");
  }
  if (std::ranges::find(map.points, pair.point, &NamedPair::point) != map.points.end())
    section.Fail(key, "names the point " + pair.point + " a second time; expected it once");
  map.points.push_back(std::move(pair));
}

void AddAngle(TomlSection& section, const std::string& key, NameMap& map) {
  AnglePair pair{key, section.Text(key)};
  if (pair.other.starts_with('-')) {
    pair.sign = -1;
    pair.other.erase(0, 1);
  }
  const auto is_own = [](const std::string& name) {
    return name.find("Angles.") != std::string::npos ||
           std::ranges::find(kCoordinateNames, name) != kCoordinateNames.end();
  };
  if (!is_own(pair.own) && is_own(pair.other)) std::swap(pair.own, pair.other);
  if (!is_own(pair.own))
    section.Fail(key, "is no angle of ours; expected one such as knee_angle_l, or LKneeAngles.x");
  if (std::ranges::find(map.angles, pair.own, &AnglePair::own) != map.angles.end())
    section.Fail(key, "names the angle " + pair.own + " a second time; expected it once");
  map.angles.push_back(std::move(pair));
}

}  // namespace

NameMap ReadNameMap(const std::filesystem::path& file) {
  TomlSection root = TomlSection::ReadFile(file);
  NameMap map;
  for (const std::string& key : root.Keys()) {
    if (!root.IsTable(key)) {
      AddPoint(root, key, map);
      continue;
    }
    TomlSection section = root.NeededSection(key, "a table of names");
    if (key != "points" && key != "markers" && key != "angles")
      root.Fail(key, "is no table of a map; expected points or angles");
    for (const std::string& name : section.Keys())
      key == "angles" ? AddAngle(section, name, map) : AddPoint(section, name, map);
  }
  return map;
}

}  // namespace mocap
