#include "drivers/virtual_studio/rendering/floor_shadow.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "drivers/virtual_studio/rendering/light_rows.h"
#include "drivers/virtual_studio/room/room_plan.h"

namespace mocap::simulation {
namespace {

// A cell is 256 units of FloorPlace, so cell number and place within it take a byte each.
constexpr float kCell_mm = 256 / kFloorUnitsPerMm;
constexpr int kCellColumns = static_cast<int>(kRoomX_mm / kCell_mm) + 1;
constexpr int kCellRows = static_cast<int>(kRoomY_mm / kCell_mm) + 1;
static_assert(kCellColumns < kNoFloor / 256, "what shows no floor lies beside all cells");
// Averages three cells.
constexpr int kBlurCells = 1;
const FloorCells kFloor = {.corner_mm = {float(kRoomX_mm / 2), float(kRoomY_mm / 2)},
                           .cell_mm = kCell_mm,
                           .columns = kCellColumns,
                           .rows = kCellRows};

}  // namespace

FloorShadow::FloorShadow()
    : hidden_{.from = std::vector<std::uint16_t>(kCellColumns * kCellRows, 0)},
      light_(kCellColumns * kCellRows, kLightLeft[0]),
      scratch_(kCellColumns * kCellRows),
      line_(kCellColumns + 2),
      columns_(kCellColumns) {
  Clear();
}

bool FloorShadow::Bounds(Eigen::Vector2f& low_W, Eigen::Vector2f& high_W) const {
  const auto& [from, x0, y0, x1, y1, projected] = hidden_;
  low_W = Eigen::Vector2f(float(x0), float(y0)) * kCell_mm - kFloor.corner_mm;
  high_W = Eigen::Vector2f(float(x1 + 1), float(y1 + 1)) * kCell_mm - kFloor.corner_mm;
  return x0 <= x1 && y0 <= y1;
}

bool FloorShadow::MayFallOn(std::span<const FloorPlace> places) const {
  // As in LightAt().
  const auto from = [](int cell) { return static_cast<std::uint16_t>((cell << 8) + 128); };
  const auto over = [](int cells) { return static_cast<std::uint16_t>(cells << 8); };
  return CountWithin(places.data(), places.size(), {from(hidden_.x0), from(hidden_.y0)},
                     {over(hidden_.x1 - hidden_.x0), over(hidden_.y1 - hidden_.y0)}) > 0;
}

void FloorShadow::Clear() {
  auto& [from, x0, y0, x1, y1, projected] = hidden_;
  for (int y = y0; y <= y1; ++y) {
    std::fill_n(&from[y * kCellColumns + x0], x1 - x0 + 1, std::uint16_t{0});
    std::fill_n(&light_[y * kCellColumns + x0], x1 - x0 + 1, kLightLeft[0]);
  }
  x0 = kCellColumns, y0 = kCellRows, x1 = y1 = -1;
}

void FloorShadow::Cast(const PersonMesh& mesh, const std::vector<Eigen::Vector3f>& p_W) {
  for (int i = 0; i < kLampCount; ++i)
    Hide(kFloor, kLamps_W[i], static_cast<std::uint16_t>(1 << i), mesh, p_W, hidden_);
}

// Two running means in each direction: the lamps are panels, not points.
void FloorShadow::Blur() {
  auto& [from, x0, y0, x1, y1, projected] = hidden_;
  if (x1 < x0) return;
  x0 = std::max(0, x0 - 2 * kBlurCells);
  y0 = std::max(0, y0 - 2 * kBlurCells);
  x1 = std::min(kCellColumns - 1, x1 + 2 * kBlurCells);
  y1 = std::min(kCellRows - 1, y1 + 2 * kBlurCells);
  for (int y = y0; y <= y1; ++y)
    for (int x = x0; x <= x1; ++x)
      light_[y * kCellColumns + x] = kLightLeft[std::popcount(from[y * kCellColumns + x])];
  const int count = x1 - x0 + 1;
  const auto cell = [left = x0](int y) { return y * kCellColumns + left; };
  for (int i = 0; i < 2; ++i) {
    for (int y = y0; y <= y1; ++y) {
      const std::uint16_t* const row = &light_[cell(y)];
      std::copy_n(row, count, &line_[1]);
      line_[0] = row[0], line_[count + 1] = row[count - 1];
      AverageThree(&line_[0], &line_[1], &line_[2], count, &scratch_[cell(y)]);
    }
    for (int y = y0; y <= y1; ++y)
      AverageThree(&scratch_[cell(std::max(y - 1, y0))], &scratch_[cell(y)],
                   &scratch_[cell(std::min(y + 1, y1))], count, &light_[cell(y)]);
  }
}

}  // namespace mocap::simulation
