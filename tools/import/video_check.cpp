#include "tools/import/video_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/errors.h"
#include "core/quantile.h"
#include "drivers/nearest_name.h"
#include "drivers/take/calibration_file.h"
#include "drivers/take/video_reader.h"
#include "tools/import/camera_videos.h"
#include "tools/stop_on_signals.h"

namespace mocap {
namespace {

/// Intervals that differ more from the usual one are of a variable rate: rounding to milliseconds
/// makes one.
constexpr double kSteady_s = 0.0025;
/// Frames of a variable rate, at least.
constexpr double kVariableShare = 0.02;
/// Nothing moves far enough in less.
constexpr std::size_t kFewestFrames = 10;
constexpr std::size_t kFewestCameras = 2;

std::vector<double> IntervalsOf(const std::vector<std::int64_t>& times_ns) {
  std::vector<double> intervals_s;
  for (std::size_t i = 1; i < times_ns.size(); ++i)
    intervals_s.push_back(static_cast<double>(times_ns[i] - times_ns[i - 1]) / 1e9);
  return intervals_s;
}

void MeasureRate(ImportedCamera& camera) {
  std::vector<double> intervals_s = IntervalsOf(camera.index.times_ns);
  const double usual_s = MedianOf(intervals_s);
  const auto unusual = std::ranges::count_if(
      intervals_s, [&](double interval_s) { return std::abs(interval_s - usual_s) > kSteady_s; });
  camera.has_variable_rate =
      static_cast<double>(unusual) > kVariableShare * static_cast<double>(intervals_s.size());
  camera.rate_hz = UsualRateHz(camera.index.times_ns);
}

void RequirePictures(const std::filesystem::path& file, const CameraCalibration& camera,
                     std::string* turn) {
  const VideoReader video(file);
  if (turn != nullptr && !video.turn().IsNone()) *turn = video.turn().Text();
  if (video.width_px() == camera.width_px && video.height_px() == camera.height_px) return;
  const bool is_turned =
      video.width_px() == camera.height_px && video.height_px() == camera.width_px;
  throw SetupError(fmt::format(
      "{} has pictures of {}x{} px{}, and the calibration has {}x{}; expected {}", file.string(),
      video.width_px(), video.height_px(), video.turn().IsNone() ? "" : ", " + video.turn().Text(),
      camera.width_px, camera.height_px,
      is_turned ? "a phone that is held as it was for the calibration"
                : "videos in the size of the calibration"));
}

void CheckVideo(ImportedCamera& camera) {
  if (camera.calibration.head)
    throw SetupError("is on a pan-tilt head by the calibration; expected a fixed camera");
  RequirePictures(camera.file, camera.calibration, &camera.turn);
  if (!camera.clip.empty()) RequirePictures(camera.clip, camera.calibration, nullptr);
  camera.index = ReadVideoIndex(camera.file, EndIfStopAsked);
  if (camera.index.times_ns.size() < kFewestFrames)
    throw SetupError(fmt::format("{} has {} pictures; expected at least {}", camera.file.string(),
                                 camera.index.times_ns.size(), kFewestFrames));
  MeasureRate(camera);
}

std::vector<ImportedCamera> Matched(const ImportRequest& request,
                                    std::vector<std::string>& remarks) {
  const std::vector<std::string> names = CameraNames(request.cameras);
  std::vector<ImportedCamera> cameras;
  std::vector<std::string> used;
  for (const NamedVideo& video : MatchVideos(request.videos, names, "", remarks)) {
    ImportedCamera& camera = cameras.emplace_back();
    camera.calibration =
        *std::ranges::find(request.cameras, video.camera, &CameraCalibration::name);
    camera.file = video.file;
    used.push_back(video.camera);
  }
  if (cameras.size() < kFewestCameras)
    throw SetupError(
        fmt::format("found {} video; expected videos of at least two cameras, and of four for good "
                    "poses",
                    cameras.size()));
  for (const NamedVideo& clip : MatchVideos(request.backgrounds, names, "--background", remarks)) {
    const auto camera = std::ranges::find(used, clip.camera);
    if (camera != used.end()) cameras[camera - used.begin()].clip = clip.file;
  }
  std::vector<std::string> unused = names;
  std::erase_if(unused,
                [&](const std::string& name) { return std::ranges::count(used, name) > 0; });
  if (!unused.empty())
    remarks.push_back(request.calibration.string() + ": has no video of " + ListedNames(unused));
  return cameras;
}

// Phones are started one after the other, in about this time; more was not meant.
constexpr double kShortens_s = 10;

std::int64_t Begin(const ImportedCamera& camera) { return camera.times_ns.front(); }
std::int64_t End(const ImportedCamera& camera) { return camera.times_ns.back(); }

CommonTime CommonTimeWithout(const ImportedCamera& one,
                             const std::vector<ImportedCamera>& cameras) {
  CommonTime common{std::numeric_limits<std::int64_t>::min(),
                    std::numeric_limits<std::int64_t>::max()};
  for (const ImportedCamera& camera : cameras) {
    if (&camera == &one) continue;
    common.begin_ns = std::max(common.begin_ns, Begin(camera));
    common.end_ns = std::min(common.end_ns, End(camera));
  }
  return common;
}

}  // namespace

std::vector<ImportedCamera> CheckVideos(const ImportRequest& request,
                                        std::vector<std::string>& remarks) {
  std::vector<ImportedCamera> cameras = Matched(request, remarks);
  std::string wrong;
  for (ImportedCamera& camera : cameras) {
    try {
      CheckVideo(camera);
    } catch (const SetupError& error) {
      wrong += (wrong.empty() ? "" : "; ") + camera.calibration.name + ": " + error.what();
    }
  }
  if (!wrong.empty()) throw SetupError(wrong);
  const auto has_sound = [](const ImportedCamera& camera) { return camera.index.has_sound; };
  for (const ImportedCamera& camera : cameras) {
    if (!has_sound(camera) && std::ranges::any_of(cameras, has_sound))
      remarks.push_back(camera.calibration.name + ": has no sound, and others have");
    if (camera.has_variable_rate)
      remarks.push_back(fmt::format("{}: its rate varies; each picture keeps its own time",
                                    camera.calibration.name));
  }
  return cameras;
}

CommonTime RequireCommonTime(const std::vector<ImportedCamera>& cameras,
                             std::vector<std::string>& remarks) {
  const auto& last = *std::ranges::max_element(cameras, {}, Begin);
  const auto& first = *std::ranges::min_element(cameras, {}, End);
  const CommonTime common{Begin(last), End(first)};
  if (common.length_s() <= 0)
    throw SetupError(
        fmt::format("{}: ends {:.2f} s before {} begins; expected videos of the same time",
                    first.calibration.name, -common.length_s(), last.calibration.name));
  for (const ImportedCamera& camera : cameras) {
    const double longer_s = CommonTimeWithout(camera, cameras).length_s() - common.length_s();
    if (longer_s > kShortens_s)
      remarks.push_back(
          fmt::format("{}: its video shortens the take by {:.1f} s; without it, the "
                      "others film together for {:.1f} s",
                      camera.calibration.name, longer_s, common.length_s() + longer_s));
  }
  return common;
}

void MeasureApart(std::vector<ImportedCamera>& cameras) {
  const std::vector<std::int64_t> fastest =
      std::ranges::max_element(cameras, {}, &ImportedCamera::rate_hz)->times_ns;
  for (ImportedCamera& camera : cameras) {
    std::vector<double> apart_ms;
    for (const std::int64_t time_ns : fastest) {
      const auto after = std::ranges::lower_bound(camera.times_ns, time_ns);
      if (after == camera.times_ns.begin() || after == camera.times_ns.end()) continue;
      apart_ms.push_back(static_cast<double>(std::min(*after - time_ns, time_ns - *(after - 1))) /
                         1e6);
    }
    if (apart_ms.empty()) continue;
    double sum_ms = 0;
    for (const double one_ms : apart_ms) sum_ms += one_ms;
    camera.apart_ms = sum_ms / static_cast<double>(apart_ms.size());
    camera.most_apart_ms = *std::ranges::max_element(apart_ms);
  }
}

}  // namespace mocap
