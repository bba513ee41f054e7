#include "tools/accuracy/people_trial.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "config/config.h"
#include "config/load_config.h"
#include "daemon/pipeline/pipeline.h"
#include "drivers/simulation/simulated_studio.h"
#include "drivers/virtual_studio/motions/company.h"
#include "drivers/virtual_studio/truth.h"
#include "tools/accuracy/simulated_points.h"
#include "tools/results/result_sink.h"

namespace mocap {
namespace {

// Errors count from this time after a person has come in.
constexpr double kSettle_s = 0.3;

std::vector<PresenceBySet> TrueCompany(const SimulatedStudioOptions& options) {
  const SimulatedStudio studio(options);
  const SimulatedTruth simulated(options);
  std::vector<PresenceBySet> truth(options.people);
  const auto sets = static_cast<int>(std::lround(options.seconds * options.fps));
  for (int person = 0; person < options.people; ++person)
    for (int set = 0; set < sets; ++set) {
      const std::int64_t time_ns = studio.NominalTime(set);
      const PersonPresence presence = studio.PresenceOf(person, time_ns);
      if (!presence.in_room) continue;
      truth[person][set] = {.points_W = TrueScoredPoints(simulated, time_ns, person),
                            .whole = presence.whole,
                            .covered = presence.pictures >= kCoveringPictures};
    }
  return truth;
}

std::vector<PosesBySet> FollowedIn(const ResultSink& sink, const SimulatedStudioOptions& options) {
  std::vector<PosesBySet> followed;
  for (const auto& [id, result] : sink.people()) {
    PosesBySet& person = followed.emplace_back();
    for (const PoseRow& row : result.poses) {
      if (row.state != CaptureState::kTracking) continue;
      const double since_s = static_cast<double>(row.timestamp_ns - options.start_ns) * 1e-9;
      person[static_cast<int>(std::lround(since_s * options.fps))] = ScoredPointsOf(row.points_W);
    }
  }
  return followed;
}

}  // namespace

PeopleRow SumUp(const SimulatedStudioOptions& studio, const PeopleAccuracy& accuracy) {
  PeopleRow row{.motion = studio.motion,
                .people = studio.people,
                .seed = studio.seed,
                .mpjpe_mm = accuracy.mpjpe_mm};
  double covered = 0, found = 0;
  for (const PersonAccuracy& person : accuracy.people) {
    row.worst_person_mm = std::max(row.worst_person_mm, person.distance_mm.mean);
    row.longest_lost_s = std::max(row.longest_lost_s, person.longest_lost_sets / studio.fps);
    row.slowest_found_s = std::max(row.slowest_found_s, person.sets_to_first / studio.fps);
    row.switches += person.switches;
    row.never_found += person.covered_sets > 0 && person.sets_to_first < 0;
    covered += person.covered_sets;
    found += person.covered_found_share * person.covered_sets;
  }
  row.found_share = covered > 0 ? found / covered : 0;
  row.phantom_s = (accuracy.phantom_sets + accuracy.duplicate_sets) / studio.fps;
  return row;
}

PeopleRow RunPeopleTrial(const SimulatedStudioOptions& studio) {
  ResultSink sink(KeptPeople::kEverybody, false);
  const Config defaults;
  Pipeline pipeline(OpenSimulatedStudio(studio),
                    {.voxel_mm = defaults.voxel_mm,
                     .overflow = Overflow::kWait,
                     .tracker = defaults.tracker,
                     .people = simulation::kMostSimulatedPeople},
                    LoadBodyTable(defaults.body), sink);
  pipeline.Start();
  pipeline.Join();
  const auto settle_sets = static_cast<int>(std::ceil(kSettle_s * studio.fps));
  return SumUp(studio, MeasurePeople(TrueCompany(studio), FollowedIn(sink, studio), settle_sets));
}

}  // namespace mocap
