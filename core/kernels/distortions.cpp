#include "core/kernels/distortions.h"

#include "core/kernels/prefetch.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/kernels/distortions.cpp"
#include "core/kernels/each_target.h"
#include "core/kernels/vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace mocap::kernels::HWY_NAMESPACE {
namespace {
constexpr int kPixels = WeighedPixels::kPixels;
using D = FloatsUpTo<kPixels>;
using V = hn::Vec<D>;
constexpr std::size_t kLanes = hn::MaxLanes(D());

// Splits the pixels of a group into channels.
using Channels = std::array<std::array<std::uint8_t, kPixels>, 3>;
HWY_INLINE void SplitPixels(const Bgr* pixels, Channels& to) {
  const hn::CappedTag<std::uint8_t, kPixels> d;
  for (std::size_t i = 0; i < kPixels; i += hn::Lanes(d)) {
    hn::Vec<decltype(d)> b, g, r;
    hn::LoadInterleaved3(d, &pixels[i].b, b, g, r);
    hn::Store(b, d, &to[0][i]);
    hn::Store(g, d, &to[1][i]);
    hn::Store(r, d, &to[2][i]);
  }
}

// Measures as many pixels as fit into a vector, from pixel `k` of a group on. The results begin
// with number `i`.
HWY_INLINE void MeasurePixels(const WeighedPixels& group, const Channels& live, std::size_t k,
                              const std::array<float, 3>& gain, const DistortionRows& to,
                              std::size_t i) {
  constexpr D d;
  V m[3], z[3], w[3], cd[3];
  for (int c = 0; c < 3; ++c) {
    w[c] =
        LoadAsFloats(d, &group.inverse_sigma[c][k]) * hn::Set(d, WeighedPixels::kInverseSigmaUnit);
    m[c] = LoadAsFloats(d, &group.mean[c][k]) * (hn::Set(d, WeighedPixels::kMeanUnit) * w[c]);
    z[c] = hn::Set(d, gain[c]) * LoadAsFloats(d, &live[c][k]) * w[c];
  }
  const V alpha =
      (z[0] * m[0] + z[1] * m[1] + z[2] * m[2]) / (m[0] * m[0] + m[1] * m[1] + m[2] * m[2]);
  for (int c = 0; c < 3; ++c) {
    cd[c] = z[c] - alpha * m[c];
    hn::StoreU(cd[c], d, to.cd[c] + i);
  }
  hn::StoreU(alpha - hn::Set(d, 1), d, to.alpha_shift + i);
  hn::StoreU(cd[0] * cd[0] + cd[1] * cd[1] + cd[2] * cd[2], d, to.cd_sq + i);
  hn::StoreU(LoadAsFloats(d, &group.alpha_weight[k]) * hn::Set(d, WeighedPixels::kAlphaWeightUnit),
             d, to.alpha_weight + i);
  hn::StoreU(w[1], d, to.inverse_sigma + i);
}

void MeasureGroups(const WeighedPixels* groups, int group_step, ImageView<const Bgr> band,
                   const std::array<float, 3>& gain, int ahead, const DistortionRows& to) {
  alignas(16) Channels live;
  for (int begin = 0; begin < band.width(); begin += kPixels, groups += group_step) {
    for (int row = 0; row < band.height(); ++row) {
      const WeighedPixels& group = groups[row];
      FetchBytes(&group + ahead, sizeof group);
      const int first = row * to.row_step + begin;
      FetchBytes(to.alpha_shift + first + ahead * to.row_step, sizeof(float) * kPixels);
      SplitPixels(band.row(row) + begin, live);
      for (std::size_t k = 0; k < kPixels; k += kLanes)
        MeasurePixels(group, live, k, gain, to, first + k);
    }
  }
}

}  // namespace
}  // namespace mocap::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mocap::kernels {
HWY_EXPORT(MeasureGroups);
void MeasureDistortions(const WeighedPixels* groups, int group_step, ImageView<const Bgr> band,
                        const std::array<float, 3>& gain, int ahead, const DistortionRows& to) {
  HWY_DYNAMIC_DISPATCH(MeasureGroups)(groups, group_step, band, gain, ahead, to);
}
}  // namespace mocap::kernels
#endif  // HWY_ONCE
