#include "tests/core/reconstruction/synthetic_studio.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mocap {
namespace {

constexpr int kWidth_px = 320;
constexpr int kHeight_px = 240;

CameraCalibration HalfSizeCamera() {
  TsaiLens lens = BarrelTsaiLens();
  lens.pitch_mm *= 2;
  lens.center_px /= 2;
  CameraCalibration camera;
  camera.width_px = kWidth_px;
  camera.height_px = kHeight_px;
  camera.lens = lens;
  return camera;
}

std::vector<Vector3> Circle(int places) {
  std::vector<Vector3> circle_W;
  for (int i = 0; i < places; ++i) {
    const double turn = 2 * std::numbers::pi * i / places;
    circle_W.emplace_back(3800 * std::cos(turn), 3800 * std::sin(turn), 1500 + 100 * (i * 7 % 13));
  }
  return circle_W;
}

// Between a ray from the origin and a segment.
double Distance(const Vector3& ray, const Vector3& a, const Vector3& b) {
  const Vector3 d = ray.normalized();
  const auto to_ray = [&](double t) {
    const Vector3 p = a + t * (b - a);
    return (p - std::max(p.dot(d), 0.0) * d).norm();
  };
  double low = 0, high = 1;  // Convex in t.
  for (int i = 0; i < 40; ++i) {
    const double third = (high - low) / 3;
    if (to_ray(low + third) < to_ray(high - third))
      high -= third;
    else
      low += third;
  }
  return to_ray(low);
}

}  // namespace

RigidTransform LookAt(const Vector3& eye_W, const Vector3& target_W) {
  const Vector3 z = (target_W - eye_W).normalized();
  const Vector3 x = z.cross(Vector3::UnitZ()).normalized();
  RigidTransform X_CW;
  X_CW.R << x.transpose(), z.cross(x).transpose(), z.transpose();
  X_CW.p = -(X_CW.R * eye_W);
  return X_CW;
}

SyntheticStudio::SyntheticStudio()
    : SyntheticStudio({Vector3(-2800, -2700, 2300), Vector3(100, -2900, 2000),
                       Vector3(2750, -2800, 2500), Vector3(2900, 2700, 2200),
                       Vector3(-150, 2850, 2600), Vector3(-2700, 2900, 2100)}) {}

SyntheticStudio::SyntheticStudio(int places) : SyntheticStudio(Circle(places)) {}

SyntheticStudio::SyntheticStudio(const std::vector<Vector3>& eyes_W) : table_(HalfSizeCamera()) {
  for (const Vector3& eye_W : eyes_W) {
    cameras.push_back(HalfSizeCamera());
    cameras.back().X_CW = LookAt(eye_W, {0, 0, 900});
  }
  for (int y = 0; y < kHeight_px; ++y)
    for (int x = 0; x < kWidth_px; ++x)
      directions_.push_back(NormalizedFromPixel(cameras[0].lens, Vector2(x, y)));
}

void SyntheticStudio::Show(const std::vector<DrawnCapsule>& capsules) {
  for (auto* const planes : {&silhouettes, &unknown})
    planes->assign(cameras.size(), Silhouette(kWidth_px, kHeight_px));
  for (std::size_t c = 0; c < cameras.size(); ++c) {
    const RigidTransform& X_CW = cameras[c].X_CW;
    for (const DrawnCapsule& capsule : capsules) {
      const Vector3 a = X_CW * capsule.a_W;
      const Vector3 b = X_CW * capsule.b_W;
      const Vector3 middle = (a + b) / 2;
      const double reach = (a - b).norm() / 2 + capsule.radius_mm;
      for (int y = 0; y < kHeight_px; ++y) {
        for (int x = 0; x < kWidth_px; ++x) {
          const std::optional<Vector2>& n = directions_[y * kWidth_px + x];
          if (!n) continue;
          const Vector3 ray = n->homogeneous();
          if (ray.cross(middle).norm() > reach * ray.norm()) continue;
          if (Distance(ray, a, b) < capsule.radius_mm) silhouettes[c].Set(x, y);
        }
      }
    }
  }
}

std::vector<CarvingView> SyntheticStudio::Views() const {
  std::vector<CarvingView> views;
  for (std::size_t c = 0; c < cameras.size(); ++c)
    views.push_back({&table_, &silhouettes[c], cameras[c].X_CW, &unknown[c]});
  return views;
}

void EraseLegs(Silhouette& silhouette) {
  const PixelBox box = silhouette.BoundingBox().value();
  for (int y = (box.top + box.bottom) / 2; y < silhouette.height(); ++y)
    std::fill_n(silhouette.row(y), silhouette.words_per_row(), 0);
}

std::vector<DrawnCapsule> StandingPerson(double x, double y) {
  const auto at = [&](double dx, double dy, double z) { return Vector3(x + dx, y + dy, z); };
  return {{at(0, 0, 950), at(0, 0, 1350), 130},      {at(0, 0, 1640), at(0, 0, 1680), 95},
          {at(150, 0, 1400), at(700, 50, 1400), 45}, {at(-150, 0, 1400), at(-700, -50, 1200), 45},
          {at(90, 0, 900), at(110, 30, 70), 65},     {at(-90, 0, 900), at(-150, -30, 70), 65}};
}

}  // namespace mocap
