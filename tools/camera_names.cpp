#include "tools/camera_names.h"

#include <algorithm>
#include <numeric>
#include <vector>

#include "core/reconstruction/camera/sensor_plane_table.h"
#include "core/reconstruction/carving/carver.h"
#include "tools/report/hull_overlap.h"

namespace mocap {
namespace {

constexpr double kVoxel_mm = 40;
constexpr std::size_t kMostMoments = 4;
/// Mean overlap of cameras that agree, and the gain required of a swap.
constexpr double kAgreement = 0.6, kLeastGain = 0.2;

/// Index of the calibration assigned to each recording.
using Naming = std::vector<std::size_t>;

class NamingJudge {
 public:
  explicit NamingJudge(const TakeSamples& samples)
      : samples_(samples),
        tables_(samples.cameras.begin(), samples.cameras.end()),
        carver_({kVoxel_mm}) {}

  /// Mean overlap of silhouettes with the visual hull carved from them.
  double Overlap(const Naming& naming) {
    double sum = 0;
    int count = 0;
    const std::size_t step = std::max<std::size_t>(1, samples_.moments.size() / kMostMoments);
    for (std::size_t m = 0; m < samples_.moments.size(); m += step) {
      std::vector<CarvingView> views;
      const auto& seen = samples_.moments[m].views;
      for (std::size_t i = 0; i < naming.size(); ++i) {
        if (seen[i] && seen[naming[i]])
          views.push_back({&tables_[naming[i]], &seen[i]->silhouette, seen[naming[i]]->X_CW});
      }
      VoxelGrid hull;
      carver_.Carve(views, hull);
      for (std::size_t i = 0; i < naming.size(); ++i) {
        if (!seen[i] || !seen[naming[i]] || !seen[i]->silhouette.BoundingBox()) continue;
        sum += OverlapOf(ProjectVoxels(hull, samples_.cameras[naming[i]], seen[naming[i]]->X_CW),
                         seen[i]->silhouette);
        ++count;
      }
    }
    return count == 0 ? 0 : sum / count;
  }

 private:
  const TakeSamples& samples_;
  std::vector<SensorPlaneTable> tables_;
  Carver carver_;
};

bool SeesAnything(const TakeSamples& samples, std::size_t camera) {
  return std::ranges::any_of(samples.moments, [camera](const SampledMoment& moment) {
    return moment.views[camera].has_value();
  });
}

bool SameSize(const CameraCalibration& a, const CameraCalibration& b) {
  return a.width_px == b.width_px && a.height_px == b.height_px;
}

}  // namespace

std::optional<CameraPair> FindSwappedCameras(const TakeSamples& samples) {
  NamingJudge judge(samples);
  Naming naming(samples.cameras.size());
  std::iota(naming.begin(), naming.end(), std::size_t{0});
  const double as_named = judge.Overlap(naming);
  if (as_named > kAgreement) return std::nullopt;
  std::optional<CameraPair> swapped;
  double best = std::max(kAgreement, as_named + kLeastGain);
  for (std::size_t a = 0; a < naming.size(); ++a) {
    for (std::size_t b = a + 1; b < naming.size(); ++b) {
      if (!SameSize(samples.cameras[a], samples.cameras[b])) continue;
      // Swapping with a camera that saw nothing would only remove a camera from the hull.
      if (!SeesAnything(samples, a) || !SeesAnything(samples, b)) continue;
      std::swap(naming[a], naming[b]);
      const double overlap = judge.Overlap(naming);
      std::swap(naming[a], naming[b]);
      if (overlap <= best) continue;
      best = overlap;
      swapped.emplace(samples.cameras[a].name, samples.cameras[b].name);
    }
  }
  return swapped;
}

std::string SwappedText(const CameraPair& swapped) {
  return swapped.first + " and " + swapped.second +
         " have each other's name: swap their devices or addresses in [[cameras]], or their names "
         "in calibration.toml";
}

}  // namespace mocap
