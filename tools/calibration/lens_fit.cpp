#include "tools/calibration/lens_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/calib3d.hpp>

#include "core/degrees.h"
#include "core/errors.h"
#include "tools/calibration/board_pose.h"
#include "tools/calibration/bundle.h"
#include "tools/calibration/bundle_errors.h"
#include "tools/calibration/lens_parameters.h"

namespace mocap {
namespace {

constexpr int kFewestLensViews = 6;
constexpr double kWorstFocalSigma = 0.1;
constexpr double kWorstLensRms_px = 2.5;
constexpr double kLeastTilts_rad = 0.25;

using Cells = std::array<int, Coverage::kColumns * Coverage::kRows>;

Cells CellsOf(const DetectionCamera& camera, const BoardCorners& corners) {
  Cells cells{};
  for (const Vector2& pixel : corners.pixels) {
    const int x = std::clamp(static_cast<int>(pixel.x() * Coverage::kColumns / camera.width_px), 0,
                             Coverage::kColumns - 1);
    const int y = std::clamp(static_cast<int>(pixel.y() * Coverage::kRows / camera.height_px), 0,
                             Coverage::kRows - 1);
    cells[y * Coverage::kColumns + x] = 1;
  }
  return cells;
}

// Repeatedly selects the view with most in the least covered cells.
std::vector<int> ChooseViews(const BoardDetections& detections, int camera, int most) {
  std::vector<int> left, chosen;
  for (std::size_t s = 0; s < detections.detections.size(); ++s) {
    if (detections.detections[s].camera == camera) left.push_back(static_cast<int>(s));
  }
  Cells shown{};
  while (!left.empty() && static_cast<int>(chosen.size()) < most) {
    double best_gain = -1;
    std::size_t best = 0;
    for (std::size_t i = 0; i < left.size(); ++i) {
      const Cells cells =
          CellsOf(detections.cameras[camera], detections.detections[left[i]].corners);
      double gain = 0;
      for (std::size_t k = 0; k < cells.size(); ++k) gain += cells[k] / (1.0 + shown[k]);
      if (gain > best_gain) {
        best_gain = gain;
        best = i;
      }
    }
    const Cells cells =
        CellsOf(detections.cameras[camera], detections.detections[left[best]].corners);
    for (std::size_t k = 0; k < cells.size(); ++k) shown[k] += cells[k];
    chosen.push_back(left[best]);
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(best));
  }
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

struct Zhang {
  Matrix3 K = Matrix3::Identity();
  double k1 = 0, k2 = 0;
  double focal_sigma_share = 0;
  double rms_px = 0;
  int worst_view = 0;  ///< Of those that were given.
};

Zhang FirstLens(const BoardDetections& detections, int camera, const std::vector<int>& views) {
  std::vector<std::vector<cv::Point3f>> points;
  std::vector<std::vector<cv::Point2f>> pixels;
  for (const int s : views) {
    const BoardCorners& corners = detections.detections[s].corners;
    points.emplace_back();
    pixels.emplace_back();
    for (std::size_t i = 0; i < corners.ids.size(); ++i) {
      const Vector3 p_B = detections.board.Corner(corners.ids[i]);
      points.back().emplace_back(static_cast<float>(p_B.x()), static_cast<float>(p_B.y()), 0.f);
      pixels.back().emplace_back(static_cast<float>(corners.pixels[i].x()),
                                 static_cast<float>(corners.pixels[i].y()));
    }
  }
  const DetectionCamera& c = detections.cameras[camera];
  cv::Mat K, distortion, sigma, pose_sigma, view_errors;
  std::vector<cv::Mat> rotations, translations;
  const double rms_px = cv::calibrateCamera(
      points, pixels, {c.width_px, c.height_px}, K, distortion, rotations, translations, sigma,
      pose_sigma, view_errors, cv::CALIB_FIX_K3 | cv::CALIB_ZERO_TANGENT_DIST);
  Zhang zhang;
  zhang.rms_px = rms_px;
  const auto errors = cv::Mat_<double>(view_errors);
  zhang.worst_view =
      static_cast<int>(std::max_element(errors.begin(), errors.end()) - errors.begin());
  for (int i = 0; i < 9; ++i) zhang.K(i / 3, i % 3) = K.at<double>(i / 3, i % 3);
  zhang.k1 = distortion.at<double>(0);
  zhang.k2 = distortion.at<double>(1);
  zhang.focal_sigma_share = sigma.at<double>(1) / K.at<double>(1, 1);
  return zhang;
}

Lens MakeLens(const Zhang& zhang, const LensFitOptions& options) {
  const double fx = zhang.K(0, 0), fy = zhang.K(1, 1);
  const Vector2 center(zhang.K(0, 2), zhang.K(1, 2));
  if (options.model == LensModel::kTsai) {
    const double focal_mm = fy * options.pitch_mm.y();
    return TsaiLens{focal_mm, -zhang.k1 / (focal_mm * focal_mm),
                    fx * options.pitch_mm.x() / focal_mm, center, options.pitch_mm};
  }
  Matrix3 K = Matrix3::Identity();
  K << fx, 0, center.x(), 0, fy, center.y(), 0, 0, 1;
  if (options.model == LensModel::kOpenCv) return OpenCvLens{K, {zhang.k1, zhang.k2, 0, 0, 0}};
  // tan θ (1 + k1 tan² θ) = θ (1 + (k1 + 1/3) θ²) + …
  return FisheyeLens{K, {zhang.k1 + 1.0 / 3, 0, 0, 0}};
}

// The camera alone; each view is a moment.
struct LensProblem {
  BoardDetections detections;
  Bundle bundle;
};

LensProblem MakeProblem(const BoardDetections& all, int camera, const std::vector<int>& views,
                        const Lens& lens) {
  LensProblem problem;
  const DetectionCamera& c = all.cameras[camera];
  problem.detections.board = all.board;
  problem.detections.cameras = {c};
  problem.bundle.cameras.push_back({c.name, c.width_px, c.height_px, lens, {}, {}});
  for (const int s : views) {
    const std::vector<BoardPose> poses = FindBoardPoses(lens, all.board, all.detections[s].corners);
    if (poses.empty()) continue;
    BoardDetection detection = all.detections[s];
    detection.camera = 0;
    detection.late_s = 0;
    detection.motions.clear();
    detection.moment = problem.detections.moments++;
    problem.detections.detections.push_back(detection);
    problem.bundle.X_WB.push_back(poses.front().X_CB);
  }
  return problem;
}

// "frame 3 to frame 41", in the order of search.
std::string FramesText(const BoardDetections& detections, const std::vector<int>& views) {
  if (views.empty()) return "no frame";
  const std::string &first = detections.detections[views.front()].name,
                    &last = detections.detections[views.back()].name;
  return first == last ? first : first + " to " + last;
}

// Boards in parallel planes do not constrain the focal length, however many they are.
void RefuseOneTilt(const std::string& name, const std::string& frames, const Bundle& bundle) {
  double widest_rad = 0;
  for (const auto& a : bundle.X_WB) {
    for (const auto& b : bundle.X_WB)
      widest_rad =
          std::max(widest_rad, std::acos(std::clamp(a->R.col(2).dot(b->R.col(2)), -1., 1.)));
  }
  if (widest_rad < kLeastTilts_rad)
    throw SetupError(
        fmt::format("{}: its {} views of the board ({}) are tilted alike (within {:.0f} degrees); "
                    "tilt the board by 30 degrees and more, in all directions",
                    name, bundle.X_WB.size(), frames, widest_rad * kDegreesPerRad));
}

[[noreturn]] void RefuseMisfit(const std::string& name, double rms_px, int views,
                               const std::string& worst_frame) {
  throw SetupError(
      fmt::format("{}: no lens explains the corners ({:.2f} px remain in {} views, most in {}); "
                  "the board may be bent, its columns and rows swapped, or the focus or zoom "
                  "changed while it was shown",
                  name, rms_px, views, worst_frame));
}

// The person who holds the board can do nothing about corners that fit no plane.
void RefuseUncertainFocus(const std::string& name, const BoardDetections& detections,
                          const std::vector<int>& views, const Zhang& zhang) {
  if (zhang.focal_sigma_share < kWorstFocalSigma && zhang.K.allFinite()) return;
  const int count = static_cast<int>(views.size());
  if (!(zhang.rms_px < kWorstLensRms_px))
    RefuseMisfit(name, zhang.rms_px, count, detections.detections[views[zhang.worst_view]].name);
  throw SetupError(fmt::format(
      "{}: its {} views ({}) leave the focal length uncertain by {:.0f} %; tilt the "
      "board by 30 degrees and more, in all directions",
      name, count, FramesText(detections, views), std::min(999.0, 100 * zhang.focal_sigma_share)));
}

}  // namespace

LensFit FitLens(const BoardDetections& detections, int camera, const LensFitOptions& options) {
  const DetectionCamera& c = detections.cameras[camera];
  const std::vector<int> views = ChooseViews(detections, camera, options.most_views);
  if (static_cast<int>(views.size()) < kFewestLensViews)
    throw SetupError(
        fmt::format("{}: {} views of the board ({}) do not determine a lens; show it in at least "
                    "{}, tilted in different directions and in all parts of the picture",
                    c.name, views.size(), FramesText(detections, views), kFewestLensViews));
  const Zhang zhang = FirstLens(detections, camera, views);
  RefuseUncertainFocus(c.name, detections, views, zhang);
  LensProblem problem = MakeProblem(detections, camera, views, MakeLens(zhang, options));
  RefuseOneTilt(c.name, FramesText(detections, views), problem.bundle);
  BundleOptions refine;
  refine.robust_px = 1;
  RefineBundle(problem.detections, refine, problem.bundle);
  refine.robust_px = 0;
  DropOutliers(problem.bundle, problem.detections);
  const bool settled = RefineBundle(problem.detections, refine, problem.bundle);
  LensFit fit;
  fit.lens = problem.bundle.cameras[0].lens;
  fit.rms_px = RmsPx(BundleErrors(problem.detections, problem.bundle), problem.detections, 0);
  fit.views = static_cast<int>(problem.detections.detections.size());
  fit.focal_sigma_share = zhang.focal_sigma_share;
  fit.used = views;
  if (!settled || !(fit.rms_px < kWorstLensRms_px))
    RefuseMisfit(
        c.name, fit.rms_px, fit.views,
        WorstView(BundleErrors(problem.detections, problem.bundle), problem.detections, 0).frame);
  return fit;
}

}  // namespace mocap
