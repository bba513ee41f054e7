#include "tools/tracked_take.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "config/open_studio.h"
#include "config/room_limits.h"
#include "config/subject_file.h"
#include "core/calibration/diagnosis_text.h"
#include "core/calibration/studio_diagnosis.h"
#include "core/errors.h"
#include "core/people/people_capture.h"
#include "daemon/base/number_option.h"
#include "daemon/pipeline/masked_camera.h"
#include "drivers/nearest_name.h"
#include "drivers/take/input_file.h"
#include "drivers/take/take_layout.h"
#include "tools/remarks.h"

namespace mocap {
namespace {

/// The folder of the given masks; empty: pictures are segmented.
std::filesystem::path MasksOf(const TrackedTake& tracked) {
  if (!tracked.masks) return {};
  return tracked.masks->empty() ? TakeLayout{tracked.take}.Masks() : *tracked.masks;
}

/// One camera gives no depth.
void RequireTwoCameras(const TrackedTake& tracked, const Studio& studio) {
  if (studio.cameras.size() >= 2) return;
  const std::string& only = studio.cameras.front().calibration.name;
  throw SetupError(tracked.cameras.empty()
                       ? tracked.take.string() + ": has frames of only " + only +
                             "; expected at least two cameras, and four for good poses"
                       : "--cameras: names only " + only +
                             "; expected at least two cameras, and four for good poses");
}

std::string WhyNobody(const std::optional<Finding>& fault, std::span<const SeenMoment> moments) {
  if (fault) return fault->text;
  const auto show = std::ranges::count_if(moments, ShowsPerson);
  return 2 * show > std::ssize(moments) ? "people are visible, but nobody could be tracked: at "
                                          "least three cameras must see the whole person"
                                        : "nobody is seen by most of the cameras at once";
}

/// Names the parts of a result: poses.csv, or person-1 and so on.
std::vector<std::string> PartsOf(const std::filesystem::path& result) {
  std::vector<std::string> parts;
  if (IsThere(result / "poses.csv")) parts.emplace_back("poses.csv");
  for (const std::filesystem::path& person : PersonFolders(result)) {
    if (IsThere(person / "poses.csv")) parts.push_back(person.filename().string());
  }
  return parts;
}

}  // namespace

void AddTakeOptions(CLI::App& command, TrackedTake& tracked) {
  command.add_option("TAKE", tracked.take, "take folder")->required();
  command.add_option("--out", tracked.out, "output result folder (poses.csv, body.toml)")
      ->required();
  command.add_option("--cameras", tracked.cameras, "use only these cameras, such as cam1,cam2")
      ->delimiter(',');
  command
      .add_option("--people", tracked.people,
                  "track up to this many people; one result folder each, person-1 and so on "
                  "(default: one person)")
      ->check(NumberFrom(1, kMostPeople));
  command
      .add_option_function<std::string>(
          "--masks", [&tracked](const std::string& folder) { tracked.masks = folder; },
          "take silhouettes from masks, CAMERA.mkv with white people, instead of the pictures "
          "(default folder: the take's silhouette)")
      ->expected(0, 1)
      ->type_name("[DIR]");
}

Studio OpenTrackedTake(const TrackedTake& tracked, double voxel_mm) {
  Studio studio = OpenTake(tracked.take, {.cameras = tracked.cameras, .masks = MasksOf(tracked)});
  RequireTwoCameras(tracked, studio);
  RequireRoom(CalibrationsOf(studio), voxel_mm, TakeLayout{tracked.take}.Calibration().string());
  TellRemarks(tracked.command, studio.remarks);
  return studio;
}

OpenElsewhere MaskedCamerasOf(const TrackedTake& tracked, Studio& studio) {
  return tracked.masks ? TakeMaskedCameras(studio) : nullptr;
}

std::optional<KnownPerson> SubjectOf(const TrackedTake& tracked) {
  const std::filesystem::path subject = TakeLayout{tracked.take}.Subject();
  if (!IsThere(subject)) return std::nullopt;
  return KnownPerson{"", LoadSubject(subject)};
}

void RequireOut(const TrackedTake& tracked, std::optional<UnfinishedFolder>& new_folder) {
  if (!IsThere(tracked.out)) new_folder.emplace(tracked.out);
  RequireRoomForResult(tracked.out);
}

void TellFault(const TrackedTake& tracked, const std::vector<CameraCalibration>& cameras,
               std::span<const SeenMoment> moments, std::size_t sets) {
  const StudioDiagnosis diagnosis = Diagnose(cameras, moments);
  const std::string take = tracked.take.string() + ": ";
  const std::optional<Finding> fault = FindingOf(diagnosis, cameras);
  // What is tracked above the floor while people walk below it is nobody.
  const bool is_nobody =
      diagnosis.fault == StudioFault::kFloor && diagnosis.person.is_below_floor();
  if (sets > 0 && !is_nobody) {
    if (IsOfCameras(diagnosis.fault)) TellRemarks(tracked.command, {take + fault->text});
    return;
  }
  const std::string why = take + WhyNobody(fault, moments);
  if (HasPoses(tracked.out))
    throw std::runtime_error("nobody was tracked: " + why + "; the earlier result in " +
                             tracked.out.string() + " is kept");
  if (fault && fault->severity == Severity::kWrong)
    throw std::runtime_error("nobody was tracked: " + why);
  TellRemarks(tracked.command, {why});
}

void WriteTracked(const TrackedTake& tracked, const Result& first,
                  const std::map<int, Result>& people) {
  std::vector<std::string> removed = PartsOf(tracked.out);
  if (tracked.people)
    WritePeople(tracked.out, people);
  else
    WriteResult(tracked.out, first);
  for (const std::string& part : PartsOf(tracked.out)) std::erase(removed, part);
  if (!removed.empty())
    TellRemarks(tracked.command,
                {tracked.out.string() + ": replaces an earlier result; removed its " +
                 ListedNames(removed)});
}

}  // namespace mocap
