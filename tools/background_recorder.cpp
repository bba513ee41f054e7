#include "tools/background_recorder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <stdexcept>

#include "core/errors.h"
#include "core/reconstruction/background/change_meter.h"
#include "daemon/service/occupied_room.h"
#include "drivers/clock.h"
#include "drivers/take/video_writer.h"
#include "tools/stop_on_signals.h"

namespace mocap {
namespace {

constexpr int kFrames = 50;
constexpr std::int64_t kSettle_ns = 1'000'000'000;
constexpr std::int64_t kPatience_ns = 5'000'000'000;
constexpr std::chrono::milliseconds kGrabTimeout{200};
/// For scans: step as a share of the picture, and the motion that counts as standing still.
constexpr double kSweepStep = 0.4;
constexpr double kStill_rad = 1e-4;
constexpr int kStillFrames = 5;
constexpr int kFramesADirection = 2;
constexpr std::size_t kMostDirections = 300;

/// Returns the next frame, after outages if need be.
void GrabNext(LiveCamera& camera, Frame& frame) {
  const std::int64_t deadline_ns = SteadyNs() + kPatience_ns;
  while (SteadyNs() < deadline_ns) {
    EndIfStopAsked();
    if (camera.driver->Grab(frame, kGrabTimeout) == GrabStatus::kFrame) return;
  }
  throw std::runtime_error(camera.name + " (" + camera.request.device +
                           ") has delivered no frame for 5 s");
}

/// Angle between two pixels along one axis of the picture.
double AngleBetween(const Lens& lens, const Vector2& from, const Vector2& to, int axis) {
  const auto a = NormalizedFromPixel(lens, from), b = NormalizedFromPixel(lens, to);
  // Assume a wide angle where the distortion cannot be inverted.
  return a && b ? std::abs(std::atan((*b)[axis]) - std::atan((*a)[axis])) : 1;
}

std::vector<double> Steps(double least, double most, double field_rad) {
  const int count = static_cast<int>(std::ceil((most - least) / (kSweepStep * field_rad))) + 1;
  std::vector<double> steps;
  for (int i = 0; i < count; ++i) {
    steps.push_back(count == 1 ? least : least + (most - least) * i / (count - 1));
  }
  return steps;
}

/// Waits until the head stands still; `frame` is then the last one.
void LookThere(LiveCamera& camera, const PanTiltAngles& direction, Frame& frame) {
  const PanTiltLimits limits = camera.head->limits();
  if (!limits.Contain(direction)) {
    throw SetupError(camera.name + ": " + OutOfReach(direction, limits));
  }
  if (!camera.head->TurnTo(direction)) {
    throw std::runtime_error(camera.name + ": its head does not turn");
  }
  const std::int64_t deadline_ns = SteadyNs() + kPatience_ns;
  PanTiltAngles before;
  for (int still = 0; still < kStillFrames && SteadyNs() < deadline_ns;) {
    GrabNext(camera, frame);
    const double moved =
        std::hypot(frame.angles.pan_rad - before.pan_rad, frame.angles.tilt_rad - before.tilt_rad);
    still = moved < kStill_rad ? still + 1 : 0;
    before = frame.angles;
  }
}

BackgroundRecord RecordStill(LiveCamera& camera, const std::filesystem::path& base, Frame& frame,
                             double seconds, int frames) {
  const std::int64_t begin_ns = frame.capture_ns + kSettle_ns;
  const auto interval_ns = static_cast<std::int64_t>(std::llround(seconds * 1e9 / frames));
  VideoWriter writer(base.string() + ".mkv", frame.image.width(), frame.image.height(),
                     frames / seconds, VideoPixels::kBgr);
  ChangeMeter meter;
  BackgroundRecord record;
  std::int64_t due_ns = begin_ns;
  while (frame.capture_ns < begin_ns + interval_ns * frames && record.frames < frames) {
    GrabNext(camera, frame);
    if (frame.capture_ns < due_ns) continue;
    due_ns = std::max(due_ns + interval_ns, frame.capture_ns);
    writer.Write(frame.image);
    record.changed = std::max(record.changed, meter.Measure(frame.image));
    ++record.frames;
  }
  writer.Finish();
  return record;
}

BackgroundRecord RecordSweep(LiveCamera& camera, const std::filesystem::path& base, Frame& frame) {
  VideoWriter writer(base.string() + ".mkv", frame.image.width(), frame.image.height(), 1,
                     VideoPixels::kBgr);
  std::ofstream table(base.string() + ".csv");
  table << "frame,timestamp_ns,pan_rad,tilt_rad\n";
  BackgroundRecord record;
  for (const PanTiltAngles& direction : SweepDirections(camera)) {
    LookThere(camera, direction, frame);
    ChangeMeter meter;
    for (int i = 0; i < kFramesADirection; ++i) {
      GrabNext(camera, frame);
      writer.Write(frame.image);
      table << fmt::format("{},{},{},{}\n", record.frames, frame.capture_ns, frame.angles.pan_rad,
                           frame.angles.tilt_rad);
      record.changed = std::max(record.changed, meter.Measure(frame.image));
      ++record.frames;
    }
  }
  writer.Finish();
  table.close();
  if (!table) throw std::runtime_error(base.string() + ".csv: cannot be written");
  return record;
}

}  // namespace

std::vector<PanTiltAngles> SweepDirections(const LiveCamera& camera) {
  MOCAP_CHECK(camera.head && camera.calibration);
  const CameraCalibration& calibration = *camera.calibration;
  const PanTiltLimits limits = camera.head->limits();
  const double width = calibration.width_px - 1, height = calibration.height_px - 1;
  const std::vector<double> pans =
      Steps(std::max(limits.least.pan_rad, camera.range.least.pan_rad),
            std::min(limits.most.pan_rad, camera.range.most.pan_rad),
            AngleBetween(calibration.lens, {0, height / 2}, {width, height / 2}, 0));
  const std::vector<double> tilts =
      Steps(std::max(limits.least.tilt_rad, camera.range.least.tilt_rad),
            std::min(limits.most.tilt_rad, camera.range.most.tilt_rad),
            AngleBetween(calibration.lens, {width / 2, 0}, {width / 2, height}, 1));
  if (pans.size() * tilts.size() > kMostDirections) {
    throw SetupError(camera.name + ": would scan " + std::to_string(pans.size() * tilts.size()) +
                     " directions; set a narrower pan_range_rad or tilt_range_rad");
  }
  std::vector<PanTiltAngles> directions;
  for (std::size_t row = 0; row < tilts.size(); ++row) {
    for (std::size_t i = 0; i < pans.size(); ++i) {
      directions.push_back({pans[row % 2 == 0 ? i : pans.size() - 1 - i], tilts[row]});
    }
  }
  return directions;
}

BackgroundRecord RecordBackground(LiveCamera& camera, const std::filesystem::path& folder,
                                  double seconds) {
  camera.driver->Start();
  Frame frame;
  GrabNext(camera, frame);
  const bool turns = camera.head && camera.calibration;
  const std::filesystem::path base = folder / camera.name;
  const BackgroundRecord record =
      turns ? RecordSweep(camera, base, frame) : RecordStill(camera, base, frame, seconds, kFrames);
  camera.driver->Stop();
  return record;
}

void RecordOccupied(LiveCamera& camera, const std::filesystem::path& folder, double seconds) {
  camera.driver->Start();
  Frame frame;
  GrabNext(camera, frame);
  const auto wanted = static_cast<int>(std::lround(seconds * kOccupiedFps));
  RecordStill(camera, folder / camera.name, frame, seconds,
              std::min(wanted, kMostOccupiedPictures));
  camera.driver->Stop();
}

}  // namespace mocap
