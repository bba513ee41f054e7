#include "drivers/virtual_studio/rendering/soft_shadows.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "drivers/virtual_studio/room/room_plan.h"

namespace mocap::simulation {
namespace {

using Eigen::Vector3f;

// As far beyond the walls as the shadow on a wall, continued to the floor's plane.
constexpr float kHalfPlane_mm = 8000, kPlaneCell_mm = 32;
constexpr int kPlaneCells = static_cast<int>(2 * kHalfPlane_mm / kPlaneCell_mm);
const FloorCells kPlane = {.corner_mm = {kHalfPlane_mm, kHalfPlane_mm},
                           .cell_mm = kPlaneCell_mm,
                           .columns = kPlaneCells,
                           .rows = kPlaneCells,
                           .from_x_W = float(kDoorX_mm)};
// A panel is as many places along each side, in the middles of equal parts.
constexpr int kPlacesAlong = 4, kPlaces = kPlacesAlong * kPlacesAlong;
constexpr float kPanelX_mm = 700, kPanelY_mm = 1200;

Vector3f PlaceOf(const Vector3f& lamp_W, int place) {
  const auto along = [](int i) { return (float(i) + 0.5f) / kPlacesAlong - 0.5f; };
  return lamp_W + Vector3f(kPanelX_mm * along(place % kPlacesAlong),
                           kPanelY_mm * along(place / kPlacesAlong), 0);
}

}  // namespace

SoftShadows::SoftShadows(const CameraCalibration& camera)
    : rays_C_(camera.width_px, camera.height_px, Vector3f::Zero()),
      points_W_(camera.width_px, camera.height_px, Vector3f::Zero()) {
  for (int y = 0; y < rays_C_.height(); ++y) {
    for (int x = 0; x < rays_C_.width(); ++x) {
      // Every pixel is within Tsai's model.
      const Vector2 ray = NormalizedFromPixel(camera.lens, Vector2(x, y)).value_or(Vector2::Zero());
      rays_C_(x, y) = Vector3(ray.x(), ray.y(), 1).cast<float>();
    }
  }
  for (LampShadow& lamp : lamps_) {
    lamp.hidden.from.assign(kPlaneCells * kPlaneCells, 0);
    lamp.shares.assign(kPlaneCells * kPlaneCells, 0);
  }
  Clear();
}

void SoftShadows::SetView(const EmptyView& view, const RigidTransform& X_CW) {
  const Eigen::Matrix3f R_WC = X_CW.R.transpose().cast<float>();
  const Vector3f p_WC = X_CW.Inverse().p.cast<float>();
  for (int y = 0; y < rays_C_.height(); ++y) {
    for (int x = 0; x < rays_C_.width(); ++x)
      points_W_(x, y) = p_WC + R_WC * rays_C_(x, y) / view.nearness(x, y);
  }
}

void SoftShadows::Clear() {
  for (LampShadow& lamp : lamps_) {
    auto& [from, x0, y0, x1, y1, projected] = lamp.hidden;
    for (int y = y0; y <= y1; ++y) {
      std::fill_n(&from[y * kPlaneCells + x0], x1 - x0 + 1, std::uint16_t{0});
      std::fill_n(&lamp.shares[y * kPlaneCells + x0], x1 - x0 + 1, 0.0f);
    }
    x0 = y0 = kPlaneCells, x1 = y1 = -1;
  }
}

void SoftShadows::Cast(const PersonMesh& mesh, const std::vector<Vector3f>& p_W) {
  for (int i = 0; i < kLampCount; ++i) {
    for (int place = 0; place < kPlaces; ++place)
      Hide(kPlane, PlaceOf(kLamps_W[i], place), static_cast<std::uint16_t>(1 << place), mesh, p_W,
           lamps_[i].hidden);
  }
}

// Means over three by three cells. The box grows by one, which stays within the plane.
void SoftShadows::MeasureShares(LampShadow& lamp) const {
  auto& [from, x0, y0, x1, y1, projected] = lamp.hidden;
  if (x1 < x0) return;
  x0 = std::max(1, x0 - 1), y0 = std::max(1, y0 - 1);
  x1 = std::min(kPlaneCells - 2, x1 + 1), y1 = std::min(kPlaneCells - 2, y1 + 1);
  for (int y = y0; y <= y1; ++y) {
    for (int x = x0; x <= x1; ++x) {
      int count = 0;
      for (int j = y - 1; j <= y + 1; ++j) {
        const std::uint16_t* const cell = &from[j * kPlaneCells + x];
        count += std::popcount(cell[-1]) + std::popcount(cell[0]) + std::popcount(cell[1]);
      }
      lamp.shares[y * kPlaneCells + x] = static_cast<float>(count) / (9 * kPlaces);
    }
  }
}

// 256 without shadow.
int SoftShadows::LightAt(const Vector3f& p_W) const {
  float hidden = 0;  // In lamps.
  for (int i = 0; i < kLampCount; ++i) {
    const LampShadow& lamp = lamps_[i];
    const Vector3f& lamp_W = kLamps_W[i];
    const float t = lamp_W.z() / (lamp_W.z() - p_W.z());
    const Eigen::Vector2f cell =
        (lamp_W.head<2>() + t * (p_W - lamp_W).head<2>() + kPlane.corner_mm) / kPlaneCell_mm -
        Eigen::Vector2f::Constant(0.5f);
    const int x = static_cast<int>(std::floor(cell.x())),
              y = static_cast<int>(std::floor(cell.y()));
    const HiddenCells& used = lamp.hidden;
    if (x < used.x0 || y < used.y0 || x >= used.x1 || y >= used.y1) continue;
    const float u = cell.x() - float(x), v = cell.y() - float(y);
    const float* const at = &lamp.shares[y * kPlaneCells + x];
    hidden += std::lerp(std::lerp(at[0], at[1], u),
                        std::lerp(at[kPlaneCells], at[kPlaneCells + 1], u), v);
  }
  const int whole = std::min(static_cast<int>(hidden), kLampCount - 1);
  return static_cast<int>(std::lround(
      std::lerp(float(kLightLeft[whole]), float(kLightLeft[whole + 1]), hidden - float(whole))));
}

PixelBox SoftShadows::Darken(Image<Bgr>& canvas) {
  for (LampShadow& lamp : lamps_) MeasureShares(lamp);
  PixelBox changed;
  for (int y = 0; y < canvas.height(); ++y) {
    for (int x = 0; x < canvas.width(); ++x) {
      const Vector3f& p_W = points_W_(x, y);
      // Beyond the door, the lamps' light does not come in a straight line.
      const int light = p_W.x() < float(kDoorX_mm) - 1 ? 256 : LightAt(p_W);
      if (light == 256) continue;
      Bgr& pixel = canvas(x, y);
      pixel = {static_cast<std::uint8_t>((pixel.b * light) >> 8),
               static_cast<std::uint8_t>((pixel.g * light) >> 8),
               static_cast<std::uint8_t>((pixel.r * light) >> 8)};
      changed.Include({x, y, x + 1, y + 1});
    }
  }
  return changed;
}

}  // namespace mocap::simulation
