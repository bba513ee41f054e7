#include "core/calibration/tsai.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/calibration/levenberg_marquardt.h"
#include "core/errors.h"

namespace mocap {
namespace {

constexpr std::size_t kFewestCoplanar = 8;
constexpr std::size_t kFewestSpatial = 10;
constexpr double kFlatShare = 1e-3;
// With less slant, noise of a fraction of a pixel determines f.
constexpr double kLeastSlant_rad = 0.03;

/// Points in a frame of their own in which Ty is far from 0, and on the sensor in mm from the axis.
struct Problem {
  std::vector<Vector3> p_P;
  std::vector<Vector2> Xd;
  RigidTransform X_PW;
  bool coplanar = false;
};

struct Camera {
  TsaiLens lens;
  RigidTransform X_CP;
};

Matrix3 NearestRotation(const Matrix3& M) {
  const Eigen::JacobiSVD<Matrix3> svd(M, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return svd.matrixU() * svd.matrixV().transpose();
}

// Principal axes of the points, the thinnest last.
Matrix3 PrincipalAxes(std::span<const PointDetection> points, Vector3& spread_mm) {
  Vector3 mean = Vector3::Zero();
  for (const PointDetection& point : points) mean += point.p_W / static_cast<double>(points.size());
  Matrix3 scatter = Matrix3::Zero();
  for (const PointDetection& point : points)
    scatter += (point.p_W - mean) * (point.p_W - mean).transpose();
  const Eigen::SelfAdjointEigenSolver<Matrix3> solver(scatter / static_cast<double>(points.size()));
  spread_mm = solver.eigenvalues().cwiseMax(0).cwiseSqrt().reverse();
  Matrix3 axes = solver.eigenvectors().rowwise().reverse();
  if (axes.determinant() < 0) axes.col(2) = -axes.col(2);
  return axes;
}

void RefuseTooFew(std::size_t count, bool coplanar) {
  const std::size_t wanted = coplanar ? kFewestCoplanar : kFewestSpatial;
  if (count >= wanted) return;
  throw SetupError(std::to_string(count) + (coplanar ? " coplanar" : "") +
                   " points do not determine a camera; expected at least " +
                   std::to_string(wanted));
}

Problem Pose(std::span<const PointDetection> points, const TsaiSensor& sensor) {
  RefuseTooFew(points.size(), true);
  for (const PointDetection& point : points) {
    if (!point.p_W.allFinite() || !point.pixel.allFinite())
      throw SetupError("a point is not a number; expected finite coordinates");
  }
  Problem problem;
  Vector3 spread_mm;
  const Matrix3 axes = PrincipalAxes(points, spread_mm);
  if (spread_mm.y() <= kFlatShare * spread_mm.x())
    throw SetupError("the points lie on one line; expected points that span a plane or a volume");
  problem.coplanar = spread_mm.z() <= kFlatShare * spread_mm.x();
  RefuseTooFew(points.size(), problem.coplanar);
  std::size_t highest = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    Vector2 Xd = (points[i].pixel - sensor.center_px).cwiseProduct(sensor.pitch_mm);
    // For non-coplanar points, stage 1 determines sx.
    if (problem.coplanar) Xd.x() /= sensor.sx;
    problem.Xd.push_back(Xd);
    if (std::abs(Xd.y()) > std::abs(problem.Xd[highest].y())) highest = i;
  }
  // Stage 1 divides by Ty. So the origin is the point farthest from the picture's middle row.
  problem.X_PW.R = axes.transpose();
  problem.X_PW.p = -(axes.transpose() * points[highest].p_W);
  for (const PointDetection& point : points) {
    Vector3 p_P = problem.X_PW * point.p_W;
    if (problem.coplanar) p_P.z() = 0;
    problem.p_P.push_back(p_P);
  }
  return problem;
}

Eigen::VectorXd SolveLeastSquares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b,
                                  const char* reason) {
  // Normalizes columns: they are millimetres, products of these, and numbers.
  const Eigen::VectorXd lengths = A.colwise().norm().cwiseMax(1e-300).transpose();
  const Eigen::MatrixXd scaled = A * lengths.cwiseInverse().asDiagonal();
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(scaled);
  qr.setThreshold(1e-8);
  if (qr.rank() < A.cols()) throw SetupError(reason);
  return qr.solve(b).cwiseQuotient(lengths);
}

constexpr const char* kNoRotation =
    "the points do not determine the camera's rotation; expected points spread over the picture";

// The sign of Ty puts the point farthest from the axis on its own side of the axis.
double SignOfTy(const Problem& problem, const Vector3& row1, const Vector3& row2, double Tx,
                double Ty) {
  std::size_t farthest = 0;
  for (std::size_t i = 0; i < problem.Xd.size(); ++i) {
    if (problem.Xd[i].squaredNorm() > problem.Xd[farthest].squaredNorm()) farthest = i;
  }
  const double x = row1.dot(problem.p_P[farthest]) + Tx;
  const double y = row2.dot(problem.p_P[farthest]) + Ty;
  return Vector2(x, y).dot(problem.Xd[farthest]) < 0 ? -1 : 1;
}

// Tsai 1987, stage 1 for coplanar points, Eqs. (10)–(14).
Camera AlignCoplanar(const Problem& problem, const TsaiSensor& sensor) {
  const auto n = static_cast<Eigen::Index>(problem.Xd.size());
  Eigen::MatrixXd A(n, 5);
  Eigen::VectorXd b(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Vector3& p = problem.p_P[i];
    const Vector2& X = problem.Xd[i];
    A.row(i) << X.y() * p.x(), X.y() * p.y(), X.y(), -X.x() * p.x(), -X.x() * p.y();
    b[i] = X.x();
  }
  const Eigen::VectorXd a = SolveLeastSquares(A, b, kNoRotation);
  const double r1 = a[0], r2 = a[1], r4 = a[3], r5 = a[4];
  const double Sr = r1 * r1 + r2 * r2 + r4 * r4 + r5 * r5;
  const double det = r1 * r5 - r4 * r2;
  // The smaller root of det² Ty⁴ − Sr Ty² + 1, without the cancellation of the usual formula.
  const double root = std::sqrt(std::max(0.0, Sr * Sr - 4 * det * det));
  double Ty = std::sqrt(2 / (Sr + root));
  Vector3 row1(r1 * Ty, r2 * Ty, 0), row2(r4 * Ty, r5 * Ty, 0);
  double Tx = a[2] * Ty;
  const double sign = SignOfTy(problem, row1, row2, Tx, Ty);
  row1 *= sign, row2 *= sign, Tx *= sign, Ty *= sign;
  row1.z() = std::sqrt(std::max(0.0, 1 - row1.squaredNorm()));
  row2.z() = std::sqrt(std::max(0.0, 1 - row2.squaredNorm()));
  if (row1.head<2>().dot(row2.head<2>()) > 0) row2.z() = -row2.z();
  Camera camera;
  camera.lens = {0, 0, sensor.sx, sensor.center_px, sensor.pitch_mm};
  camera.X_CP.R.row(0) = row1;
  camera.X_CP.R.row(1) = row2;
  camera.X_CP.R.row(2) = row1.cross(row2);
  camera.X_CP.R = NearestRotation(camera.X_CP.R);
  camera.X_CP.p = {Tx, Ty, 0};
  return camera;
}

// Tsai 1987, stage 1 for non-coplanar points, Eqs. (16)–(19).
Camera AlignSpatial(const Problem& problem, const TsaiSensor& sensor) {
  const auto n = static_cast<Eigen::Index>(problem.Xd.size());
  Eigen::MatrixXd A(n, 7);
  Eigen::VectorXd b(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Vector2& X = problem.Xd[i];
    A.row(i) << X.y() * problem.p_P[i].transpose(), X.y(), -X.x() * problem.p_P[i].transpose();
    b[i] = X.x();
  }
  const Eigen::VectorXd a = SolveLeastSquares(A, b, kNoRotation);
  double Ty = 1 / a.tail<3>().norm();
  const double sx = a.head<3>().norm() * Ty;
  const double sign =
      SignOfTy(problem, Ty / sx * a.head<3>(), Ty * a.tail<3>(), Ty / sx * a[3], Ty);
  Ty *= sign;
  Camera camera;
  camera.lens = {0, 0, sx, sensor.center_px, sensor.pitch_mm};
  const Vector3 row1 = Ty / sx * a.head<3>(), row2 = Ty * a.tail<3>();
  camera.X_CP.R.row(0) = row1;
  camera.X_CP.R.row(1) = row2;
  camera.X_CP.R.row(2) = row1.cross(row2);
  camera.X_CP.R = NearestRotation(camera.X_CP.R);
  camera.X_CP.p = {Ty / sx * a[3], Ty, 0};
  return camera;
}

// Tsai 1987, stage 2, Eq. (15): f and Tz without distortion, from both coordinates.
void SolveFocalAndDepth(const Problem& problem, Camera& camera) {
  const auto n = static_cast<Eigen::Index>(problem.Xd.size());
  Eigen::MatrixXd A(2 * n, 2);
  Eigen::VectorXd b(2 * n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Vector3 p_C = camera.X_CP * problem.p_P[i];
    Vector2 X = problem.Xd[i];
    if (!problem.coplanar) X.x() /= camera.lens.sx;
    A.row(2 * i) << p_C.x(), -X.x();
    A.row(2 * i + 1) << p_C.y(), -X.y();
    b[2 * i] = X.x() * p_C.z();
    b[2 * i + 1] = X.y() * p_C.z();
  }
  const Eigen::VectorXd solution = SolveLeastSquares(
      A, b, "the focal length and the distance cannot be told apart; expected a larger slant");
  camera.lens.focal_mm = solution[0];
  camera.X_CP.p.z() = solution[1];
}

// For coplanar points, the sign of the slant follows only from f being positive.
void ChooseSlant(const Problem& problem, Camera& camera) {
  SolveFocalAndDepth(problem, camera);
  if (camera.lens.focal_mm > 0) return;
  Matrix3& R = camera.X_CP.R;
  R(0, 2) = -R(0, 2);
  R(1, 2) = -R(1, 2);
  R(2, 0) = -R(2, 0);
  R(2, 1) = -R(2, 1);
  camera.X_CP.p.z() = 0;
  SolveFocalAndDepth(problem, camera);
}

// Parameters: f κ1 Tx Ty Tz, rotation about x, y, z, Cx Cy sx. The first ones vary.
constexpr int kParameters = 11;

Camera Moved(const Camera& camera, const Eigen::VectorXd& change, const std::vector<int>& free) {
  Eigen::VectorXd full = Eigen::VectorXd::Zero(kParameters);
  for (std::size_t i = 0; i < free.size(); ++i) full[free[i]] = change[static_cast<int>(i)];
  Camera moved = camera;
  moved.lens.focal_mm += full[0];
  moved.lens.kappa1 += full[1];
  moved.X_CP.p += full.segment<3>(2);
  moved.X_CP.R = ExpRotation(full.segment<3>(5)) * camera.X_CP.R;
  moved.lens.center_px += full.segment<2>(8);
  moved.lens.sx += full[10];
  return moved;
}

Eigen::VectorXd Residuals(const Camera& camera, const std::vector<Vector3>& p_P,
                          std::span<const PointDetection> points) {
  Eigen::VectorXd r(2 * static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vector3 p_C = camera.X_CP * p_P[i];
    std::optional<Vector2> pixel;
    if (p_C.z() > 0) pixel = PixelFromNormalized(camera.lens, p_C.head<2>() / p_C.z());
    // A camera that could not show the points is not acceptable.
    const Vector2 error =
        pixel ? Vector2(*pixel - points[i].pixel) : Vector2::Constant(HUGE_VAL).eval();
    r.segment<2>(2 * static_cast<Eigen::Index>(i)) = error;
  }
  return r;
}

// Restarts from each result, so that rotations stay small.
Camera Refine(Camera camera, const std::vector<int>& free, const Problem& problem,
              std::span<const PointDetection> points) {
  const double depth = camera.X_CP.p.norm();
  const double f = camera.lens.focal_mm;
  Eigen::VectorXd all(kParameters);
  all << f, 1e-1 / (f * f), depth, depth, depth, 1, 1, 1, 100, 100, 1;
  Eigen::VectorXd scale(static_cast<Eigen::Index>(free.size()));
  for (std::size_t i = 0; i < free.size(); ++i) scale[static_cast<int>(i)] = all[free[i]];
  for (int round = 0; round < 3; ++round) {
    const LeastSquaresResult result = MinimizeSquares(
        [&](const Eigen::VectorXd& x) {
          return Residuals(Moved(camera, x, free), problem.p_P, points);
        },
        Eigen::VectorXd::Zero(scale.size()), scale);
    camera = Moved(camera, result.x, free);
  }
  return camera;
}

void RefuseBadStart(const Problem& problem, const Camera& camera,
                    std::span<const PointDetection> points) {
  const double slant_rad = std::acos(std::min(1.0, std::abs(camera.X_CP.R(2, 2))));
  if (problem.coplanar && slant_rad < kLeastSlant_rad)
    throw SetupError(
        "the points' plane is parallel to the picture, so that the focal length and the distance "
        "cannot be told apart; expected a plane slanted by 30 degrees or more");
  if (!(camera.lens.focal_mm > 0) || !(camera.X_CP.p.z() > 0) ||
      !Residuals(camera, problem.p_P, points).allFinite())
    throw SetupError(
        "no camera fits these points (the focal length or a distance would be negative); the world "
        "may be left-handed or the columns swapped");
}

void Measure(const Camera& camera, const Problem& problem, std::span<const PointDetection> points,
             TsaiCalibration& calibration) {
  const Eigen::VectorXd r = Residuals(camera, problem.p_P, points);
  const auto n = static_cast<double>(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double distance = r.segment<2>(2 * static_cast<Eigen::Index>(i)).norm();
    calibration.mean_px += distance / n;
    calibration.worst_px = std::max(calibration.worst_px, distance);
  }
  calibration.rms_px = std::sqrt(r.squaredNorm() / n);
}

}  // namespace

TsaiCalibration CalibrateTsai(std::span<const PointDetection> points, const TsaiSensor& sensor) {
  if (!(sensor.pitch_mm.minCoeff() > 0) || !(sensor.sx > 0))
    throw SetupError("the sensor's pitch or sx is not above 0; expected the size of a pixel");
  const Problem problem = Pose(points, sensor);
  Camera camera = problem.coplanar ? AlignCoplanar(problem, sensor) : AlignSpatial(problem, sensor);
  if (problem.coplanar) {
    ChooseSlant(problem, camera);
  } else {
    SolveFocalAndDepth(problem, camera);
  }
  RefuseBadStart(problem, camera, points);
  camera = Refine(camera, {0, 1, 4}, problem, points);
  std::vector<int> free = {0, 1, 2, 3, 4, 5, 6, 7};
  camera = Refine(camera, free, problem, points);
  if (!problem.coplanar) free.push_back(10);
  if (sensor.refine_center) free.insert(free.end(), {8, 9});
  camera = Refine(camera, free, problem, points);

  TsaiCalibration calibration;
  calibration.lens = camera.lens;
  calibration.X_CW = camera.X_CP * problem.X_PW;
  calibration.coplanar = problem.coplanar;
  Measure(camera, problem, points, calibration);
  return calibration;
}

}  // namespace mocap
