#include "tools/calibrate_check.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "config/load_config.h"
#include "drivers/clock.h"
#include "drivers/take/calibration_file.h"
#include "tools/calibrate_steps.h"
#include "tools/calibration/placement.h"
#include "tools/calibration/studio_check.h"
#include "tools/camera_health.h"
#include "tools/camera_names.h"
#include "tools/take_samples.h"

namespace mocap {
namespace {

constexpr double kFeetTolerance_mm = 100;
constexpr double kLowestHead_mm = 1100, kHighestHead_mm = 2400;

// Checks that a person's feet are on the floor and the head has a plausible height.
void CheckPerson(const std::filesystem::path& take, std::vector<Finding>& findings) {
  const TakeSamples samples = SampleTake(take, ChooseHealthMoments(take, 0, 60, 10), 25);
  if (const auto swapped = FindSwappedCameras(samples)) {
    findings.insert(findings.begin(),
                    {Severity::kWrong, take.string() + ": " + SwappedText(*swapped)});
    return;
  }
  const StandingPerson person = MeasurePerson(samples);
  const auto add = [&](Severity severity, const std::string& text) {
    findings.insert(findings.begin(), {severity, take.string() + ": " + text});
  };
  if (person.moments == 0) {
    add(Severity::kWrong,
        "the cameras' views of the person do not intersect; poses or camera names are mixed up");
    return;
  }
  if (std::abs(person.lowest_mm) > kFeetTolerance_mm)
    add(Severity::kWrong,
        "the person's feet are at z = " + std::to_string(std::lround(person.lowest_mm)) +
            " mm, not on the floor; set the floor again");
  const std::string reach =
      "the person reaches up to z = " + std::to_string(std::lround(person.highest_mm)) + " mm";
  if (person.highest_mm < kLowestHead_mm || person.highest_mm > kHighestHead_mm)
    add(Severity::kWarning,
        reach + "; is the size of the board's squares right, and does a person stand there?");
  else
    findings.push_back({Severity::kNote, take.string() + ": " + reach});
}

std::string Days(std::int64_t from_s, std::int64_t to_s) {
  return std::to_string((to_s - from_s) / (24 * 3600)) + " days ago";
}

// Describes the age, and the result of the last health check.
std::string RecordText(const CalibrationRecord& record, std::int64_t now_s) {
  if (record.made_s == 0) return "does not say when it was made\n";
  std::string text = "made " + Days(record.made_s, now_s);
  if (record.refined_s != 0) text += ", refined " + Days(record.refined_s, now_s);
  text += record.checked_s == 0 ? "; its health has not been checked yet"
                                : "; health checked " + Days(record.checked_s, now_s);
  for (const CameraOffset& offset : record.offsets) {
    if (offset.has_moved)
      text += ", " + offset.camera + " " + std::to_string(std::lround(offset.px)) + " px off";
  }
  return text + '\n';
}

// Measures how far points in the room move compared to another calibration.
void Compare(const std::vector<CameraCalibration>& cameras, const std::filesystem::path& other,
             std::vector<Finding>& findings) {
  const PlacementDifference difference = ComparePlacement(cameras, LoadCalibration(other));
  const Vector3& worst_W = difference.worst_at_W;
  findings.push_back(
      {Severity::kNote, fmt::format("points in the room lie {:.1f} mm from where {} has them, and "
                                    "{:.1f} mm at worst (at {:.0f}, {:.0f}, {:.0f})",
                                    difference.mean_mm, other.string(), difference.worst_mm,
                                    worst_W.x(), worst_W.y(), worst_W.z())});
}

}  // namespace

void AddCheck(CLI::App* parent) {
  const auto a = std::make_shared<CalibrateArguments>();
  CLI::App* command = parent->add_subcommand("check", "Report the quality of a calibration");
  command->add_option("CALIBRATION", a->calibration, "input calibration.toml")->required();
  command->add_option("--distance", a->distance,
                      "distance between two cameras, measured with a tape: CAMERA:CAMERA:MM");
  command->add_option("--take", a->footage,
                      "take with this calibration in which a person stands or walks");
  const auto against = std::make_shared<std::filesystem::path>();
  command->add_option("--against", *against,
                      "calibration.toml of the same cameras to compare with");
  command->callback([a, against] {
    StudioFit fit;
    fit.bundle.cameras = LoadCalibration(a->calibration);
    fit.has_floor = true;
    std::vector<Finding> findings = CheckAll(*a, fit);
    if (!a->footage.empty()) CheckPerson(a->footage, findings);
    if (!against->empty()) Compare(fit.bundle.cameras, *against, findings);
    std::fputs(RecordText(LoadCalibrationRecord(a->calibration), TimeOfDayS()).c_str(), stdout);
    for (const Finding& finding : findings) std::fprintf(stdout, "%s\n", finding.text.c_str());
    std::fprintf(stdout, "%s\n", Verdict(findings).c_str());
  });
}

}  // namespace mocap
