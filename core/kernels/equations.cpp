#include "core/kernels/equations.h"

#include <tuple>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/kernels/equations.cpp"
#include "core/kernels/each_target.h"
#include "core/kernels/vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace mocap::kernels::HWY_NAMESPACE {
namespace {

void AddTerms(const WrenchTerm* terms, std::size_t count, WrenchSum* sums) {
  constexpr hn::CappedTag<double, std::tuple_size_v<WrenchRow>> d;
  for (std::size_t term = 0; term < count; ++term) {
    const WrenchRow& row = terms[term].row;
    const auto variance = hn::Set(d, terms[term].variance);
    WrenchRow weighted;
    for (std::size_t k = 0; k < row.size(); k += hn::MaxLanes(d))
      hn::StoreU(hn::LoadU(d, &row[k]) / variance, d, &weighted[k]);
    WrenchSum& sum = sums[terms[term].part];
    for (std::size_t i = 0; i < sum.size(); ++i) {
      const auto weight = hn::Set(d, weighted[i]);
      for (std::size_t k = 0; k < row.size(); k += hn::MaxLanes(d))
        hn::StoreU(hn::LoadU(d, &sum[i][k]) + weight * hn::LoadU(d, &row[k]), d, &sum[i][k]);
    }
  }
}

void AddAbove(const double* row, int count, double weight, std::ptrdiff_t stride, double* columns) {
  for (int j = 0; j < count; ++j) {
    if (row[j] == 0) continue;
    const double factor = weight * row[j];
    double* const column = columns + j * stride;
    for (int begin = 0; begin <= j; begin += kColumnStep) {
#pragma GCC ivdep
      for (int i = begin; i < begin + kColumnStep; ++i) column[i] += factor * row[i];
    }
  }
}

void AddBelow(const double* row, std::ptrdiff_t count, double weight, double* columns) {
  for (std::ptrdiff_t j = 0; j < count; ++j) {
    if (row[j] == 0) continue;
    const double factor = weight * row[j];
    double* const column = columns + j * count;
#pragma GCC ivdep
    for (std::ptrdiff_t i = j; i < count; ++i) column[i] += factor * row[i];
  }
}

}  // namespace
}  // namespace mocap::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mocap::kernels {

HWY_EXPORT(AddTerms);
void AddWrenches(const WrenchTerm* terms, std::size_t count, WrenchSum* sums) {
  HWY_DYNAMIC_DISPATCH(AddTerms)(terms, count, sums);
}

HWY_EXPORT(AddAbove);
void AddSquareAbove(const double* row, int count, double weight, std::ptrdiff_t stride,
                    double* columns) {
  HWY_DYNAMIC_DISPATCH(AddAbove)(row, count, weight, stride, columns);
}

HWY_EXPORT(AddBelow);
void AddSquareBelow(const double* row, std::ptrdiff_t count, double weight, double* columns) {
  HWY_DYNAMIC_DISPATCH(AddBelow)(row, count, weight, columns);
}

}  // namespace mocap::kernels
#endif  // HWY_ONCE
