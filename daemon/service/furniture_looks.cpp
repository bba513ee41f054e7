#include "daemon/service/furniture_looks.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <exception>
#include <utility>

#include "core/reconstruction/empty_room/mean_picture.h"
#include "core/reconstruction/empty_room/steady_picture.h"
#include "drivers/clock.h"
#include "drivers/go_behind.h"

namespace mocap {
namespace {

/// Smaller things are dropped by segmentation, too [share of the picture].
constexpr double kSmallestFurniture = 0.0005;
/// More than this in one camera are changes of light, or a camera that was touched.
constexpr std::size_t kMostFurniture = 3;
/// How long a look waits for frames, and how often it checks for them and for the end.
constexpr std::int64_t kLookNs = 200'000'000;
constexpr std::chrono::milliseconds kLookPause{5};

/// The camera's background as one picture.
EarlierRoom RoomOf(const BackgroundSource& background) {
  MeanPicture mean;
  EarlierRoom room;
  background.ForEach([&](const BackgroundFrame& frame) {
    mean.Add(frame.image);
    room.unseen = frame.unseen;
  });
  room.color = Smooth(mean.Mean().view());
  return room;
}

}  // namespace

FurnitureLooks::FurnitureLooks(const FramePath& path, std::deque<FrameTap>& taps,
                               const KnownBackgrounds& known,
                               std::vector<CameraCalibration> cameras,
                               std::chrono::milliseconds interval)
    : path_(path), taps_(taps), known_(known) {
  for (CameraCalibration& camera : cameras) cameras_.push_back({std::move(camera)});
  thread_ = std::thread([this, interval] { Run(interval); });
}

FurnitureLooks::~FurnitureLooks() {
  stop_.store(true);
  thread_.join();
}

std::vector<MovedFurniture> FurnitureLooks::Moved() const {
  const std::scoped_lock lock(mutex_);
  return moved_;
}

void FurnitureLooks::Run(std::chrono::milliseconds interval) {
  GoBehind("furniture");
  try {
    while (!stop_.load()) {
      Look();
      const auto due = std::chrono::steady_clock::now() + interval;
      while (!stop_.load() && std::chrono::steady_clock::now() < due)
        std::this_thread::sleep_for(std::min(interval, 10 * kLookPause));
    }
  } catch (const std::exception& error) {
    spdlog::warn("moved furniture is no longer looked for: {}", error.what());
  }
}

void FurnitureLooks::Look() {
  const std::vector<CameraStatus> statuses = path_.Status().cameras;
  std::deque<Doorbell> bells(cameras_.size());
  for (std::size_t i = 0; i < cameras_.size(); ++i) {
    TappedFrame item;
    item.image = Image<Bgr>(cameras_[i].calibration.width_px, cameras_[i].calibration.height_px);
    taps_[i].Open(1, item, bells[i]);
  }
  const std::int64_t begin_ns = SteadyNs();
  const auto has_frame = [](const Doorbell& bell) { return bell.count() > 0; };
  while (!stop_.load() && SteadyNs() - begin_ns < kLookNs && !std::ranges::all_of(bells, has_frame))
    std::this_thread::sleep_for(kLookPause);
  for (std::size_t i = 0; i < cameras_.size(); ++i) taps_[i].Close();
  std::vector<MovedFurniture> moved;
  for (std::size_t i = 0; i < cameras_.size(); ++i) {
    Camera& camera = cameras_[i];
    if (!stop_.load() && !camera.calibration.head && taps_[i].queue().TryPop())
      Compare(taps_[i].queue().front(), statuses[i], i);
    taps_[i].Free();
    moved.insert(moved.end(), camera.moved.begin(), camera.moved.end());
  }
  const std::scoped_lock lock(mutex_);
  moved_ = std::move(moved);
}

void FurnitureLooks::Compare(const TappedFrame& frame, const CameraStatus& status,
                             std::size_t index) {
  Camera& camera = cameras_[index];
  const double pixels =
      static_cast<double>(camera.calibration.width_px) * camera.calibration.height_px;
  if (camera.replacements != status.replacements) {
    camera.replacements = status.replacements;
    camera.watch.emplace(RoomOf(known_.Of(index)), static_cast<int>(kSmallestFurniture * pixels));
  }
  camera.moved.clear();
  // The picture as a whole is another one, which has its own line.
  if (status.is_blind) return camera.watch.reset(), void(camera.replacements = -1);
  const std::vector<StillThing> things = camera.watch->Add(frame.image.view(), frame.capture_ns);
  for (const StillThing& thing : things) {
    if (camera.moved.size() == kMostFurniture) break;
    camera.moved.push_back(
        {camera.calibration.name,
         PlaceInPicture(thing.box, camera.calibration.width_px, camera.calibration.height_px),
         thing.area_px / pixels, frame.capture_ns - thing.since_ns});
  }
}

}  // namespace mocap
