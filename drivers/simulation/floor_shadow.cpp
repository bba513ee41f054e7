#include "drivers/simulation/floor_shadow.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "drivers/simulation/room_plan.h"

namespace mocap::simulation {
namespace {

constexpr float kCell_mm = 25;
constexpr int kColumns = static_cast<int>(kRoomX_mm / kCell_mm) + 1;
constexpr int kRows = static_cast<int>(kRoomY_mm / kCell_mm) + 1;
constexpr int kBlurCells = 2;
// The lamps' share of the light; the rest comes from everywhere.
constexpr std::array<float, 4> kLightLost = {0, 0.14f, 0.27f, 0.38f};
const std::array<Eigen::Vector3f, 3> kLamps_W = {Eigen::Vector3f(-1500, -1300, 3700),
                                                 Eigen::Vector3f(1600, -700, 3700),
                                                 Eigen::Vector3f(-200, 1500, 3700)};

}  // namespace

FloorShadow::FloorShadow()
    : lamps_hidden_(kColumns * kRows, 0), light_(kColumns * kRows, 1), scratch_(kColumns * kRows) {}

Eigen::Vector2f FloorShadow::low_W() const {
  return Eigen::Vector2f(float(x0_), float(y0_)) * kCell_mm -
         Eigen::Vector2f(float(kRoomX_mm), float(kRoomY_mm)) / 2;
}

Eigen::Vector2f FloorShadow::high_W() const {
  return Eigen::Vector2f(float(x1_ + 1), float(y1_ + 1)) * kCell_mm -
         Eigen::Vector2f(float(kRoomX_mm), float(kRoomY_mm)) / 2;
}

void FloorShadow::Cast(const PersonMesh& mesh, const std::vector<Eigen::Vector3f>& p_W) {
  for (int y = y0_; y <= y1_; ++y) {
    std::fill_n(&lamps_hidden_[y * kColumns + x0_], x1_ - x0_ + 1, 0);
    std::fill_n(&light_[y * kColumns + x0_], x1_ - x0_ + 1, 1.0f);
  }
  x0_ = kColumns, y0_ = kRows, x1_ = y1_ = -1;
  for (std::size_t i = 0; i < kLamps_W.size(); ++i)
    CastFrom(kLamps_W[i], static_cast<std::uint8_t>(1 << i), mesh, p_W);
  empty_ = x1_ < x0_;
  if (empty_) return;
  x0_ = std::max(0, x0_ - 2 * kBlurCells);
  y0_ = std::max(0, y0_ - 2 * kBlurCells);
  x1_ = std::min(kColumns - 1, x1_ + 2 * kBlurCells);
  y1_ = std::min(kRows - 1, y1_ + 2 * kBlurCells);
  Blur();
}

void FloorShadow::CastFrom(const Eigen::Vector3f& lamp_W, std::uint8_t bit, const PersonMesh& mesh,
                           const std::vector<Eigen::Vector3f>& p_W) {
  const Eigen::Vector2f corner(float(kRoomX_mm / 2), float(kRoomY_mm / 2));
  projected_.resize(p_W.size());
  for (std::size_t i = 0; i < p_W.size(); ++i) {
    const float t = lamp_W.z() / (lamp_W.z() - std::min(p_W[i].z(), lamp_W.z() - 300));
    projected_[i] =
        (lamp_W.head<2>() + t * (p_W[i].head<2>() - lamp_W.head<2>()) + corner) / kCell_mm;
  }
  for (const auto& triangle : mesh.coarse) {
    const Eigen::Vector2f a = projected_[triangle[0]], b = projected_[triangle[1]],
                          c = projected_[triangle[2]];
    // Either half of the closed surface casts the same shadow.
    const float area = (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
    if (area <= 0) continue;
    const int low_x = std::max(0, static_cast<int>(std::min({a.x(), b.x(), c.x()})));
    const int low_y = std::max(0, static_cast<int>(std::min({a.y(), b.y(), c.y()})));
    const int high_x = std::min(kColumns - 1, static_cast<int>(std::max({a.x(), b.x(), c.x()})));
    const int high_y = std::min(kRows - 1, static_cast<int>(std::max({a.y(), b.y(), c.y()})));
    if (low_x > high_x || low_y > high_y) continue;
    const auto side = [](const Eigen::Vector2f& p, const Eigen::Vector2f& q, float x, float y) {
      return (q.x() - p.x()) * (y - p.y()) - (q.y() - p.y()) * (x - p.x());
    };
    bool any = false;
    for (int y = low_y; y <= high_y; ++y)
      for (int x = low_x; x <= high_x; ++x) {
        const float mx = float(x) + 0.5f, my = float(y) + 0.5f;
        if (side(a, b, mx, my) < 0 || side(b, c, mx, my) < 0 || side(c, a, mx, my) < 0) continue;
        lamps_hidden_[y * kColumns + x] |= bit;
        any = true;
      }
    if (!any) continue;
    x0_ = std::min(x0_, low_x), y0_ = std::min(y0_, low_y);
    x1_ = std::max(x1_, high_x), y1_ = std::max(y1_, high_y);
  }
}

// Twice a running mean in each direction: the lamps are panels, not points.
void FloorShadow::Blur() {
  for (int y = y0_; y <= y1_; ++y)
    for (int x = x0_; x <= x1_; ++x)
      light_[y * kColumns + x] = 1 - kLightLost[std::popcount(lamps_hidden_[y * kColumns + x])];
  const auto pass = [this](const std::vector<float>& from, std::vector<float>& to, int dx, int dy) {
    for (int y = y0_; y <= y1_; ++y)
      for (int x = x0_; x <= x1_; ++x) {
        float sum = 0;
        for (int k = -kBlurCells; k <= kBlurCells; ++k)
          sum +=
              from[std::clamp(y + k * dy, y0_, y1_) * kColumns + std::clamp(x + k * dx, x0_, x1_)];
        to[y * kColumns + x] = sum / (2 * kBlurCells + 1);
      }
  };
  for (int i = 0; i < 2; ++i) {
    pass(light_, scratch_, 1, 0);
    pass(scratch_, light_, 0, 1);
  }
}

float FloorShadow::LightAt(FloorPlace place) const {
  constexpr float kScale = 1 / (kFloorUnitsPerMm * kCell_mm);
  const float fx = float(place.x) * kScale - 0.5f, fy = float(place.y) * kScale - 0.5f;
  const int x = std::clamp(static_cast<int>(fx), 0, kColumns - 2);
  const int y = std::clamp(static_cast<int>(fy), 0, kRows - 2);
  const float u = fx - float(x), v = fy - float(y);
  const float* row = &light_[y * kColumns + x];
  const float top = row[0] + u * (row[1] - row[0]);
  const float bottom = row[kColumns] + u * (row[kColumns + 1] - row[kColumns]);
  return top + v * (bottom - top);
}

}  // namespace mocap::simulation
