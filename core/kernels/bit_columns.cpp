#include "core/kernels/bit_columns.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/kernels/bit_columns.cpp"
#include "core/kernels/each_target.h"

HWY_BEFORE_NAMESPACE();
namespace mocap::kernels::HWY_NAMESPACE {
namespace {

constexpr int kBits = 32;

void Widen(ColumnWord* bits, int count, std::ptrdiff_t stride, int step) {
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) bits[i] &= bits[i] >> step | bits[i + stride] << (kBits - step);
}

void Heighten(ColumnWord* bits, int columns, std::ptrdiff_t stride, int rows, int step) {
  for (int column = 0; column < columns; ++column, bits += stride) {
#pragma GCC ivdep
    for (int i = 0; i < rows - step; ++i) bits[i] &= bits[i + step];
  }
}

void Join(const ColumnWord* inside, const ColumnWord* outside, int rows, ColumnWord* left,
          ColumnWord* right) {
#pragma GCC ivdep
  for (int i = 0; i < rows; ++i) {
    left[i] = (inside[i] & 0xffff) | outside[i] << 16;
    right[i] = inside[i] >> 16 | (outside[i] & 0xffff0000);
  }
}

}  // namespace
}  // namespace mocap::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mocap::kernels {

HWY_EXPORT(Widen);
void WidenWindows(ColumnWord* bits, int count, std::ptrdiff_t stride, int step) {
  HWY_DYNAMIC_DISPATCH(Widen)(bits, count, stride, step);
}

HWY_EXPORT(Heighten);
void HeightenWindows(ColumnWord* bits, int columns, std::ptrdiff_t stride, int rows, int step) {
  HWY_DYNAMIC_DISPATCH(Heighten)(bits, columns, stride, rows, step);
}

HWY_EXPORT(Join);
void JoinInsideAndOutside(const ColumnWord* inside, const ColumnWord* outside, int rows,
                          ColumnWord* left, ColumnWord* right) {
  HWY_DYNAMIC_DISPATCH(Join)(inside, outside, rows, left, right);
}

}  // namespace mocap::kernels
#endif  // HWY_ONCE
