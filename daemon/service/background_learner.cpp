#include "daemon/service/background_learner.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <thread>
#include <utility>

#include "config/camera_files.h"
#include "core/errors.h"
#include "core/reconstruction/background/change_meter.h"
#include "drivers/clock.h"
#include "drivers/printable_text.h"
#include "drivers/take/unfinished_folder.h"
#include "drivers/take/video_writer.h"

namespace mocap {
namespace {

constexpr std::size_t kFrames = 50;
constexpr std::size_t kFewestFrames = 10;
/// Of the stored videos; nobody plays them.
constexpr double kFps = 10;
constexpr std::size_t kFramesQueued = 8;
constexpr std::int64_t kPatienceNs = 5'000'000'000;
constexpr std::chrono::milliseconds kPause{5};

}  // namespace

/// One camera's part of the observation.
struct BackgroundLearner::Look {
  Doorbell bell;  ///< Nobody waits for it: frames are polled.
  ChangeMeter meter;
  std::vector<BackgroundFrame> frames;
  double changed = 0;
  std::int64_t due_ns = 0;  ///< Earliest capture time of the next frame to use.

  /// Uses frames that are spread evenly over `length_ns`.
  void Take(const TappedFrame& frame, std::int64_t length_ns) {
    if (frame.capture_ns < due_ns || frames.size() == kFrames) return;
    due_ns = frame.capture_ns + length_ns / static_cast<std::int64_t>(kFrames + 1);
    changed = std::max(changed, meter.Measure(frame.image.view()));
    frames.push_back({frame.image, {}});
  }
};

BackgroundSource KnownBackgrounds::Of(std::size_t camera) const {
  const std::scoped_lock lock(mutex_);
  return sources_.at(camera);
}

void KnownBackgrounds::Set(std::size_t camera, BackgroundSource source) {
  const std::scoped_lock lock(mutex_);
  sources_.at(camera) = std::move(source);
}

BackgroundLearner::BackgroundLearner(FramePath& path, std::deque<FrameTap>& taps,
                                     KnownBackgrounds& known, LearningPlace place)
    : path_(path), taps_(taps), known_(known), place_(std::move(place)) {}

std::string BackgroundLearner::Learn(bool anyway, double seconds) {
  if (!place_.refusal.empty()) throw SetupError(place_.refusal);
  if (!anyway) RequireNobody();
  const std::deque<Look> looks = LookAround(seconds);
  if (!anyway) RequireNobody();
  RequireEmptyRoom(looks);
  Keep(looks);
  Use(looks);
  std::string text;
  for (std::size_t i = 0; i < looks.size(); ++i) {
    text += fmt::format("{}: {}, {:.2f} % of the picture changed\n", place_.cameras[i].name,
                        Counted(looks[i].frames.size(), "frame"), 100 * looks[i].changed);
  }
  return text;
}

void BackgroundLearner::RequireNobody() const {
  const CaptureState state = path_.Status().state;
  if (state == CaptureState::kSearching || state == CaptureState::kLost) return;
  throw std::runtime_error(
      "a person is being tracked; if nobody is in the room, use mocap background learn --anyway");
}

std::deque<BackgroundLearner::Look> BackgroundLearner::LookAround(double seconds) {
  const std::size_t cameras = place_.cameras.size();
  std::deque<Look> looks(cameras);
  for (std::size_t i = 0; i < cameras; ++i) {
    TappedFrame item;
    item.image = Image<Bgr>(place_.cameras[i].width_px, place_.cameras[i].height_px);
    taps_[i].Open(kFramesQueued, item, looks[i].bell);
  }
  const std::int64_t begin_ns = SteadyNs();
  const auto length_ns = static_cast<std::int64_t>(std::llround(seconds * 1e9));
  const auto is_done = [&](const Look& look) {
    const bool is_over = SteadyNs() - begin_ns > length_ns;
    return look.frames.size() >= (is_over ? kFewestFrames : kFrames);
  };
  while (!stop_.load() && !std::ranges::all_of(looks, is_done) &&
         SteadyNs() - begin_ns < length_ns + kPatienceNs) {
    for (std::size_t i = 0; i < cameras; ++i) {
      // Bounded, because frames may arrive as fast as they are taken.
      for (std::size_t n = 0; n < kFramesQueued && taps_[i].queue().TryPop(); ++n) {
        looks[i].Take(taps_[i].queue().front(), length_ns);
      }
    }
    std::this_thread::sleep_for(kPause);
  }
  for (FrameTap& tap : taps_) {
    tap.Close();
    tap.Free();
  }
  if (stop_.load()) throw std::runtime_error("mocapd is stopping; the previous background is kept");
  return looks;
}

void BackgroundLearner::RequireEmptyRoom(const std::deque<Look>& looks) const {
  for (std::size_t i = 0; i < looks.size(); ++i) {
    const std::string& name = place_.cameras[i].name;
    if (looks[i].frames.size() < kFewestFrames) {
      throw std::runtime_error(name + " delivers no frames; the previous background is kept");
    }
    if (looks[i].changed <= kMostChange) continue;
    throw std::runtime_error(
        fmt::format("{}: {:.2g} % of its picture changed meanwhile; check that nobody is in the "
                    "room and that its exposure is fixed. The previous background is kept",
                    name, 100 * looks[i].changed));
  }
}

void BackgroundLearner::Keep(const std::deque<Look>& looks) const {
  const std::filesystem::path partial = BeginBackground(place_.folder);
  UnfinishedFolder unfinished(partial);
  for (std::size_t i = 0; i < looks.size(); ++i) {
    const CameraCalibration& camera = place_.cameras[i];
    VideoWriter video(partial / (camera.name + ".mkv"), camera.width_px, camera.height_px, kFps,
                      VideoPixels::kBgr);
    for (const BackgroundFrame& frame : looks[i].frames) video.Write(frame.image.view());
    video.Finish();
  }
  ReplaceBackground(place_.folder, partial);
  unfinished.Finish();
}

void BackgroundLearner::Use(const std::deque<Look>& looks) {
  for (std::size_t i = 0; i < looks.size(); ++i) {
    const CameraCalibration& camera = place_.cameras[i];
    const std::filesystem::path base = place_.folder / camera.name;
    known_.Set(i, OpenCameraBackground(base.string() + ".mkv", base.string() + ".csv", camera));
    path_.ReplaceBackground(static_cast<int>(i), looks[i].frames);
  }
}

}  // namespace mocap
