#include "tools/witness/witness_take.h"

#include <algorithm>
#include <chrono>
#include <map>
#include <tuple>
#include <utility>

#include "config/config.h"
#include "config/load_config.h"
#include "config/open_studio.h"
#include "daemon/pipeline/pipeline.h"
#include "drivers/clock.h"
#include "tools/stop_on_signals.h"
#include "tools/tracked_take.h"
#include "tools/witness/look_planner.h"

namespace mocap {
namespace {

/// Tracks the take and plans the looks.
std::vector<Look> PlanLooks(const WitnessedTake& wanted) {
  const TrackedTake tracked{.command = "witness", .take = wanted.take, .cameras = wanted.cameras};
  Studio studio = OpenTrackedTake(tracked, Config().voxel_mm);
  LookPlanner planner(TimedCamerasOf(wanted.take, CalibrationsOf(studio)), studio.fps_nominal,
                      wanted.rate_hz);
  Pipeline pipeline(std::move(studio),
                    {.voxel_mm = Config().voxel_mm,
                     .overflow = Overflow::kWait,
                     .latency_origin = LatencyOrigin::kArrival,
                     .people = wanted.people.value_or(1)},
                    LoadBodyTable(Trackers().front().body), planner);
  pipeline.ChangeSubject(SubjectOf(tracked));
  pipeline.Start();
  pipeline.Join();
  return planner.looks();
}

/// Asks about the pictures of one camera, in the order of their times.
void AskCamera(StudioCamera& camera, std::multimap<std::int64_t, Look> looks, PoseNetwork& network,
               Witnessed& witnessed) {
  camera.driver->Start();
  Frame frame;
  while (!looks.empty()) {
    EndIfStopAsked();
    // As fast as possible, a recording never times out.
    const GrabStatus status = camera.driver->Grab(frame, std::chrono::milliseconds(1000));
    if (status == GrabStatus::kEnd || status == GrabStatus::kLost) break;
    if (status != GrabStatus::kFrame) continue;
    const auto [first, last] = looks.equal_range(frame.capture_ns);
    for (auto look = first; look != last; ++look) {
      const std::int64_t begin_ns = SteadyNs();
      const PictureRegion region = RegionAround(look->second.box, network.description().aspect());
      std::vector<Keypoint> points = network.Find(frame.image, region);
      witnessed.network_s += static_cast<double>(SteadyNs() - begin_ns) * 1e-9;
      witnessed.failed += points.empty();
      witnessed.views.push_back(
          {camera.calibration.name, frame.capture_ns, look->second.person, std::move(points)});
    }
    looks.erase(looks.begin(), last);
  }
  camera.driver->Stop();
}

}  // namespace

Witnessed WitnessTake(const WitnessedTake& wanted, PoseNetwork& network) {
  std::map<int, std::multimap<std::int64_t, Look>> by_camera;
  for (const Look& look : PlanLooks(wanted)) by_camera[look.camera].emplace(look.capture_ns, look);
  Studio studio = OpenTake(wanted.take, {.cameras = wanted.cameras});
  Witnessed witnessed;
  for (auto& [camera, looks] : by_camera)
    AskCamera(studio.cameras[static_cast<std::size_t>(camera)], std::move(looks), network,
              witnessed);
  std::ranges::sort(witnessed.views, {}, [](const KeypointView& view) {
    return std::tie(view.capture_ns, view.camera, view.person);
  });
  return witnessed;
}

}  // namespace mocap
