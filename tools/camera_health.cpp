#include "tools/camera_health.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "config/load_config.h"
#include "config/take_header.h"
#include "core/errors.h"
#include "core/reconstruction/camera/sensor_plane_table.h"
#include "core/reconstruction/carving/carver.h"
#include "core/reconstruction/silhouette/silhouette_shift.h"
#include "drivers/printable_text.h"
#include "drivers/take/take_layout.h"
#include "drivers/take/take_table.h"
#include "tools/report/hull_overlap.h"

namespace mocap {
namespace {

constexpr double kVoxelMm = 20;
constexpr int kFewestMoments = 4;
constexpr double kSettled_px = 0.25;
constexpr double kLeastOverlap = 0.5;
constexpr double kUsualFatness = 0.2;

/// Converts a mask to bits, for shifting.
Silhouette BitsOf(const Image<std::uint8_t>& mask) {
  Silhouette bits(mask.width(), mask.height());
  for (int y = 0; y < mask.height(); ++y) {
    for (int x = 0; x < mask.width(); ++x) {
      if (mask(x, y) != 0) bits.Set(x, y);
    }
  }
  return bits;
}

VoxelGrid CarveWithout(const SampledMoment& moment, const std::vector<SensorPlaneTable>& tables,
                       const std::vector<RigidTransform>& X_CW, std::size_t left_out,
                       Carver& carver) {
  std::vector<CarvingView> views;
  for (std::size_t c = 0; c < tables.size(); ++c) {
    if (c != left_out && moment.views[c])
      views.push_back({&tables[c], &moment.views[c]->trimap.person, X_CW[c]});
  }
  VoxelGrid grid;
  if (views.size() >= 2) carver.Carve(views, grid);
  return grid;
}

/// Fits rotation and growth of a camera's picture to the observed shifts: least squares over
/// moments.
class PictureChange {
 public:
  explicit PictureChange(const CameraCalibration& camera) : camera_(camera) {
    // Roll moves the picture's middle least and is least observable, so it is kept small. Zoom is
    // visible only as far as the person walks about.
    H_(2, 2) += 1e3;
    H_(3, 3) += 1 / (kUsualGrowth * kUsualGrowth);
  }

  void Add(const SilhouetteShift& match) {
    const auto n = NormalizedFromPixel(camera_.lens, match.middle_px);
    if (!n) return;
    Eigen::Matrix<double, 2, 4> J;
    const Vector3 ray = n->homogeneous();
    for (int axis = 0; axis < 3; ++axis) {
      constexpr double kStep = 1e-4;
      const Vector3 turned = ExpRotation(kStep * Vector3::Unit(axis)) * ray;
      const auto pixel = PixelFromNormalized(camera_.lens, turned.head<2>() / turned.z());
      if (!pixel) return;
      J.col(axis) = (*pixel - match.middle_px) / kStep;
    }
    J.col(3) = match.middle_px - Vector2(camera_.width_px - 1, camera_.height_px - 1) / 2;
    H_ += J.transpose() * J;
    g_ += J.transpose() * match.shift_px;
  }

  /// Rotation vector in the camera's frame [rad], then growth.
  Eigen::Vector4d Solve() const { return H_.ldlt().solve(g_); }

 private:
  static constexpr double kUsualGrowth = 0.02;

  const CameraCalibration& camera_;
  Eigen::Matrix4d H_ = Eigen::Matrix4d::Identity() * 1e-3;
  Eigen::Vector4d g_ = Eigen::Vector4d::Zero();
};

// Shift relative to what silhouette errors may cause. A hull from few cameras is much fatter than
// the person, and may be so on one side.
double Excess(const CameraShift& shift) {
  const double fatness = std::max(1.0, (1 - shift.overlap) / kUsualFatness);
  return shift.shift_px.norm() / (kMovedPx * fatness);
}

Vector2 Median(std::vector<SilhouetteShift> matches) {
  Vector2 median;
  for (int axis = 0; axis < 2; ++axis) {
    const auto middle = matches.begin() + static_cast<std::ptrdiff_t>(matches.size() / 2);
    std::nth_element(matches.begin(), middle, matches.end(),
                     [axis](const SilhouetteShift& a, const SilhouetteShift& b) {
                       return a.shift_px[axis] < b.shift_px[axis];
                     });
    median[axis] = middle->shift_px[axis];
  }
  return median;
}

}  // namespace

std::vector<SampleRequest> ChooseHealthMoments(const std::filesystem::path& take, double from_s,
                                               double to_s, int count) {
  // Says what else the folder is, if it is no take.
  ReadTakeHeader(take);
  const TakeLayout layout{take};
  const std::vector<CameraCalibration> cameras = LoadCalibration(layout.Calibration());
  const auto sees = [&layout](const CameraCalibration& camera) {
    return !HoldsNoRows(layout.Table(camera.name));
  };
  const auto first = std::ranges::find_if(cameras, sees);
  if (first == cameras.end()) {
    throw SetupError(take.string() +
                     ": contains no frame of any camera; expected a take with frames");
  }
  const TakeTable table = ReadTakeTable(layout.Table(first->name));
  const std::int64_t first_ns = table.rows.front().timestamp_ns;
  std::vector<std::int64_t> times_ns;
  for (const TakeRow& row : table.rows) {
    const double s = 1e-9 * static_cast<double>(row.timestamp_ns - first_ns);
    if (s >= from_s && s <= to_s) times_ns.push_back(row.timestamp_ns);
  }
  if (times_ns.empty()) throw SetupError(take.string() + ": has no frames in the requested time");
  std::vector<SampleRequest> requests;
  const std::size_t n = std::min(times_ns.size(), static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < n; ++i)
    requests.push_back({times_ns[(2 * i + 1) * times_ns.size() / (2 * n)], false});
  return requests;
}

std::vector<CameraShift> MeasureShifts(const TakeSamples& samples,
                                       const std::vector<CameraCalibration>& cameras) {
  const std::vector<SensorPlaneTable> tables(cameras.begin(), cameras.end());
  Carver carver({kVoxelMm});
  std::vector<CameraShift> shifts;
  for (std::size_t c = 0; c < cameras.size(); ++c) {
    CameraShift shift;
    shift.camera = cameras[c].name;
    std::vector<SilhouetteShift> matches;
    PictureChange change(cameras[c]);
    for (const SampledMoment& moment : samples.moments) {
      if (!moment.views[c] || !moment.views[c]->trimap.person.BoundingBox()) continue;
      std::vector<RigidTransform> X_CW(cameras.size());
      for (std::size_t k = 0; k < cameras.size(); ++k) {
        if (moment.views[k])
          X_CW[k] = PoseNow(samples.cameras[k], cameras[k], moment.views[k]->X_CW);
      }
      const VoxelGrid hull = CarveWithout(moment, tables, X_CW, c, carver);
      const Silhouette expected = BitsOf(ProjectVoxels(hull, cameras[c], X_CW[c]));
      const SilhouetteShift match = MeasureShift(moment.views[c]->trimap.person, expected);
      if (match.overlap < kLeastOverlap) continue;
      matches.push_back(match);
      change.Add(match);
    }
    shift.moments = static_cast<int>(matches.size());
    if (shift.moments >= kFewestMoments) {
      shift.shift_px = Median(matches);
      for (const SilhouetteShift& match : matches) {
        shift.overlap += match.overlap / shift.moments;
        shift.spread_px += (match.shift_px - shift.shift_px).norm() / shift.moments;
      }
      const Eigen::Vector4d solved = change.Solve();
      shift.rotation_C = solved.head<3>();
      shift.growth = solved[3];
    }
    shifts.push_back(shift);
  }
  return shifts;
}

RefinedStudio RefineFromSilhouettes(const TakeSamples& samples,
                                    const std::vector<CameraCalibration>& cameras) {
  RefinedStudio refined;
  refined.cameras = cameras;
  refined.before = refined.after = MeasureShifts(samples, cameras);
  const auto seeing =
      std::count_if(refined.before.begin(), refined.before.end(),
                    [](const CameraShift& s) { return s.moments >= kFewestMoments; });
  if (seeing < 3)
    throw SetupError(fmt::format("{} {} a whole person who moves; expected at least three",
                                 Counted(seeing, "camera"), seeing == 1 ? "sees" : "see"));
  for (std::size_t round = 0; round < 3 * refined.cameras.size(); ++round) {
    const auto worst =
        std::ranges::max_element(refined.after, {}, [](const CameraShift& s) { return Excess(s); });
    const bool known =
        std::find(refined.moved.begin(), refined.moved.end(), worst->camera) != refined.moved.end();
    // A camera that moved is corrected as well as possible; the others are left alone.
    if (known ? worst->shift_px.norm() < kSettled_px : Excess(*worst) < 1) break;
    if (!known) refined.moved.push_back(worst->camera);
    if (2 * refined.moved.size() > refined.cameras.size())
      throw SetupError(
          "more than half of the cameras disagree with the rest, so it is not known which of them "
          "moved; calibrate again with a board");
    CameraCalibration& camera =
        refined.cameras[static_cast<std::size_t>(worst - refined.after.begin())];
    const Matrix3 turn = ExpRotation(worst->rotation_C);
    camera.X_CW = {turn * camera.X_CW.R, turn * camera.X_CW.p};
    refined.after = MeasureShifts(samples, refined.cameras);
  }
  return refined;
}

bool IsZoomed(const CameraShift& shift) { return std::abs(shift.growth) > kZoomedShare; }

std::vector<std::string> ChangesOf(const RefinedStudio& refined) {
  std::vector<std::string> changes;
  for (const CameraShift& s : refined.before) {
    if (std::ranges::count(refined.moved, s.camera) > 0)
      changes.push_back(fmt::format(
          "{}: has moved since it was calibrated, by {:.1f} px; correct it with mocap calibrate "
          "refine, or calibrate it again with a board",
          s.camera, s.shift_px.norm()));
    if (IsZoomed(s))
      changes.push_back(fmt::format(
          "{}: its picture has become {:.1f} % {}: its focus or zoom was touched; calibrate its "
          "intrinsics again",
          s.camera, 100 * std::abs(s.growth), s.growth > 0 ? "larger" : "smaller"));
  }
  return changes;
}

}  // namespace mocap
