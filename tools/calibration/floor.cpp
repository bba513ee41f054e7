#include "tools/calibration/floor.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "core/errors.h"
#include "drivers/nearest_name.h"
#include "drivers/quoted.h"
#include "drivers/take/calibration_file.h"
#include "drivers/take/input_file.h"
#include "tools/calibration/board_pose.h"
#include "tools/calibration/bundle_errors.h"

namespace mocap {
namespace {

constexpr std::size_t kLargestTable = 1 << 20;
constexpr double kWorstFloorRms_px = 3;
constexpr const char* kFloorPointNames[3] = {"origin", "x", "y"};

RigidTransform WorldOn(const Vector3& origin, const Vector3& along_x, const Vector3& up) {
  RigidTransform X_NW;
  const Vector3 z = up.normalized();
  const Vector3 x = (along_x - along_x.dot(z) * z).normalized();
  X_NW.R.row(0) = x;
  X_NW.R.row(1) = z.cross(x);
  X_NW.R.row(2) = z;
  X_NW.p = -(X_NW.R * origin);
  return X_NW;
}

// Up is the side of most cameras.
Vector3 TowardsCameras(const Vector3& normal, const Vector3& origin,
                       const std::vector<CameraCalibration>& cameras) {
  int above = 0;
  for (const CameraCalibration& camera : cameras)
    above += normal.dot(camera.X_CW.Inverse().p - origin) > 0 ? 1 : -1;
  return above >= 0 ? normal : Vector3(-normal);
}

}  // namespace

RigidTransform WorldOnBoard(const RigidTransform& X_WB,
                            const std::vector<CameraCalibration>& cameras, double thickness_mm) {
  const Vector3 up = TowardsCameras(X_WB.R.col(2), X_WB.p, cameras);
  return WorldOn(X_WB.p - thickness_mm * up, X_WB.R.col(0), up);
}

RigidTransform FindStillBoard(const BoardDetections& still,
                              const std::vector<CameraCalibration>& cameras) {
  Bundle bundle;
  bundle.cameras = cameras;
  double least = std::numeric_limits<double>::infinity();
  for (const BoardDetection& from : still.detections) {
    for (const BoardPose& pose :
         FindBoardPoses(cameras[from.camera].lens, still.board, from.corners)) {
      const RigidTransform X_WB = cameras[from.camera].X_CW.Inverse() * pose.X_CB;
      double sum = 0;
      for (const BoardDetection& to : still.detections)
        sum += std::min(1e6, PoseRmsPx(cameras[to.camera].lens, still.board, to.corners,
                                       cameras[to.camera].X_CW * X_WB));
      if (sum >= least) continue;
      least = sum;
      bundle.X_WB = {X_WB};
    }
  }
  if (bundle.X_WB.empty()) throw SetupError("no calibrated camera sees the floor's board");
  BundleOptions refine;
  refine.refine_lenses = refine.refine_poses = false;
  refine.robust_px = 1;
  BoardDetections one = still;
  for (BoardDetection& s : one.detections) s.moment = 0;
  one.moments = 1;
  RefineBundle(one, refine, bundle);
  const std::vector<CornerError> errors = BundleErrors(one, bundle);
  int worst = 0;
  for (int c = 1; c < static_cast<int>(cameras.size()); ++c) {
    if (RmsPx(errors, one, c) > RmsPx(errors, one, worst)) worst = c;
  }
  const double rms_px = RmsPx(errors, one, worst);
  if (rms_px > kWorstFloorRms_px)
    throw SetupError(
        fmt::format("{}: sees the floor's board {:.1f} px from where the other cameras put it; the "
                    "board was moved while it was recorded, or the camera since the board was "
                    "carried: record it again",
                    cameras[static_cast<std::size_t>(worst)].name, rms_px));
  return *bundle.X_WB[0];
}

Vector3 Triangulate(const std::vector<std::pair<const CameraCalibration*, Vector2>>& seen) {
  MOCAP_CHECK(seen.size() >= 2);
  Matrix3 A = Matrix3::Zero();
  Vector3 b = Vector3::Zero();
  for (const auto& [camera, pixel] : seen) {
    const auto n = NormalizedFromPixel(camera->lens, pixel);
    if (!n) continue;
    const RigidTransform X_WC = camera->X_CW.Inverse();
    const Vector3 ray = (X_WC.R * n->homogeneous()).normalized();
    const Matrix3 across = Matrix3::Identity() - ray * ray.transpose();
    A += across;
    b += across * X_WC.p;
  }
  return A.fullPivLu().solve(b);
}

RigidTransform WorldOnPoints(const std::vector<FloorPoint>& points,
                             const std::vector<CameraCalibration>& cameras) {
  Vector3 p_W[3];
  for (int i = 0; i < 3; ++i) {
    std::vector<std::pair<const CameraCalibration*, Vector2>> seen;
    for (const FloorPoint& point : points) {
      if (point.point == i) seen.emplace_back(&cameras[point.camera], point.pixel);
    }
    if (seen.size() < 2)
      throw SetupError(
          fmt::format("floor point \"{}\" is seen by {} cameras; expected at least two",
                      kFloorPointNames[i], seen.size()));
    p_W[i] = Triangulate(seen);
  }
  const Vector3 normal = (p_W[1] - p_W[0]).cross(p_W[2] - p_W[0]);
  if (normal.norm() < 0.05 * (p_W[1] - p_W[0]).norm() * (p_W[2] - p_W[0]).norm())
    throw SetupError("the three floor points lie on a line; a right angle is best");
  // The third point defines y's side. If z then points down, the sides were swapped.
  const Vector3 up = TowardsCameras(normal.normalized(), p_W[0], cameras);
  if (up.dot(normal) < 0)
    throw SetupError(
        "the floor points x and y are swapped: seen from above, y lies to the left of x");
  return WorldOn(p_W[0], p_W[1] - p_W[0], up);
}

std::vector<FloorPoint> ReadFloorPoints(const std::string& file,
                                        const std::vector<CameraCalibration>& cameras) {
  std::istringstream in(ReadWholeFile(file, "a table of floor points", kLargestTable));
  std::vector<FloorPoint> points;
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    if (number == 1 && line.starts_with("\xEF\xBB\xBF")) line.erase(0, 3);
    if (line.ends_with('\r')) line.pop_back();
    if (line.empty() || (number == 1 && line == "point,camera,x_px,y_px")) continue;
    std::istringstream row(line);
    std::string name, camera, x, y;
    std::getline(row, name, ',');
    std::getline(row, camera, ',');
    std::getline(row, x, ',');
    std::getline(row, y, ',');
    const auto place = std::find(std::begin(kFloorPointNames), std::end(kFloorPointNames), name);
    const auto owner = std::find_if(cameras.begin(), cameras.end(),
                                    [&](const CameraCalibration& c) { return c.name == camera; });
    char* x_end = nullptr;
    char* y_end = nullptr;
    FloorPoint point;
    point.pixel = {std::strtod(x.c_str(), &x_end), std::strtod(y.c_str(), &y_end)};
    if (place == std::end(kFloorPointNames) || camera.empty() || x_end == x.c_str() ||
        y_end == y.c_str() || !point.pixel.allFinite())
      throw SetupError(fmt::format("{}:{}: {} is not a floor point; expected origin|x|y,CAMERA,X,Y",
                                   file, number, Quoted(line)));
    if (owner == cameras.end())
      throw SetupError(fmt::format("{}:{}: there is no camera {}; {}", file, number, Quoted(camera),
                                   ExpectedNames(camera, CameraNames(cameras))));
    point.point = static_cast<int>(place - std::begin(kFloorPointNames));
    point.camera = static_cast<int>(owner - cameras.begin());
    points.push_back(point);
  }
  return points;
}

void ScaleWorld(double factor, Bundle& bundle) {
  for (CameraCalibration& camera : bundle.cameras) camera.X_CW.p *= factor;
  for (auto& X_WB : bundle.X_WB) {
    if (X_WB) X_WB->p *= factor;
  }
}

}  // namespace mocap
