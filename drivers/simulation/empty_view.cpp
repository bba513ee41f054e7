#include "drivers/simulation/empty_view.h"

#include <algorithm>
#include <array>

#include "drivers/simulation/room_plan.h"

namespace mocap::simulation {
namespace {

using Vector3f = Eigen::Vector3f;

Bgr Rounded(const Vector3f& bgr) {
  const Vector3f v = (bgr.array() + 0.5f).max(0.0f).min(255.0f);
  return {static_cast<std::uint8_t>(v.x()), static_cast<std::uint8_t>(v.y()),
          static_cast<std::uint8_t>(v.z())};
}

FloorPlace PlaceOf(const Vector3f& p_W) {
  const float x = (p_W.x() + static_cast<float>(kRoomX_mm / 2)) * kFloorUnitsPerMm;
  const float y = (p_W.y() + static_cast<float>(kRoomY_mm / 2)) * kFloorUnitsPerMm;
  if (x < 0 || y < 0 || x >= kNoFloor || y >= kNoFloor) return {kNoFloor, 0};
  return {static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y)};
}

}  // namespace

// Sample (i, j) of the grid lies at pixel ((i - 0.5) / 2, (j - 0.5) / 2): two samples a pixel and
// axis, a quarter of a pixel beside its centre.
EmptyViewRenderer::EmptyViewRenderer(const CameraCalibration& camera)
    : width_px_(camera.width_px),
      height_px_(camera.height_px),
      directions_(2 * camera.width_px, 2 * camera.height_px, Eigen::Vector2f::Zero()) {
  for (int j = 0; j < directions_.height(); ++j)
    for (int i = 0; i < directions_.width(); ++i) {
      const Vector2 pixel((i - 0.5) / 2, (j - 0.5) / 2);
      // Tsai's lens maps every pixel.
      directions_(i, j) =
          NormalizedFromPixel(camera.lens, pixel).value_or(Vector2::Zero()).cast<float>();
    }
}

void EmptyViewRenderer::Render(const Room& room, const RigidTransform& X_CW, int samples,
                               EmptyView& view) const {
  if (view.image.width() != width_px_ || view.image.height() != height_px_) {
    view.image = Image<Bgr>(width_px_, height_px_);
    view.nearness = Image<float>(width_px_, height_px_);
    view.floor = Image<FloorPlace>(width_px_, height_px_);
  }
  const Eigen::Matrix3f R_WC = X_CW.R.transpose().cast<float>();
  const Vector3f p_WC = X_CW.Inverse().p.cast<float>();
  const auto ray_of = [&](float x, float y) -> Vector3f { return R_WC * Vector3f(x, y, 1); };
  for (int y = 0; y < height_px_; ++y)
    for (int x = 0; x < width_px_; ++x) {
      const std::array<Eigen::Vector2f, 4> d = {
          directions_(2 * x, 2 * y), directions_(2 * x + 1, 2 * y), directions_(2 * x, 2 * y + 1),
          directions_(2 * x + 1, 2 * y + 1)};
      // Along a ray with z_C = 1 the distance is the depth.
      const Vector3f ray = ray_of(0.25f * (d[0].x() + d[1].x() + d[2].x() + d[3].x()),
                                  0.25f * (d[0].y() + d[1].y() + d[2].y() + d[3].y()));
      const Room::Hit hit = room.Cast(p_WC, ray);
      view.nearness(x, y) = 1 / hit.distance;
      view.floor(x, y) =
          hit.on_floor ? PlaceOf(p_WC + hit.distance * ray) : FloorPlace{kNoFloor, 0};
      if (samples == 1) {
        view.image(x, y) = Rounded(hit.bgr);
        continue;
      }
      Vector3f sum = Vector3f::Zero();
      for (const Eigen::Vector2f& v : d) sum += room.Cast(p_WC, ray_of(v.x(), v.y())).bgr;
      view.image(x, y) = Rounded(sum / 4);
    }
}

}  // namespace mocap::simulation
