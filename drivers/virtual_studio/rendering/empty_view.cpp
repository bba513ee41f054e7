#include "drivers/virtual_studio/rendering/empty_view.h"

#include <algorithm>
#include <vector>

#include "drivers/virtual_studio/room/room_plan.h"

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

EmptyViewRenderer::EmptyViewRenderer(const CameraCalibration& camera)
    : width_px_(camera.width_px),
      height_px_(camera.height_px),
      centers_(camera.width_px, camera.height_px, Vector3f::Zero()),
      corners_(camera.width_px + 1, camera.height_px + 1, Vector3f::Zero()) {
  const auto fill = [&camera](Image<Vector3f>& directions, double offset) {
    for (int y = 0; y < directions.height(); ++y)
      for (int x = 0; x < directions.width(); ++x) {
        // Every pixel is within Tsai's model.
        const Vector2 d = NormalizedFromPixel(camera.lens, Vector2(x + offset, y + offset))
                              .value_or(Vector2::Zero());
        directions(x, y) = Vector3(d.x(), d.y(), 1).cast<float>();
      }
  };
  fill(centers_, 0);
  fill(corners_, -0.5);
}

void EmptyViewRenderer::Render(const Room& room, const RigidTransform& X_CW,
                               EmptyView& view) const {
  if (view.image.width() != width_px_ || view.image.height() != height_px_) {
    view.image = Image<Bgr>(width_px_, height_px_);
    view.nearness = Image<float>(width_px_, height_px_);
    view.floor = Image<FloorPlace>(width_px_, height_px_);
  }
  const Eigen::Matrix3f R_WC = X_CW.R.transpose().cast<float>();
  const Vector3f p_WC = X_CW.Inverse().p.cast<float>();
  const auto corner_row = [&](int y, std::vector<Vector3f>& colors) {
    for (int x = 0; x <= width_px_; ++x) colors[x] = room.Cast(p_WC, R_WC * corners_(x, y)).bgr;
  };
  std::vector<Vector3f> above(width_px_ + 1), below(width_px_ + 1);
  corner_row(0, below);
  for (int y = 0; y < height_px_; ++y) {
    above.swap(below);
    corner_row(y + 1, below);
    for (int x = 0; x < width_px_; ++x) {
      // Along a ray with z_C = 1 the distance is the depth.
      const Vector3f ray = R_WC * centers_(x, y);
      const Room::Hit hit = room.Cast(p_WC, ray);
      view.nearness(x, y) = 1 / hit.distance;
      view.floor(x, y) =
          hit.on_floor ? PlaceOf(p_WC + hit.distance * ray) : FloorPlace{kNoFloor, 0};
      // The centre counts half; the corners, shared with neighbours, count the rest.
      view.image(x, y) =
          Rounded(0.5f * hit.bgr + 0.125f * (above[x] + above[x + 1] + below[x] + below[x + 1]));
    }
  }
}

}  // namespace mocap::simulation
