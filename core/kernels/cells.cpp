#include "core/kernels/cells.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/kernels/cells.cpp"
#include "core/kernels/each_target.h"

HWY_BEFORE_NAMESPACE();
namespace mocap::kernels::HWY_NAMESPACE {
namespace {

void FindAll(const CellLine& line, int i, const BitPitch& pitch, LineCells& cells) {
  const auto [first_x, first_y, first_z] = line.first;
  const auto [dx, dy, dz] = line.step;
  // Positive numbers, because the conversion rounds towards zero.
  const double x = first_x - kFirstCell, y = first_y - kFirstCell, z = first_z - kFirstCell;
  for (int point = 0; point < kLinePoints; ++point) {
    const double steps = i + point;
    const int cell_x = static_cast<int>(x + steps * dx) + kFirstCell;
    const int cell_y = static_cast<int>(y + steps * dy) + kFirstCell;
    const int cell_z = static_cast<int>(z + steps * dz) + kFirstCell;
    cells.word[point] = cell_z * pitch.layer + cell_y * pitch.row + (cell_x >> 6);
    cells.bit[point] = cell_x & 63;
  }
}

}  // namespace
}  // namespace mocap::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mocap::kernels {

HWY_EXPORT(FindAll);
void FindCells(const CellLine& line, int i, const BitPitch& pitch, LineCells& cells) {
  HWY_DYNAMIC_DISPATCH(FindAll)(line, i, pitch, cells);
}

}  // namespace mocap::kernels
#endif  // HWY_ONCE
