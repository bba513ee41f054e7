#include "tools/calibration/head_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/calibration/levenberg_marquardt.h"
#include "core/degrees.h"
#include "core/errors.h"
#include "tools/calibration/board_pose.h"

namespace mocap {
namespace {

constexpr int kFewestHeadViews = 8;
constexpr double kLeastSpan_rad = 10 / kDegreesPerRad;
constexpr double kWorstHeadRms_px = 2;
constexpr double kStanding_rad = 0.002;
// Axis (2) and point (2) of pan and of tilt, both scales; then six per place.
constexpr int kHeadParameters = 10;

struct Model {
  PanTiltFit fit;
  std::vector<RigidTransform> X_WB;  ///< One per place.
};

// Two directions perpendicular to an axis.
Eigen::Matrix<double, 3, 2> Across(const Vector3& axis) {
  Eigen::Matrix<double, 3, 2> across;
  across.col(0) = axis.unitOrthogonal();
  across.col(1) = axis.cross(across.col(0));
  return across;
}

Model Moved(const Model& model, const Eigen::VectorXd& x) {
  Model moved = model;
  PanTiltHead& head = moved.fit.head;
  const auto pan = Across(head.pan_axis_W), tilt = Across(head.tilt_axis_W);
  head.pan_axis_W = (head.pan_axis_W + pan * x.segment<2>(0)).normalized();
  head.pan_point_W += pan * x.segment<2>(2);
  head.tilt_axis_W = (head.tilt_axis_W + tilt * x.segment<2>(4)).normalized();
  head.tilt_point_W += tilt * x.segment<2>(6);
  head.pan_scale += x[8];
  head.tilt_scale += x[9];
  for (std::size_t place = 0; place < moved.X_WB.size(); ++place) {
    const Eigen::Index at = kHeadParameters + 6 * static_cast<Eigen::Index>(place);
    RigidTransform& X_WB = moved.X_WB[place];
    X_WB.R = ExpRotation(x.segment<3>(at)) * X_WB.R;
    X_WB.p += x.segment<3>(at + 3);
  }
  return moved;
}

RigidTransform PoseAt(CameraCalibration camera, const PanTiltFit& fit,
                      const PanTiltAngles& readings) {
  camera.head = fit.head;
  return camera.PoseAt(readings);
}

Eigen::VectorXd Residuals(const CameraCalibration& camera, const Board& board,
                          const std::vector<BoardDetection>& views, const Model& model) {
  std::vector<double> r;
  for (const BoardDetection& view : views) {
    const RigidTransform X_CB =
        PoseAt(camera, model.fit, view.angles) * model.X_WB[static_cast<std::size_t>(view.moment)];
    for (std::size_t i = 0; i < view.corners.ids.size(); ++i) {
      const Vector3 p_C = X_CB * board.Corner(view.corners.ids[i]);
      std::optional<Vector2> pixel;
      if (p_C.z() > 0) pixel = PixelFromNormalized(camera.lens, p_C.head<2>() / p_C.z());
      const Vector2 error =
          pixel ? Vector2(*pixel - view.corners.pixels[i]) : Vector2::Constant(1000).eval();
      r.push_back(error.x());
      r.push_back(error.y());
    }
  }
  return Eigen::Map<Eigen::VectorXd>(r.data(), static_cast<Eigen::Index>(r.size()));
}

void RefuseTooLittleTurning(const std::string& name, const std::vector<BoardDetection>& views) {
  if (static_cast<int>(views.size()) < kFewestHeadViews)
    throw SetupError(fmt::format(
        "{}: {} views do not determine a head; expected at least {} at different angles", name,
        views.size(), kFewestHeadViews));
  const auto span = [&](double PanTiltAngles::*angle) {
    const auto [low, high] = std::minmax_element(
        views.begin(), views.end(), [&](const BoardDetection& a, const BoardDetection& b) {
          return a.angles.*angle < b.angles.*angle;
        });
    return high->angles.*angle - low->angles.*angle;
  };
  const std::pair<const char*, double> spans[] = {{"pan", span(&PanTiltAngles::pan_rad)},
                                                  {"tilt", span(&PanTiltAngles::tilt_rad)}};
  for (const auto& [axis, span_rad] : spans) {
    if (span_rad < kLeastSpan_rad)
      throw SetupError(
          fmt::format("{}: the board is seen over {:.1f} degrees of {} only; turn the head "
                      "by 10 degrees and more while it is in the picture",
                      name, span_rad * kDegreesPerRad, axis));
  }
}

// Numbers the places from 0.
std::vector<BoardDetection> NumberPlaces(std::span<const BoardDetection> detections, int& places) {
  std::map<int, int> numbers;
  std::vector<BoardDetection> views(detections.begin(), detections.end());
  for (BoardDetection& view : views)
    view.moment = numbers.try_emplace(view.moment, static_cast<int>(numbers.size())).first->second;
  places = static_cast<int>(numbers.size());
  return views;
}

// Poses of the boards, from the views with the smallest angles.
std::vector<RigidTransform> PlaceBoards(const CameraCalibration& camera, const Board& board,
                                        const std::vector<BoardDetection>& views, int places,
                                        const PanTiltFit& fit) {
  std::vector<RigidTransform> X_WB(static_cast<std::size_t>(places));
  std::vector<double> nearest(X_WB.size(), HUGE_VAL);
  for (const BoardDetection& view : views) {
    const double turned = std::hypot(view.angles.pan_rad - fit.head.zero.pan_rad,
                                     view.angles.tilt_rad - fit.head.zero.tilt_rad);
    const auto place = static_cast<std::size_t>(view.moment);
    if (turned >= nearest[place]) continue;
    const std::vector<BoardPose> poses = FindBoardPoses(camera.lens, board, view.corners);
    if (poses.empty()) continue;
    nearest[place] = turned;
    X_WB[place] = PoseAt(camera, fit, view.angles).Inverse() * poses.front().X_CB;
  }
  return X_WB;
}

// Assumes an upright head that tilts about the picture's rows, through the lens; tries both senses
// of each axis.
Model FirstGuess(const CameraCalibration& camera, const PanTiltAngles& posed_at, const Board& board,
                 const std::vector<BoardDetection>& views, int places) {
  const Vector3 p_WC = camera.X_CW.Inverse().p;
  const Vector3 right_W = camera.X_CW.R.row(0);
  Model best;
  double least = HUGE_VAL;
  for (const auto& [pan, tilt] : {std::pair(1, 1), {1, -1}, {-1, 1}, {-1, -1}}) {
    Model model;
    model.fit.head = {pan * Vector3::UnitZ(), p_WC, tilt * right_W, p_WC, 1, 1, posed_at};
    model.X_WB = PlaceBoards(camera, board, views, places, model.fit);
    const double cost = Residuals(camera, board, views, model).squaredNorm();
    if (cost >= least) continue;
    least = cost;
    best = model;
  }
  return best;
}

}  // namespace

PanTiltAngles StandingAngles(const std::string& camera, std::span<const PanTiltAngles> readings) {
  MOCAP_CHECK(!readings.empty());
  for (const PanTiltAngles& reading : readings) {
    const double turned_rad =
        std::hypot(reading.pan_rad - readings[0].pan_rad, reading.tilt_rad - readings[0].tilt_rad);
    if (turned_rad > kStanding_rad)
      throw SetupError(
          fmt::format("{}: its head turned by {:.1f} degrees while its extrinsics were calibrated; "
                      "keep heads still while the board is carried about",
                      camera, turned_rad * kDegreesPerRad));
  }
  return readings[0];
}

PanTiltFit FitHead(const CameraCalibration& camera, const PanTiltAngles& posed_at,
                   const Board& board, std::span<const BoardDetection> detections) {
  int places = 0;
  const std::vector<BoardDetection> views = NumberPlaces(detections, places);
  RefuseTooLittleTurning(camera.name, views);
  Model model = FirstGuess(camera, posed_at, board, views, places);
  Eigen::VectorXd scale = Eigen::VectorXd::Constant(kHeadParameters + 6 * places, 1);
  scale.segment<2>(2).setConstant(100);
  scale.segment<2>(6).setConstant(100);
  for (int place = 0; place < places; ++place)
    scale.segment<3>(kHeadParameters + 6 * place + 3).setConstant(1000);
  for (int round = 0; round < 3; ++round) {
    const LeastSquaresResult result = MinimizeSquares(
        [&](const Eigen::VectorXd& x) { return Residuals(camera, board, views, Moved(model, x)); },
        Eigen::VectorXd::Zero(scale.size()), scale, 40);
    model = Moved(model, result.x);
    model.fit.rms_px = std::sqrt(
        2 * result.cost / static_cast<double>(Residuals(camera, board, views, model).size()));
  }
  model.fit.views = static_cast<int>(views.size());
  if (!(model.fit.rms_px < kWorstHeadRms_px))
    throw SetupError(fmt::format(
        "{}: no head explains its {} views ({:.1f} px remain): the board was moved while the head "
        "turned, or the angles are those of other frames, or in degrees",
        camera.name, model.fit.views, model.fit.rms_px));
  return model.fit;
}

}  // namespace mocap
