#include "daemon/pipeline/health_watch.h"

#include <numeric>
#include <utility>

#include "core/quantile.h"
#include "core/reconstruction/carving/unknown_share.h"
#include "drivers/go_behind.h"

namespace mocap {
namespace {

constexpr std::size_t kSetsQueued = 1;
constexpr std::size_t kMoments = 12;
/// A standing person counts once: one stance may mislead, several do not.
constexpr double kAnotherPlace_mm = 150;
/// Less than this is nobody [mm³].
constexpr double kLeastPerson_mm3 = 1e7;

double VolumeOf(const VoxelGrid& grid) {
  return static_cast<double>(grid.Count()) * grid.voxel_mm() * grid.voxel_mm() * grid.voxel_mm();
}

template <typename Value>
void Keep(const Value& value, std::size_t most, std::deque<Value>& latest) {
  latest.push_back(value);
  if (latest.size() > most) latest.pop_front();
}

double MedianShift(const std::deque<SilhouetteShift>& shifts, int axis) {
  std::vector<double> values;
  for (const SilhouetteShift& shift : shifts) values.push_back(shift.shift_px[axis]);
  return MedianOf(values);
}

CameraHealth HealthOf(const std::deque<SilhouetteShift>& shifts,
                      const std::deque<double>& unknown) {
  CameraHealth health{.moments = static_cast<int>(shifts.size())};
  if (unknown.size() == HealthWatch::kFewestMoments) {
    health.unknown_share =
        std::accumulate(unknown.begin(), unknown.end(), 0.0) / static_cast<double>(unknown.size());
  }
  if (shifts.empty()) return health;
  health.shift_px = {MedianShift(shifts, 0), MedianShift(shifts, 1)};
  for (const SilhouetteShift& shift : shifts) health.overlap += shift.overlap;
  health.overlap /= static_cast<double>(shifts.size());
  return health;
}

}  // namespace

HealthWatch::HealthWatch(const std::vector<CameraCalibration>& cameras)
    : tables_(cameras.begin(), cameras.end()),
      people_watch_(cameras),
      shifts_(cameras.size()),
      unknown_(cameras.size()),
      miss_rates_(cameras.size()) {
  tap_.Open(kSetsQueued, {}, bell_);
  thread_ = std::thread([this] { Run(); });
}

HealthWatch::~HealthWatch() {
  tap_.Close();
  thread_.join();
}

void HealthWatch::Run() {
  // A start may be ended at once; busy processors would delay the end of an idle thread.
  bell_.WaitPast(0);
  GoBehind("health");
  SetTap::Queue& queue = tap_.queue();
  for (;;) {
    const int seen = bell_.count();
    const bool is_closed = queue.closed();
    if (is_closed) return;
    if (queue.TryPop()) {
      Add(queue.front());
    } else {
      bell_.WaitPast(seen);
    }
  }
}

void HealthWatch::Add(const SeenSet& set) {
  LookForPeople(set);
  CompareHulls(set);
  MeasureUnknown(set);
  const std::scoped_lock lock(mutex_);
  for (std::size_t i = 0; i < set.miss_rates.size(); ++i)
    miss_rates_[static_cast<std::size_t>(set.cameras[i])] = set.miss_rates[i];
}

void HealthWatch::LookForPeople(const SeenSet& set) {
  SeenMoment moment(tables_.size());
  for (std::size_t i = 0; i < set.cameras.size(); ++i) {
    moment[static_cast<std::size_t>(set.cameras[i])] = ShapeOf(set.trimaps[i].person, set.X_CW[i]);
  }
  SeenPeople people = people_watch_.Add(set.capture_ns, std::move(moment));
  const std::scoped_lock lock(mutex_);
  people_ = std::move(people);
}

void HealthWatch::CompareHulls(const SeenSet& set) {
  std::vector<CarvingView> views;
  for (std::size_t i = 0; i < set.cameras.size(); ++i) {
    const auto camera = static_cast<std::size_t>(set.cameras[i]);
    views.push_back({&tables_[camera], &set.trimaps[i].person, set.X_CW[i]});
  }
  const std::optional<Vector3> place_W = agreement_.PlaceOf(views);
  if (!place_W) return;
  if (last_place_W_ && (*place_W - *last_place_W_).norm() < kAnotherPlace_mm) return;
  last_place_W_ = place_W;
  const auto& measured = agreement_.Measure(views);
  const std::scoped_lock lock(mutex_);
  for (std::size_t i = 0; i < measured.size(); ++i) {
    if (!measured[i]) continue;
    Keep(*measured[i], kMoments, shifts_[static_cast<std::size_t>(set.cameras[i])]);
  }
}

// A person who walks in is told soon: of few moments, but not of one.
void HealthWatch::MeasureUnknown(const SeenSet& set) {
  if (VolumeOf(set.hull) < kLeastPerson_mm3) return;
  for (std::size_t i = 0; i < set.cameras.size(); ++i) {
    const auto camera = static_cast<std::size_t>(set.cameras[i]);
    const Trimap& trimap = set.trimaps[i];
    const std::optional<double> share =
        UnknownShare(set.hull, {&tables_[camera], &trimap.person, set.X_CW[i], &trimap.unknown});
    const std::scoped_lock lock(mutex_);
    if (share) Keep(*share, kFewestMoments, unknown_[camera]);
  }
}

SeenPeople HealthWatch::People() const {
  const std::scoped_lock lock(mutex_);
  return people_;
}

std::vector<CameraHealth> HealthWatch::Health() const {
  const std::scoped_lock lock(mutex_);
  std::vector<CameraHealth> health;
  for (std::size_t i = 0; i < shifts_.size(); ++i) {
    health.push_back(HealthOf(shifts_[i], unknown_[i]));
    health.back().miss_rate = miss_rates_[i];
  }
  return health;
}

}  // namespace mocap
