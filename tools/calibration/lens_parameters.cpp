#include "tools/calibration/lens_parameters.h"

#include <algorithm>
#include <span>

namespace mocap {
namespace {

std::vector<double> Parameters(const TsaiLens& lens) {
  return {lens.focal_mm, lens.kappa1, lens.center_px.x(), lens.center_px.y(), lens.sx};
}

// A board does not constrain k4 k5 k6 of a rational lens beside k1 k2 k3: they are fixed.
std::span<double> Refined(OpenCvLens& lens) { return std::span(lens.distortion).first(5); }
std::span<double> Refined(FisheyeLens& lens) { return lens.distortion; }

template <typename OpenCvOrFisheye>
std::vector<double> Parameters(OpenCvOrFisheye lens) {
  std::vector<double> p = {lens.K(0, 0), lens.K(1, 1), lens.K(0, 2), lens.K(1, 2)};
  const std::span<double> refined = Refined(lens);
  p.insert(p.end(), refined.begin(), refined.end());
  return p;
}

Lens With(TsaiLens lens, const double* p) {
  lens.focal_mm = p[0];
  lens.kappa1 = p[1];
  lens.center_px = {p[2], p[3]};
  lens.sx = p[4];
  return lens;
}

template <typename OpenCvOrFisheye>
Lens With(OpenCvOrFisheye lens, const double* p) {
  lens.K(0, 0) = p[0];
  lens.K(1, 1) = p[1];
  lens.K(0, 2) = p[2];
  lens.K(1, 2) = p[3];
  const std::span<double> refined = Refined(lens);
  std::copy_n(p + 4, refined.size(), refined.begin());
  return lens;
}

}  // namespace

std::vector<double> LensParameters(const Lens& lens) {
  return std::visit([](const auto& l) { return Parameters(l); }, lens);
}

Lens WithParameters(const Lens& lens, const double* parameters) {
  return std::visit([parameters](const auto& l) { return With(l, parameters); }, lens);
}

double FocalPx(const Lens& lens) {
  if (const auto* tsai = std::get_if<TsaiLens>(&lens))
    return tsai->focal_mm * (tsai->sx / tsai->pitch_mm.x() + 1 / tsai->pitch_mm.y()) / 2;
  const Matrix3& K = std::holds_alternative<OpenCvLens>(lens) ? std::get<OpenCvLens>(lens).K
                                                              : std::get<FisheyeLens>(lens).K;
  return (K(0, 0) + K(1, 1)) / 2;
}

Vector2 CenterPx(const Lens& lens) {
  if (const auto* tsai = std::get_if<TsaiLens>(&lens)) return tsai->center_px;
  const Matrix3& K = std::holds_alternative<OpenCvLens>(lens) ? std::get<OpenCvLens>(lens).K
                                                              : std::get<FisheyeLens>(lens).K;
  return {K(0, 2), K(1, 2)};
}

}  // namespace mocap
