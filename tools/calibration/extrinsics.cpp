#include "tools/calibration/extrinsics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>

#include "core/errors.h"
#include "drivers/nearest_name.h"
#include "tools/calibration/board_pose.h"
#include "tools/calibration/bundle_errors.h"
#include "tools/calibration/wand.h"

namespace mocap {
namespace {

constexpr int kFewestShared = 3;
constexpr double kWorstView_px = 5;
constexpr double kWorstStudioRms_px = 3;
constexpr double kLeastShareKept = 0.5;

// Weighs a rotation of 1 rad like a metre.
constexpr double kMillimetresPerRadian = 1000;

double Apart(const RigidTransform& a, const RigidTransform& b) {
  return kMillimetresPerRadian * LogRotation(a.R * b.R.transpose()).norm() + (a.p - b.p).norm();
}

/// Poses of the board by camera and moment.
using PoseTable = std::vector<std::vector<std::vector<BoardPose>>>;  // [camera][moment]

PoseTable FindPoses(const BoardDetections& detections,
                    const std::vector<CameraCalibration>& cameras) {
  PoseTable table(cameras.size(), std::vector<std::vector<BoardPose>>(
                                      static_cast<std::size_t>(detections.moments)));
  for (const BoardDetection& s : detections.detections) {
    std::vector<BoardPose> poses =
        FindBoardPoses(cameras[s.camera].lens, detections.board, s.corners);
    std::erase_if(poses, [](const BoardPose& pose) { return pose.rms_px > kWorstView_px; });
    table[s.camera][s.moment] = std::move(poses);
  }
  return table;
}

// Transform from camera B's points to camera A, by majority of the shared views.
CameraLink LinkPair(const PoseTable& poses, int a, int b) {
  std::vector<RigidTransform> candidates;
  CameraLink link;
  for (std::size_t m = 0; m < poses[a].size(); ++m) {
    if (poses[a][m].empty() || poses[b][m].empty()) continue;
    ++link.shared;
    // Either of the two poses of a plane may be the right one.
    for (const BoardPose& in_a : poses[a][m]) {
      for (const BoardPose& in_b : poses[b][m])
        candidates.push_back(in_a.X_CB * in_b.X_CB.Inverse());
    }
  }
  double least = std::numeric_limits<double>::infinity();
  for (const RigidTransform& candidate : candidates) {
    double sum = 0;
    // Wrong candidates are far off in all directions; beyond half a metre they count alike.
    for (const RigidTransform& other : candidates) sum += std::min(500.0, Apart(candidate, other));
    if (sum >= least) continue;
    least = sum;
    link.X_AB = candidate;
  }
  return link;
}

// Uses the strongest links first, until all cameras are connected.
void PlaceCameras(const std::function<CameraLink(int, int)>& link_of,
                  std::vector<CameraCalibration>& cameras) {
  const int n = static_cast<int>(cameras.size());
  std::vector<bool> placed(cameras.size(), false);
  placed[0] = true;
  cameras[0].X_CW = {};
  std::map<std::pair<int, int>, CameraLink> links;
  for (int a = 0; a < n; ++a) {
    for (int b = 0; b < n; ++b) {
      if (a < b) links[{a, b}] = link_of(a, b);
    }
  }
  for (int round = 1; round < n; ++round) {
    int best_from = -1, best_to = -1, best_shared = kFewestShared - 1;
    for (const auto& [pair, link] : links) {
      if (placed[pair.first] == placed[pair.second] || link.shared <= best_shared) continue;
      best_shared = link.shared;
      best_from = placed[pair.first] ? pair.first : pair.second;
      best_to = placed[pair.first] ? pair.second : pair.first;
    }
    if (best_to < 0) {
      std::vector<std::string> lonely;
      for (int c = 0; c < n; ++c) {
        if (!placed[c]) lonely.push_back(cameras[c].name);
      }
      throw SetupError(fmt::format(
          "{}: fewer than {} views of the board are shared with the other cameras; carry the board "
          "where both this camera and another see it, or check that the recordings ran at the same "
          "time",
          ListedNames(lonely), kFewestShared));
    }
    const auto& link = links[{std::min(best_from, best_to), std::max(best_from, best_to)}];
    const RigidTransform X_from_to = best_from < best_to ? link.X_AB : link.X_AB.Inverse();
    cameras[best_to].X_CW = X_from_to.Inverse() * cameras[best_from].X_CW;
    placed[best_to] = true;
  }
}

// Of each board's poses by single cameras, selects the one that suits all best.
void PlaceBoards(const BoardDetections& detections, const PoseTable& poses, Bundle& bundle) {
  std::vector<std::vector<const BoardDetection*>> of_moment(
      static_cast<std::size_t>(detections.moments));
  for (const BoardDetection& s : detections.detections) of_moment[s.moment].push_back(&s);
  bundle.X_WB.assign(static_cast<std::size_t>(detections.moments), std::nullopt);
  for (std::size_t m = 0; m < of_moment.size(); ++m) {
    double least = std::numeric_limits<double>::infinity();
    for (const BoardDetection* from : of_moment[m]) {
      for (const BoardPose& pose : poses[from->camera][m]) {
        const RigidTransform X_WB = bundle.cameras[from->camera].X_CW.Inverse() * pose.X_CB;
        double sum = 0;
        for (const BoardDetection* to : of_moment[m]) {
          const CameraCalibration& camera = bundle.cameras[to->camera];
          sum += std::min(
              100.0, PoseRmsPx(camera.lens, detections.board, to->corners, camera.X_CW * X_WB));
        }
        if (sum >= least) continue;
        least = sum;
        bundle.X_WB[m] = X_WB;
      }
    }
  }
}

void PlaceShown(BoardDetections& detections, Bundle& bundle) {
  if (detections.board.kind == BoardKind::kWand) return PlaceWands(detections, bundle);
  PlaceBoards(detections, FindPoses(detections, bundle.cameras), bundle);
}

void PlaceAll(BoardDetections& detections, Bundle& bundle) {
  const std::vector<CameraCalibration> lenses = bundle.cameras;
  if (detections.board.kind == BoardKind::kWand) {
    PlaceCameras([&](int a, int b) { return LinkByWand(detections, lenses, a, b); },
                 bundle.cameras);
  } else {
    const PoseTable poses = FindPoses(detections, lenses);
    PlaceCameras([&](int a, int b) { return LinkPair(poses, a, b); }, bundle.cameras);
  }
  PlaceShown(detections, bundle);
}

// A moment that only one camera saw constrains its intrinsics, but no extrinsics.
void Adjust(const ExtrinsicsOptions& options, StudioFit& fit) {
  BundleOptions refine;
  refine.refine_lenses = false;
  refine.robust_px = 1;
  RefineBundle(fit.detections, refine, fit.bundle);
  refine.refine_lenses = options.refine_lenses;
  refine.refine_lateness = fit.detections.timed;
  RefineBundle(fit.detections, refine, fit.bundle);
  fit.dropped_corners = DropOutliers(fit.bundle, fit.detections);
  refine.robust_px = 0;
  RefineBundle(fit.detections, refine, fit.bundle);
}

// Number of each camera's corners at moments shared with another camera.
std::vector<int> SharedCorners(const BoardDetections& detections) {
  std::vector<int> cameras_at(static_cast<std::size_t>(detections.moments), 0);
  for (const BoardDetection& s : detections.detections) ++cameras_at[s.moment];
  std::vector<int> shared(detections.cameras.size(), 0);
  for (const BoardDetection& s : detections.detections) {
    if (cameras_at[s.moment] > 1) shared[s.camera] += static_cast<int>(s.corners.ids.size());
  }
  return shared;
}

// The first dropped view of a camera; if none was dropped, the worst.
std::string MisfitFrame(const BoardDetections& before, const StudioFit& fit, int camera) {
  for (const BoardDetection& s : before.detections) {
    const bool kept = std::ranges::any_of(fit.detections.detections, [&](const BoardDetection& k) {
      return k.camera == camera && k.name == s.name;
    });
    if (s.camera == camera && !kept) return s.name;
  }
  return WorstView(BundleErrors(fit.detections, fit.bundle), fit.detections, camera).frame;
}

// Alone with the board, every camera fits: only shared views count. Names the worst camera, as it
// pulls the others along.
void RefuseContradiction(const BoardDetections& before, const StudioFit& fit) {
  const std::vector<int> seen = SharedCorners(before), kept = SharedCorners(fit.detections);
  const auto share = [&](std::size_t c) {
    return static_cast<double>(kept[c]) / std::max(1, seen[c]);
  };
  std::size_t worst = 0;
  for (std::size_t c = 1; c < fit.cameras.size(); ++c) {
    if (share(c) / (1 + fit.cameras[c].rms_px) < share(worst) / (1 + fit.cameras[worst].rms_px))
      worst = c;
  }
  const CameraFit& camera = fit.cameras[worst];
  if (fit.cameras.size() < 2 ||
      (camera.rms_px < kWorstStudioRms_px && share(worst) > kLeastShareKept))
    return;
  throw SetupError(
      fmt::format("{}: contradicts the other cameras ({:.1f} px, {:.0f} % of what it shares with "
                  "them fits, not {}); its recording may be another camera's, not of the same "
                  "time, mirrored, or of another lens or size: record all cameras at once, under "
                  "their own names",
                  camera.name, camera.rms_px, 100 * share(worst),
                  MisfitFrame(before, fit, static_cast<int>(worst))));
}

}  // namespace

void MoveWorld(const RigidTransform& X_NW, Bundle& bundle) {
  for (CameraCalibration& camera : bundle.cameras) camera.X_CW = camera.X_CW * X_NW.Inverse();
  for (auto& X_WB : bundle.X_WB) {
    if (X_WB) X_WB = X_NW * *X_WB;
  }
}

void MeasureFit(StudioFit& fit) {
  const std::vector<CornerError> errors = BundleErrors(fit.detections, fit.bundle);
  fit.rms_px = RmsPx(errors, fit.detections, -1);
  fit.cameras.resize(fit.bundle.cameras.size());
  for (std::size_t c = 0; c < fit.cameras.size(); ++c) {
    CameraFit& camera = fit.cameras[c];
    const int id = static_cast<int>(c);
    camera.name = fit.bundle.cameras[c].name;
    camera.rms_px = RmsPx(errors, fit.detections, id);
    camera.views = fit.detections.CountOf(id);
    camera.corners =
        static_cast<int>(std::count_if(errors.begin(), errors.end(), [&](const CornerError& error) {
          return fit.detections.detections[error.detection].camera == id;
        }));
    camera.coverage = CoverageOf(fit.detections, id);
  }
}

StudioFit FitExtrinsics(const BoardDetections& detections,
                        const std::vector<CameraCalibration>& lenses,
                        const ExtrinsicsOptions& options) {
  if (detections.board.LooksSameTurned() && detections.cameras.size() > 1)
    throw SetupError(
        "--board: a " + detections.board.Text() +
        " looks the same when it is turned by half a turn, so that cameras cannot agree which end "
        "is which; expected one side odd and the other even, or a ChArUco board");
  StudioFit fit;
  fit.detections = detections;
  fit.bundle.cameras = lenses;
  PlaceAll(fit.detections, fit.bundle);
  Adjust(options, fit);
  if (detections.timed) {
    // With unknown delays, boards of one moment may have been matched wrongly.
    fit.detections = detections;
    MatchAgain(fit.bundle.lateness_s, fit.detections);
    PlaceShown(fit.detections, fit.bundle);
    Adjust(options, fit);
  }
  MeasureFit(fit);
  RefuseContradiction(detections, fit);
  return fit;
}

}  // namespace mocap
