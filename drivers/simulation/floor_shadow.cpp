#include "drivers/simulation/floor_shadow.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "drivers/simulation/light_rows.h"
#include "drivers/simulation/room_plan.h"

namespace mocap::simulation {
namespace {

// A cell is 256 units of FloorPlace, so cell number and place within it take a byte each.
constexpr float kCell_mm = 256 / kFloorUnitsPerMm;
constexpr int kCellColumns = static_cast<int>(kRoomX_mm / kCell_mm) + 1;
constexpr int kCellRows = static_cast<int>(kRoomY_mm / kCell_mm) + 1;
static_assert(kCellColumns < kNoFloor / 256, "what shows no floor lies beside all cells");
// Averages three cells.
constexpr int kBlurCells = 1;
// Remaining light by number of hidden lamps; full light is 256. Ambient light remains.
constexpr std::array<std::uint16_t, 4> kLightLeft = {256, 220, 187, 159};
const std::array<Eigen::Vector3f, 3> kLamps_W = {Eigen::Vector3f(-1500, -1300, 3700),
                                                 Eigen::Vector3f(1600, -700, 3700),
                                                 Eigen::Vector3f(-200, 1500, 3700)};

}  // namespace

FloorShadow::FloorShadow()
    : lamps_hidden_(kCellColumns * kCellRows, 0),
      light_(kCellColumns * kCellRows, kLightLeft[0]),
      scratch_(kCellColumns * kCellRows),
      line_(kCellColumns + 2),
      columns_(kCellColumns) {}

bool FloorShadow::Bounds(Eigen::Vector2f& low_W, Eigen::Vector2f& high_W) const {
  const Eigen::Vector2f corner(float(kRoomX_mm / 2), float(kRoomY_mm / 2));
  low_W = Eigen::Vector2f(float(x0_), float(y0_)) * kCell_mm - corner;
  high_W = Eigen::Vector2f(float(x1_ + 1), float(y1_ + 1)) * kCell_mm - corner;
  return x0_ <= x1_ && y0_ <= y1_;
}

bool FloorShadow::MayFallOn(std::span<const FloorPlace> places) const {
  // As in LightAt().
  const auto from = [](int cell) { return static_cast<std::uint16_t>((cell << 8) + 128); };
  const auto over = [](int cells) { return static_cast<std::uint16_t>(cells << 8); };
  return CountWithin(places.data(), places.size(), {from(x0_), from(y0_)},
                     {over(x1_ - x0_), over(y1_ - y0_)}) > 0;
}

void FloorShadow::Clear() {
  for (int y = y0_; y <= y1_; ++y) {
    std::fill_n(&lamps_hidden_[y * kCellColumns + x0_], x1_ - x0_ + 1, 0);
    std::fill_n(&light_[y * kCellColumns + x0_], x1_ - x0_ + 1, kLightLeft[0]);
  }
  x0_ = kCellColumns, y0_ = kCellRows, x1_ = y1_ = -1;
}

void FloorShadow::Cast(const PersonMesh& mesh, const std::vector<Eigen::Vector3f>& p_W) {
  for (std::size_t i = 0; i < kLamps_W.size(); ++i)
    CastFrom(kLamps_W[i], static_cast<std::uint8_t>(1 << i), mesh, p_W);
}

void FloorShadow::CastFrom(const Eigen::Vector3f& lamp_W, std::uint8_t bit, const PersonMesh& mesh,
                           const std::vector<Eigen::Vector3f>& p_W) {
  const Eigen::Vector2f corner(float(kRoomX_mm / 2), float(kRoomY_mm / 2));
  projected_.resize(mesh.coarse_vertices.size());
  for (std::size_t i = 0; i < mesh.coarse_vertices.size(); ++i) {
    const Eigen::Vector3f& p = p_W[mesh.coarse_vertices[i]];
    const float t = lamp_W.z() / (lamp_W.z() - std::min(p.z(), lamp_W.z() - 300));
    projected_[i] = (lamp_W.head<2>() + t * (p.head<2>() - lamp_W.head<2>()) + corner) / kCell_mm;
  }
  for (const auto& triangle : mesh.coarse_triangles) {
    const Eigen::Vector2f a = projected_[triangle[0]], b = projected_[triangle[1]],
                          c = projected_[triangle[2]];
    // Either half of the closed surface casts the same shadow.
    const float area = (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
    if (area <= 0) continue;
    const int low_x = std::max(0, static_cast<int>(std::min({a.x(), b.x(), c.x()})));
    const int low_y = std::max(0, static_cast<int>(std::min({a.y(), b.y(), c.y()})));
    const int high_x =
        std::min(kCellColumns - 1, static_cast<int>(std::max({a.x(), b.x(), c.x()})));
    const int high_y = std::min(kCellRows - 1, static_cast<int>(std::max({a.y(), b.y(), c.y()})));
    if (low_x > high_x || low_y > high_y) continue;
    // Twice the areas opposite the corners, linear in x.
    const auto side = [](const Eigen::Vector2f& p, const Eigen::Vector2f& q, float x, float y) {
      return (q.x() - p.x()) * (y - p.y()) - (q.y() - p.y()) * (x - p.x());
    };
    const float step_a = b.y() - c.y(), step_b = c.y() - a.y(), step_c = a.y() - b.y();
    bool any = false;
    for (int y = low_y; y <= high_y; ++y) {
      const float mx = float(low_x) + 0.5f, my = float(y) + 0.5f;
      float at_a = side(b, c, mx, my), at_b = side(c, a, mx, my), at_c = side(a, b, mx, my);
      std::uint8_t* hidden = &lamps_hidden_[y * kCellColumns];
      for (int x = low_x; x <= high_x; ++x, at_a += step_a, at_b += step_b, at_c += step_c) {
        if (std::min({at_a, at_b, at_c}) < 0) continue;
        hidden[x] |= bit;
        any = true;
      }
    }
    if (!any) continue;
    x0_ = std::min(x0_, low_x), y0_ = std::min(y0_, low_y);
    x1_ = std::max(x1_, high_x), y1_ = std::max(y1_, high_y);
  }
}

// Two running means in each direction: the lamps are panels, not points.
void FloorShadow::Blur() {
  if (x1_ < x0_) return;
  x0_ = std::max(0, x0_ - 2 * kBlurCells);
  y0_ = std::max(0, y0_ - 2 * kBlurCells);
  x1_ = std::min(kCellColumns - 1, x1_ + 2 * kBlurCells);
  y1_ = std::min(kCellRows - 1, y1_ + 2 * kBlurCells);
  for (int y = y0_; y <= y1_; ++y)
    for (int x = x0_; x <= x1_; ++x)
      light_[y * kCellColumns + x] = kLightLeft[std::popcount(lamps_hidden_[y * kCellColumns + x])];
  const int count = x1_ - x0_ + 1;
  const auto cell = [this](int y) { return y * kCellColumns + x0_; };
  for (int i = 0; i < 2; ++i) {
    for (int y = y0_; y <= y1_; ++y) {
      const std::uint16_t* const row = &light_[cell(y)];
      std::copy_n(row, count, &line_[1]);
      line_[0] = row[0], line_[count + 1] = row[count - 1];
      AverageThree(&line_[0], &line_[1], &line_[2], count, &scratch_[cell(y)]);
    }
    for (int y = y0_; y <= y1_; ++y)
      AverageThree(&scratch_[cell(std::max(y - 1, y0_))], &scratch_[cell(y)],
                   &scratch_[cell(std::min(y + 1, y1_))], count, &light_[cell(y)]);
  }
}

}  // namespace mocap::simulation
