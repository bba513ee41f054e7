#include "core/kernels/bit_columns.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/kernels/bit_columns.cpp"
#include "core/kernels/each_target.h"

HWY_BEFORE_NAMESPACE();
namespace mocap::kernels::HWY_NAMESPACE {
namespace {

constexpr int kBits = 32;

void DilateAlong(const ColumnWord* from, int count, std::ptrdiff_t stride, int step,
                 ColumnWord* to) {
#pragma GCC ivdep
  for (int i = 0; i < count; ++i)
    to[i] = from[i] | from[i] << step | from[i - stride] >> (kBits - step) | from[i] >> step |
            from[i + stride] << (kBits - step);
}

void ErodeAlong(const ColumnWord* from, int count, std::ptrdiff_t stride, int step,
                ColumnWord* to) {
#pragma GCC ivdep
  for (int i = 0; i < count; ++i)
    to[i] = from[i] & (from[i] << step | from[i - stride] >> (kBits - step)) &
            (from[i] >> step | from[i + stride] << (kBits - step));
}

void DilateAcross(const ColumnWord* from, int count, int step, ColumnWord* to) {
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) to[i] = from[i] | from[i - step] | from[i + step];
}

void ErodeAcross(const ColumnWord* from, int count, int step, ColumnWord* to) {
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) to[i] = from[i] & from[i - step] & from[i + step];
}

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

HWY_EXPORT(DilateAlong);
void DilateSideways(const ColumnWord* from, int count, std::ptrdiff_t stride, int step,
                    ColumnWord* to) {
  HWY_DYNAMIC_DISPATCH(DilateAlong)(from, count, stride, step, to);
}

HWY_EXPORT(ErodeAlong);
void ErodeSideways(const ColumnWord* from, int count, std::ptrdiff_t stride, int step,
                   ColumnWord* to) {
  HWY_DYNAMIC_DISPATCH(ErodeAlong)(from, count, stride, step, to);
}

HWY_EXPORT(DilateAcross);
void DilateUpAndDown(const ColumnWord* from, int count, int step, ColumnWord* to) {
  HWY_DYNAMIC_DISPATCH(DilateAcross)(from, count, step, to);
}

HWY_EXPORT(ErodeAcross);
void ErodeUpAndDown(const ColumnWord* from, int count, int step, ColumnWord* to) {
  HWY_DYNAMIC_DISPATCH(ErodeAcross)(from, count, step, to);
}

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
