#include "core/calibration/diagnosis_text.h"

#include <cmath>
#include <string>

#include "core/calibration/camera_places.h"

namespace mocap {
namespace {

std::string Millimetres(double mm) { return std::to_string(std::lround(mm)) + " mm"; }

const char* NameOfUnit(double unit_mm) {
  if (unit_mm == 1000) return "metres";
  if (unit_mm == 10) return "centimetres";
  return unit_mm == 25.4 ? "inches" : "feet";
}

/// Nobody who sits, and no two people, seem to be so far off the floor.
constexpr double kSurelyOffFloor_mm = 300;

bool IsSure(const StudioDiagnosis& diagnosis) {
  if (diagnosis.fault == StudioFault::kFloor)
    return std::abs(diagnosis.person.lowest_mm) > kSurelyOffFloor_mm;
  return diagnosis.fault != StudioFault::kStature;
}

std::string FloorText(const PersonExtent& person, bool is_sure) {
  if (person.is_below_floor()) {
    return "the person is below the floor, from z = " + Millimetres(person.lowest_mm) + " to " +
           Millimetres(person.highest_mm) +
           ": z points down; set the floor again (mocap calibrate floor)";
  }
  return "the person's feet are at z = " + Millimetres(person.lowest_mm) +
         ", not on the floor; " + (is_sure ? "" : "unless somebody sits or several people meet, ") +
         "set the floor again (mocap calibrate floor)";
}

std::string Text(const StudioDiagnosis& diagnosis, std::span<const CameraCalibration> cameras) {
  const std::string names = NamesOf(diagnosis.cameras, cameras);
  const double height_mm = diagnosis.person.highest_mm - diagnosis.person.lowest_mm;
  switch (diagnosis.fault) {
    case StudioFault::kNone:
      break;
    case StudioFault::kExchanged:
      return names +
             " have each other's name: swap their devices or addresses in [[cameras]], or their "
             "names in calibration.toml";
    case StudioFault::kUpsideDown:
      return "the picture of " + names +
             " is upside down, compared to its calibration: turn the camera or its picture, or "
             "calibrate it again";
    case StudioFault::kMirrored:
      return "the picture of " + names +
             " is mirrored, compared to its calibration: undo it in the camera's settings, or "
             "calibrate it again";
    case StudioFault::kSomeDisagree:
      return names + (diagnosis.cameras.size() == 1 ? " sees" : " see") +
             " people elsewhere than the other cameras do: moved, or zoomed, since the "
             "calibration; calibrate again";
    case StudioFault::kNoneAgree:
      return "the cameras' views of people do not fit together: the calibration is of other "
             "cameras or of another setup, names are mixed up, or the frames are of different "
             "moments; calibrate again";
    case StudioFault::kUnit:
      return "a person is " + Millimetres(height_mm) +
             " tall by this calibration: its lengths are in " + NameOfUnit(diagnosis.unit_mm) +
             "; expected millimetres";
    case StudioFault::kFloor:
      return FloorText(diagnosis.person, IsSure(diagnosis));
    case StudioFault::kStature:
      return "a person is " + Millimetres(height_mm) +
             " tall by this calibration: check the size of the board's squares (--board), and that "
             "a standing person is in view";
  }
  return {};
}

}  // namespace

std::optional<Finding> FindingOf(const StudioDiagnosis& diagnosis,
                                 std::span<const CameraCalibration> cameras) {
  if (diagnosis.fault == StudioFault::kNone) return {};
  return Finding{IsSure(diagnosis) ? Severity::kWrong : Severity::kWarning, Text(diagnosis, cameras)};
}

}  // namespace mocap
