#include "tools/calibration/wand.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <opencv2/calib3d.hpp>
#include <optional>
#include <random>

#include "tools/calibration/floor.h"

namespace mocap {
namespace {

constexpr int kFewestSharedInstants = 12;
constexpr int kSamples = 40;
constexpr int kSampleMoments = 3;
/// A larger distance on the normalized plane is no match.
constexpr double kFarOff = 0.01;
constexpr double kLengthTolerance = 0.2;
constexpr double kWorstWand_px = 30;

/// Both ends in two cameras, on the normalized plane.
struct WandPair {
  std::array<Vector2, 2> a, b;
  void Turn() { std::swap(b[0], b[1]); }
};

// Distance of q from p's epipolar line (Sampson's).
double Off(const Matrix3& E, const Vector2& p, const Vector2& q) {
  const Vector3 in_b = E * p.homogeneous(), in_a = E.transpose() * q.homogeneous();
  const double value = q.homogeneous().dot(in_b);
  return std::abs(value) /
         std::sqrt(in_b.head<2>().squaredNorm() + in_a.head<2>().squaredNorm() + 1e-18);
}

double Off(const Matrix3& E, const WandPair& pair) {
  return std::min(kFarOff, Off(E, pair.a[0], pair.b[0]) + Off(E, pair.a[1], pair.b[1]));
}

std::vector<WandPair> SharedWands(const BoardDetections& detections,
                                  const std::vector<CameraCalibration>& cameras, int a, int b) {
  std::vector<std::array<const BoardDetection*, 2>> at(static_cast<std::size_t>(detections.moments),
                                                       {nullptr, nullptr});
  for (const BoardDetection& s : detections.detections) {
    if (s.camera == a) at[s.moment][0] = &s;
    if (s.camera == b) at[s.moment][1] = &s;
  }
  std::vector<WandPair> pairs;
  for (const auto& [in_a, in_b] : at) {
    if (in_a == nullptr || in_b == nullptr) continue;
    WandPair pair;
    bool known = true;
    for (int end = 0; end < 2; ++end) {
      const auto p = NormalizedFromPixel(cameras[a].lens, in_a->corners.pixels[end]);
      const auto q = NormalizedFromPixel(cameras[b].lens, in_b->corners.pixels[end]);
      known = known && p && q;
      if (!known) break;
      pair.a[end] = *p;
      pair.b[end] = *q;
    }
    if (known) pairs.push_back(pair);
  }
  return pairs;
}

void AddPoints(const WandPair& pair, std::vector<cv::Point2d>& a, std::vector<cv::Point2d>& b) {
  for (int end = 0; end < 2; ++end) {
    a.emplace_back(pair.a[end].x(), pair.a[end].y());
    b.emplace_back(pair.b[end].x(), pair.b[end].y());
  }
}

Matrix3 MatrixFrom(const cv::Mat& m, int first_row) {
  Matrix3 result;
  for (int i = 0; i < 9; ++i) result(i / 3, i % 3) = m.at<double>(first_row + i / 3, i % 3);
  return result;
}

cv::Mat MatFrom(const Matrix3& m) {
  cv::Mat mat(3, 3, CV_64F);
  for (int i = 0; i < 9; ++i) mat.at<double>(i / 3, i % 3) = m(i / 3, i % 3);
  return mat;
}

// All essential matrices for each assignment of the ends of a few wands.
std::vector<Matrix3> Candidates(const std::array<WandPair, kSampleMoments>& sample) {
  std::vector<Matrix3> candidates;
  for (int way = 0; way < 1 << kSampleMoments; ++way) {
    std::vector<cv::Point2d> a, b;
    for (int i = 0; i < kSampleMoments; ++i) {
      WandPair pair = sample[i];
      if (way >> i & 1) pair.Turn();
      AddPoints(pair, a, b);
    }
    // The last one serves as a test.
    a.resize(5);
    b.resize(5);
    const cv::Mat E = cv::findEssentialMat(a, b, cv::Mat::eye(3, 3, CV_64F));
    for (int row = 0; row + 3 <= E.rows; row += 3) candidates.push_back(MatrixFrom(E, row));
  }
  return candidates;
}

double Cost(const Matrix3& E, const std::vector<WandPair>& pairs) {
  double sum = 0;
  for (WandPair pair : pairs) {
    const double straight = Off(E, pair);
    pair.Turn();
    sum += std::min(straight, Off(E, pair));
  }
  return sum;
}

Matrix3 BestEssential(const std::vector<WandPair>& pairs) {
  std::mt19937 random(1);
  std::uniform_int_distribution<std::size_t> any(0, pairs.size() - 1);
  Matrix3 best = Matrix3::Zero();
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kSamples; ++i) {
    const std::array<WandPair, kSampleMoments> sample = {pairs[any(random)], pairs[any(random)],
                                                         pairs[any(random)]};
    for (const Matrix3& E : Candidates(sample)) {
      const double cost = Cost(E, pairs);
      if (cost >= least) continue;
      least = cost;
      best = E;
    }
  }
  return best;
}

// Assigns ends by epipolar lines. Returns the pose of A's points in B, with a baseline of length 1.
RigidTransform RelativePose(const Matrix3& E, std::vector<WandPair>& pairs) {
  std::vector<cv::Point2d> a, b;
  for (WandPair& pair : pairs) {
    WandPair turned = pair;
    turned.Turn();
    if (Off(E, turned) < Off(E, pair)) pair = turned;
    AddPoints(pair, a, b);
  }
  const cv::Mat K = cv::Mat::eye(3, 3, CV_64F);
  const cv::Mat refined = cv::findEssentialMat(a, b, K, cv::RANSAC, 0.999, kFarOff / 4);
  cv::Mat R, t;
  cv::recoverPose(refined.rows == 3 ? refined : MatFrom(E), a, b, K, R, t);
  return {MatrixFrom(R, 0), {t.at<double>(0), t.at<double>(1), t.at<double>(2)}};
}

// The point nearest to two rays; the first ray is from the origin.
Vector3 Meet(const RigidTransform& X_BA, const Vector2& in_a, const Vector2& in_b) {
  const RigidTransform X_AB = X_BA.Inverse();
  const Vector3 u = in_a.homogeneous().normalized();
  const Vector3 v = (X_AB.R * in_b.homogeneous()).normalized();
  const Matrix3 across_u = Matrix3::Identity() - u * u.transpose();
  const Matrix3 across_v = Matrix3::Identity() - v * v.transpose();
  return (across_u + across_v).inverse() * (across_v * X_AB.p);
}

double MedianLength(const RigidTransform& X_BA, const std::vector<WandPair>& pairs) {
  std::vector<double> lengths;
  for (const WandPair& pair : pairs) {
    const double length =
        (Meet(X_BA, pair.a[0], pair.b[0]) - Meet(X_BA, pair.a[1], pair.b[1])).norm();
    if (std::isfinite(length)) lengths.push_back(length);
  }
  if (lengths.empty()) return 0;
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  return *middle;
}

using Seen = std::vector<BoardDetection*>;

Vector2 Pixel(const BoardDetection& s, int end, bool turned) {
  return s.corners.pixels[turned ? 1 - end : end];
}

double OffPx(const CameraCalibration& camera, const BoardDetection& s,
             const std::array<Vector3, 2>& ends_W, bool turned) {
  double sum = 0;
  for (int end = 0; end < 2; ++end) {
    const Vector3 p_C = camera.X_CW * ends_W[end];
    const auto pixel =
        p_C.z() > 0 ? PixelFromNormalized(camera.lens, p_C.head<2>() / p_C.z()) : std::nullopt;
    sum += pixel ? (*pixel - Pixel(s, end, turned)).norm() : 1000.0;
  }
  return sum;
}

struct PlacedWand {
  std::array<Vector3, 2> ends_W;
  std::vector<bool> turned;
  double off_px = kWorstWand_px;  ///< Mean over cameras.
};

// The best assignment of the ends between the first and another camera.
PlacedWand Place(const Seen& seen, const std::vector<CameraCalibration>& cameras,
                 double length_mm) {
  PlacedWand best;
  for (std::size_t other = 1; other < seen.size(); ++other) {
    for (const bool turned : {false, true}) {
      PlacedWand wand;
      for (int end = 0; end < 2; ++end)
        wand.ends_W[end] =
            Triangulate({{&cameras[seen[0]->camera], Pixel(*seen[0], end, false)},
                         {&cameras[seen[other]->camera], Pixel(*seen[other], end, turned)}});
      const double length = (wand.ends_W[0] - wand.ends_W[1]).norm();
      if (!(std::abs(length / length_mm - 1) < kLengthTolerance)) continue;
      double sum = 0;
      for (const BoardDetection* s : seen) {
        const CameraCalibration& camera = cameras[s->camera];
        const double straight = OffPx(camera, *s, wand.ends_W, false);
        const double round = OffPx(camera, *s, wand.ends_W, true);
        wand.turned.push_back(round < straight);
        sum += std::min(straight, round);
      }
      wand.off_px = sum / static_cast<double>(2 * seen.size());
      if (wand.off_px < best.off_px) best = wand;
    }
  }
  return best;
}

// The roll of a wand is not observable.
RigidTransform PoseOf(const std::array<Vector3, 2>& ends_W) {
  RigidTransform X_WB;
  const Vector3 x = (ends_W[1] - ends_W[0]).normalized();
  const Vector3 y = x.unitOrthogonal();
  X_WB.R << x, y, x.cross(y);
  X_WB.p = ends_W[0];
  return X_WB;
}

void Turn(BoardDetection& s) {
  std::swap(s.corners.pixels[0], s.corners.pixels[1]);
  if (!s.motions.empty()) std::swap(s.motions[0], s.motions[1]);
}

}  // namespace

CameraLink LinkByWand(const BoardDetections& detections,
                      const std::vector<CameraCalibration>& cameras, int a, int b) {
  std::vector<WandPair> pairs = SharedWands(detections, cameras, a, b);
  if (static_cast<int>(pairs.size()) < kFewestSharedInstants) return {};
  RigidTransform X_BA = RelativePose(BestEssential(pairs), pairs);
  const double length = MedianLength(X_BA, pairs);
  if (!(length > 0)) return {};
  X_BA.p *= detections.board.square_mm / length;
  return {static_cast<int>(pairs.size()), X_BA.Inverse()};
}

void PlaceWands(BoardDetections& detections, Bundle& bundle) {
  std::vector<Seen> at(static_cast<std::size_t>(detections.moments));
  for (BoardDetection& s : detections.detections) at[s.moment].push_back(&s);
  bundle.X_WB.assign(at.size(), std::nullopt);
  for (std::size_t m = 0; m < at.size(); ++m) {
    const PlacedWand wand = Place(at[m], bundle.cameras, detections.board.square_mm);
    if (wand.turned.empty()) continue;
    bundle.X_WB[m] = PoseOf(wand.ends_W);
    for (std::size_t i = 0; i < at[m].size(); ++i) {
      if (wand.turned[i]) Turn(*at[m][i]);
    }
  }
}

}  // namespace mocap
