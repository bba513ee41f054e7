#include "core/reconstruction/camera/camera_model.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "core/degrees.h"

namespace mocap {
namespace {

constexpr int kMaxNewtonSteps = 50;

// Evaluates c0 + c1 s + c2 s² + …
double Evaluate(std::span<const double> coefficients, double s) {
  double value = 0;
  for (auto c = coefficients.rbegin(); c != coefficients.rend(); ++c) value = value * s + *c;
  return value;
}

// Finds the sign changes of a polynomial within (0, limit), in ascending order. Between two
// neighbouring extrema there is at most one.
std::vector<double> SignChanges(std::span<const double> coefficients, double limit) {
  if (coefficients.size() < 2) return {};
  std::vector<double> derivative;
  for (std::size_t i = 1; i < coefficients.size(); ++i) derivative.push_back(i * coefficients[i]);
  std::vector<double> ends = SignChanges(derivative, limit);
  ends.push_back(limit);
  std::vector<double> roots;
  double low = 0;
  for (double high : ends) {
    const double end = high;
    const bool rises = Evaluate(coefficients, high) > 0;
    if ((Evaluate(coefficients, low) > 0) != rises) {
      for (int i = 0; i < 64; ++i) {
        const double middle = (low + high) / 2;
        ((Evaluate(coefficients, middle) > 0) == rises ? high : low) = middle;
      }
      roots.push_back(low);
    }
    low = end;
  }
  return roots;
}

// The coefficients of N + 2 s N', the derivative by r of r N(s) with s = r².
std::vector<double> SlopeOf(std::span<const double> numerator) {
  std::vector<double> slope;
  for (std::size_t i = 0; i < numerator.size(); ++i) slope.push_back((2 * i + 1) * numerator[i]);
  return slope;
}

// Adds a constant times s^shift times a polynomial to another.
void AddProduct(double factor, std::size_t shift, std::span<const double> polynomial,
                std::vector<double>& sum) {
  if (sum.size() < polynomial.size() + shift) sum.resize(polynomial.size() + shift);
  for (std::size_t i = 0; i < polynomial.size(); ++i) sum[i + shift] += factor * polynomial[i];
}

// A radial function f(r) = r N(r²) / D(r²), used as far as it rises. Where it turns back or has a
// pole, a lens shows nothing. N and D begin with 1. Without coefficients of D it is a polynomial.
class RadialFunction {
 public:
  explicit RadialFunction(std::span<const double> numerator,
                          std::span<const double> denominator = {}) {
    numerator_.insert(numerator_.end(), numerator.begin(), numerator.end());
    denominator_.insert(denominator_.end(), denominator.begin(), denominator.end());
    const std::vector<double> slope = SlopeOf(numerator_);
    if (denominator.empty()) {
      rise_ = slope;
      return;
    }
    // f' D² = (N + 2 s N') D − 2 s N D'.
    rise_.clear();
    for (std::size_t i = 0; i < denominator_.size(); ++i) {
      AddProduct(denominator_[i], i, slope, rise_);
      if (i > 0) AddProduct(-2.0 * i * denominator_[i], i, numerator_, rise_);
    }
  }

  double At(double r) const { return r * Evaluate(numerator_, r * r) / DenominatorAt(r); }
  double SlopeAt(double r) const {
    const double d = DenominatorAt(r);
    return Evaluate(rise_, r * r) / (d * d);
  }

  // The first radius within `limit` where it stops rising; `limit` if there is none.
  double TurningRadius(double limit) const {
    const std::vector<double> turns = SignChanges(rise_, limit * limit);
    double turning = turns.empty() ? limit : std::sqrt(turns.front());
    if (const std::vector<double> poles = SignChanges(denominator_, limit * limit); !poles.empty())
      turning = std::min(turning, std::sqrt(poles.front()));
    return turning;
  }

  bool RisesUpTo(double r) const {
    // The negative terms alone decide most directions.
    if (LowestUpTo(rise_, r) > 0 && LowestUpTo(denominator_, r) > 0) return true;
    return TurningRadius(r) >= r;
  }

  // The radius that is mapped to `value`, on the branch that rises from zero.
  std::optional<double> Invert(double value, double limit) const {
    double low = 0;
    double high = TurningRadius(limit);
    if (At(high) < value) return std::nullopt;
    double r = std::min(value, high);
    for (int i = 0; i < kMaxNewtonSteps; ++i) {
      const double error = At(r) - value;
      (error > 0 ? high : low) = r;
      const double newton = r - error / SlopeAt(r);
      const double next = newton > low && newton < high ? newton : (low + high) / 2;
      if (std::abs(next - r) < 1e-15 * (1 + r)) return next;
      r = next;
    }
    return r;
  }

 private:
  double DenominatorAt(double r) const {
    return denominator_.size() == 1 ? 1 : Evaluate(denominator_, r * r);
  }

  // A lower bound on a polynomial in r² within (0, r).
  static double LowestUpTo(std::span<const double> polynomial, double r) {
    double falling = 0;
    for (std::size_t i = polynomial.size(); i-- > 0;)
      falling = falling * r * r + (i == 0 ? polynomial[i] : std::min(polynomial[i], 0.0));
    return falling;
  }

  std::vector<double> numerator_{1}, denominator_{1};  // In r².
  std::vector<double> rise_;                           // Has the sign of f', in r².
};

constexpr double kFarthestAngle_rad = 85 / kDegreesPerRad;
const double kFarthestNormalized = std::tan(kFarthestAngle_rad);

Vector2 ToPixel(const Matrix3& K, const Vector2& p) { return (K * p.homogeneous()).head<2>(); }

Vector2 FromPixel(const Matrix3& K, const Vector2& pixel) {
  const double y = (pixel.y() - K(1, 2)) / K(1, 1);
  return {(pixel.x() - K(0, 2) - K(0, 1) * y) / K(0, 0), y};
}

// Xd from Xu: the real root of κ1 Xd³ + Xd − Xu that tends to Xu as κ1 tends to 0, in a closed form
// without cancellation.
std::optional<double> TsaiDistortedRadius(double kappa1, double undistorted) {
  if (kappa1 == 0) return undistorted;
  const double scale = std::sqrt(3 * std::abs(kappa1));
  const double argument = 1.5 * undistorted * scale;
  if (kappa1 > 0) return 2 / scale * std::sinh(std::asinh(argument) / 3);
  if (argument > 1) return std::nullopt;
  return 2 / scale * std::sin(std::asin(argument) / 3);
}

std::optional<Vector2> Project(const TsaiLens& lens, const Vector2& normalized) {
  const Vector2 undistorted_mm = lens.focal_mm * normalized;
  const double radius = undistorted_mm.norm();
  const std::optional<double> distorted = TsaiDistortedRadius(lens.kappa1, radius);
  if (!distorted) return std::nullopt;
  const Vector2 Xd = undistorted_mm * (radius > 0 ? *distorted / radius : 1);
  return Vector2(lens.sx * Xd.x(), Xd.y()).cwiseQuotient(lens.pitch_mm) + lens.center_px;
}

std::optional<Vector2> Unproject(const TsaiLens& lens, const Vector2& pixel) {
  Vector2 Xd = (pixel - lens.center_px).cwiseProduct(lens.pitch_mm);
  Xd.x() /= lens.sx;
  if (1 + 3 * lens.kappa1 * Xd.squaredNorm() < 0) return std::nullopt;
  return Vector2(Xd * ((1 + lens.kappa1 * Xd.squaredNorm()) / lens.focal_mm));
}

std::array<double, 3> RadialTerms(const OpenCvLens& lens) {
  return {lens.distortion[0], lens.distortion[1], lens.distortion[4]};
}

RadialFunction RadialOf(const OpenCvLens& lens) {
  if (!lens.IsRational()) return RadialFunction(RadialTerms(lens));
  return RadialFunction(RadialTerms(lens), std::span(lens.distortion).subspan<5>());
}

Vector2 Distort(const OpenCvLens& lens, const Vector2& n) {
  const double p1 = lens.distortion[2], p2 = lens.distortion[3];
  const double r2 = n.squaredNorm();
  const double xy = n.x() * n.y();
  double factor = 1 + r2 * Evaluate(RadialTerms(lens), r2);
  if (lens.IsRational()) factor /= 1 + r2 * Evaluate(std::span(lens.distortion).subspan<5>(), r2);
  return n * factor + Vector2(2 * p1 * xy + p2 * (r2 + 2 * n.x() * n.x()),
                              p1 * (r2 + 2 * n.y() * n.y()) + 2 * p2 * xy);
}

std::optional<Vector2> Project(const OpenCvLens& lens, const Vector2& normalized) {
  const double r = normalized.norm();
  if (!(r <= kFarthestNormalized) || !RadialOf(lens).RisesUpTo(r)) return std::nullopt;
  return ToPixel(lens.K, Distort(lens, normalized));
}

std::optional<Vector2> Unproject(const OpenCvLens& lens, const Vector2& pixel) {
  const Vector2 distorted = FromPixel(lens.K, pixel);
  const RadialFunction radial = RadialOf(lens);
  const double radius = distorted.norm();
  const double turning = radial.TurningRadius(kFarthestNormalized);
  const std::optional<double> r = radial.Invert(radius, kFarthestNormalized);
  // Near the rim, tangential terms may still pull a pixel into the picture.
  Vector2 n = radius > 0 ? Vector2(distorted * (r.value_or(turning) / radius)) : distorted;
  for (int i = 0; i < kMaxNewtonSteps; ++i) {
    const double h = 1e-6;
    Eigen::Matrix2d J;
    J.col(0) = (Distort(lens, n + Vector2(h, 0)) - Distort(lens, n - Vector2(h, 0))) / (2 * h);
    J.col(1) = (Distort(lens, n + Vector2(0, h)) - Distort(lens, n - Vector2(0, h))) / (2 * h);
    const Vector2 step = J.inverse() * (distorted - Distort(lens, n));
    if (!step.allFinite()) return std::nullopt;
    n += step;
    if (step.norm() < 1e-14 * (1 + n.norm())) break;
  }
  const bool solved = (Distort(lens, n) - distorted).norm() < 1e-9;
  if (!solved || n.norm() > turning) return std::nullopt;
  return n;
}

std::optional<Vector2> Project(const FisheyeLens& lens, const Vector2& normalized) {
  const double r = normalized.norm();
  if (!(r <= kFarthestNormalized)) return std::nullopt;
  const RadialFunction polynomial(lens.distortion);
  const double theta = std::atan(r);
  if (!polynomial.RisesUpTo(theta)) return std::nullopt;
  return ToPixel(lens.K, normalized * (r > 0 ? polynomial.At(theta) / r : 1));
}

std::optional<Vector2> Unproject(const FisheyeLens& lens, const Vector2& pixel) {
  const Vector2 distorted = FromPixel(lens.K, pixel);
  const double radius = distorted.norm();
  const std::optional<double> theta =
      RadialFunction(lens.distortion).Invert(radius, kFarthestAngle_rad);
  if (!theta) return std::nullopt;
  return Vector2(distorted * (radius > 0 ? std::tan(*theta) / radius : 1));
}

double Radius(const TsaiLens& lens) {
  if (lens.kappa1 >= 0) return kFarthestNormalized;
  return std::min(kFarthestNormalized, 2 / (3 * lens.focal_mm * std::sqrt(-3 * lens.kappa1)));
}

double Radius(const OpenCvLens& lens) { return RadialOf(lens).TurningRadius(kFarthestNormalized); }

double Radius(const FisheyeLens& lens) {
  return std::tan(RadialFunction(lens.distortion).TurningRadius(kFarthestAngle_rad));
}

}  // namespace

double FieldRadius(const Lens& lens) {
  return std::visit([](const auto& l) { return Radius(l); }, lens);
}

std::optional<Vector2> PixelFromNormalized(const Lens& lens, const Vector2& normalized) {
  return std::visit([&](const auto& l) { return Project(l, normalized); }, lens);
}

std::optional<Vector2> NormalizedFromPixel(const Lens& lens, const Vector2& pixel) {
  return std::visit([&](const auto& l) { return Unproject(l, pixel); }, lens);
}

RigidTransform CameraCalibration::PoseAt(const PanTiltAngles& readings) const {
  if (!head) return X_CW;
  const double pan_rad = head->pan_scale * (readings.pan_rad - head->zero.pan_rad);
  const double tilt_rad = head->tilt_scale * (readings.tilt_rad - head->zero.tilt_rad);
  const RigidTransform M = RotationAbout(head->pan_axis_W, head->pan_point_W, pan_rad) *
                           RotationAbout(head->tilt_axis_W, head->tilt_point_W, tilt_rad);
  return X_CW * M.Inverse();
}

}  // namespace mocap
