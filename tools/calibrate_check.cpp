#include "tools/calibrate_check.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <memory>

#include "config/load_config.h"
#include "core/calibration/diagnosis_text.h"
#include "core/degrees.h"
#include "core/errors.h"
#include "drivers/clock.h"
#include "drivers/nearest_name.h"
#include "drivers/printable_text.h"
#include "drivers/quoted.h"
#include "drivers/take/calibration_file.h"
#include "tools/calibrate_steps.h"
#include "tools/calibration/placement.h"
#include "tools/calibration/studio_check.h"
#include "tools/camera_health.h"
#include "tools/studio_examination.h"
#include "tools/take_samples.h"

namespace mocap {
namespace {

/// Calibrations of one studio do not differ by so much.
constexpr double kOtherStudio_mm = 200;
constexpr int kMoments = 12;
constexpr double kVoxel_mm = 50;

// The cameras of the samples, as another file calibrates them.
std::vector<CameraCalibration> CalibrationsFor(const TakeSamples& samples,
                                               const std::vector<CameraCalibration>& cameras,
                                               const std::filesystem::path& file) {
  std::vector<CameraCalibration> calibrations;
  for (const CameraCalibration& sampled : samples.cameras) {
    const auto camera = std::ranges::find(cameras, sampled.name, &CameraCalibration::name);
    if (camera == cameras.end())
      throw SetupError(file.string() + ": has no camera " + Quoted(sampled.name) +
                       ", which the take has; " +
                       WithNearestName(sampled.name, CameraNames(cameras),
                                       "expected a calibration of the take's cameras"));
    calibrations.push_back(*camera);
  }
  return calibrations;
}

// Names the two cameras whose views agree least.
std::string AgreementText(const StudioDiagnosis& diagnosis,
                          const std::vector<CameraCalibration>& cameras) {
  const PairAgreement* worst = nullptr;
  for (const PairAgreement& pair : diagnosis.pairs) {
    const bool is_worse = !worst || pair.views.overlap < worst->views.overlap;
    if (pair.moments > 0 && is_worse) worst = &pair;
  }
  if (!worst) return "";
  return fmt::format("{} and {} agree least on where people are: by {:.0f} %",
                     cameras[worst->first].name, cameras[worst->second].name,
                     100 * worst->views.overlap);
}

// Small turns, which only hulls tell.
void CheckMotions(const std::string& take, const TakeSamples& samples,
                  const std::vector<CameraCalibration>& cameras, std::vector<Finding>& findings) {
  try {
    for (const std::string& change : ChangesOf(RefineFromSilhouettes(samples, cameras)))
      findings.push_back({Severity::kWarning, take + ": " + change});
  } catch (const SetupError& error) {
    findings.push_back({Severity::kWarning, take + ": " + error.what()});
  }
}

// Checks that the cameras agree on a person who stands on the floor.
void CheckPerson(const CalibrateArguments& a, const std::vector<CameraCalibration>& cameras,
                 std::vector<Finding>& findings) {
  const std::filesystem::path& take = a.footage;
  const TakeSamples samples =
      SampleTake(take, ChooseHealthMoments(take, 0, 60, kMoments), kVoxel_mm);
  const std::vector<CameraCalibration> calibrations =
      CalibrationsFor(samples, cameras, a.calibration);
  const std::vector<SeenMoment> moments = MomentsOf(samples, calibrations);
  const auto add = [&](Severity severity, const std::string& text) {
    findings.push_back({severity, take.string() + ": " + text});
  };
  if (std::ranges::none_of(moments, ShowsPerson))
    throw SetupError(take.string() +
                     ": nobody is seen; expected a take in which a person stands or walks");
  const StudioDiagnosis diagnosis = Diagnose(calibrations, moments);
  if (const auto fault = FindingOf(diagnosis, calibrations)) add(fault->severity, fault->text);
  const bool are_views_right =
      diagnosis.fault == StudioFault::kNone || diagnosis.fault == StudioFault::kFloor;
  if (are_views_right) CheckMotions(take.string(), samples, calibrations, findings);
  if (const std::string text = AgreementText(diagnosis, calibrations); !text.empty())
    add(Severity::kNote, text);
  if (diagnosis.person.moments == 0) return;
  findings.push_back(
      {Severity::kNote,
       fmt::format("{}: the person reaches from z = {:.0f} to {:.0f} mm", take.string(),
                   diagnosis.person.lowest_mm, diagnosis.person.highest_mm)});
}

// Days of the calendar, in local time.
std::int64_t DayOf(std::time_t time_s) {
  std::tm local{};
  localtime_r(&time_s, &local);
  return timegm(&local) / (24 * 3600);
}

std::string DaysAgo(std::int64_t then_s, std::int64_t now_s) {
  const std::int64_t days = DayOf(now_s) - DayOf(then_s);
  return days < 1 ? "today" : days == 1 ? "yesterday" : std::to_string(days) + " days ago";
}

// The result of the last health check, if no camera had moved.
std::string HealthText(const std::vector<CameraOffset>& offsets) {
  if (offsets.empty() || std::ranges::any_of(offsets, &CameraOffset::has_moved)) return "";
  const CameraOffset& worst = *std::ranges::max_element(offsets, {}, &CameraOffset::px);
  return fmt::format(", no camera has moved (at most {:.1f} px, {})", worst.px, worst.camera);
}

// What a health check found stays a reason for doubt until the cameras are calibrated or corrected.
void CheckNote(const CalibrationRecord& record, std::vector<Finding>& findings) {
  for (const CameraOffset& offset : record.offsets) {
    if (!offset.has_moved) continue;
    findings.push_back(
        {Severity::kWarning,
         fmt::format("{}: had moved or was zoomed, by {:.1f} px, when its health was checked; "
                     "correct it with mocap calibrate refine, or calibrate it again with a board",
                     offset.camera, offset.px)});
  }
}

// The age, and the result of the last health check.
std::string RecordText(const CalibrationRecord& record, std::int64_t now_s) {
  std::string text = record.made_s == 0 ? "date unknown" : "made " + DaysAgo(record.made_s, now_s);
  if (record.refined_s != 0) text += ", refined " + DaysAgo(record.refined_s, now_s);
  text += record.checked_s == 0
              ? "; health not checked yet"
              : "; health checked " + DaysAgo(record.checked_s, now_s) + HealthText(record.offsets);
  return text + '\n';
}

// Measures how far points in the room move compared to another calibration.
void Compare(const std::vector<CameraCalibration>& cameras, const std::filesystem::path& other,
             std::vector<Finding>& findings) {
  const PlacementDifference difference = ComparePlacement(cameras, LoadCalibration(other));
  if (difference.points < 3)
    throw SetupError(
        other.string() +
        ": its cameras hardly see the same places; expected the calibration of a studio");
  const Vector3& worst_W = difference.worst_at_W;
  std::string text = fmt::format(
      "points in the room lie {:.1f} mm from where {} has them, and {:.1f} mm at worst (at {:.0f}, "
      "{:.0f}, {:.0f}); {:.1f} mm remain if the world frame is moved by {:.1f} mm and turned by "
      "{:.2f} degrees",
      difference.mean_mm, other.string(), difference.worst_mm, worst_W.x(), worst_W.y(),
      worst_W.z(), difference.left_mm, difference.moved.p.norm(),
      Eigen::AngleAxisd(difference.moved.R).angle() * kDegreesPerRad);
  const bool is_other = difference.mean_mm > kOtherStudio_mm;
  if (is_other)
    text += fmt::format(
        "; expected at most {:.0f} mm, in the same studio with the floor's board in the same place",
        kOtherStudio_mm);
  findings.push_back({is_other ? Severity::kWrong : Severity::kNote, std::move(text)});
}

}  // namespace

void AddCheck(CLI::App* parent) {
  const auto a = std::make_shared<CalibrateArguments>();
  CLI::App* command = parent->add_subcommand("check", "Report the quality of a calibration");
  command->add_option("CALIBRATION", a->calibration, "input calibration.toml")->required();
  command->add_option("--distance", a->distance,
                      "distance between two cameras, measured with a tape: CAMERA:CAMERA:MM");
  command->add_option("--take", a->footage,
                      "take of these cameras in which a person stands or walks");
  const auto against = std::make_shared<std::filesystem::path>();
  command->add_option("--against", *against,
                      "calibration.toml of the same cameras to compare with");
  command->callback([a, against] {
    StudioFit fit;
    fit.bundle.cameras = LoadCalibration(a->calibration);
    fit.has_floor = true;
    std::vector<Finding> findings = CheckAll(*a, fit);
    const CalibrationRecord record = LoadCalibrationRecord(a->calibration);
    CheckNote(record, findings);
    if (!a->footage.empty()) CheckPerson(*a, fit.bundle.cameras, findings);
    if (!against->empty()) Compare(fit.bundle.cameras, *against, findings);
    std::ranges::stable_sort(findings, std::greater(), &Finding::severity);
    const std::string text = RecordText(record, TimeOfDayS()) + FindingsText(findings);
    std::fputs(text.c_str(), stdout);
    RequireUsable(a->calibration, findings);
  });
}

}  // namespace mocap
