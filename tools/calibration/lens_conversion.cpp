#include "tools/calibration/lens_conversion.h"

#include <fmt/format.h>

#include <cmath>

#include "core/calibration/levenberg_marquardt.h"
#include "core/errors.h"
#include "tools/calibration/lens_parameters.h"

namespace mocap {
namespace {

constexpr double kWorst_px = 0.25;
// Slightly below tan of 85 degrees, the limit of lenses that do not fold.
constexpr double kWidestField = 11.4;
constexpr int kColumns = 16, kRows = 12;

/// Directions over the whole picture, and their pixels.
struct Samples {
  std::vector<Vector2> normalized, pixels;
};

Samples SamplePicture(const CameraCalibration& camera) {
  Samples samples;
  for (int j = 0; j <= kRows; ++j) {
    for (int i = 0; i <= kColumns; ++i) {
      const Vector2 pixel((camera.width_px - 1.0) * i / kColumns,
                          (camera.height_px - 1.0) * j / kRows);
      const auto n = NormalizedFromPixel(camera.lens, pixel);
      if (!n) continue;
      samples.normalized.push_back(*n);
      samples.pixels.push_back(pixel);
    }
  }
  return samples;
}

template <typename SomeLens>
SomeLens FitLensTo(const std::string& name, const Samples& samples, const SomeLens& start,
                   const char* model) {
  if (samples.pixels.empty())
    throw SetupError(fmt::format("{}: its lens shows nothing in its picture", name));
  const std::vector<double> first = LensParameters(start);
  const Eigen::VectorXd x =
      Eigen::Map<const Eigen::VectorXd>(first.data(), static_cast<Eigen::Index>(first.size()));
  const auto residuals = [&](const Eigen::VectorXd& p) {
    const Lens lens = WithParameters(start, p.data());
    Eigen::VectorXd r(2 * static_cast<Eigen::Index>(samples.pixels.size()));
    for (std::size_t i = 0; i < samples.pixels.size(); ++i) {
      const auto pixel = PixelFromNormalized(lens, samples.normalized[i]);
      r.segment<2>(2 * static_cast<Eigen::Index>(i)) =
          pixel ? Vector2(*pixel - samples.pixels[i]) : Vector2::Constant(1e3).eval();
    }
    return r;
  };
  const LeastSquaresResult result = MinimizeSquares(residuals, x, x.cwiseAbs().cwiseMax(0.1));
  const double rms_px =
      std::sqrt(result.cost / std::max<double>(1, static_cast<double>(samples.pixels.size())));
  if (!(rms_px < kWorst_px))
    throw SetupError(fmt::format(
        "{}: no {} lens maps like its own ({:.2f} px apart); expected a format with its lens model",
        name, model, rms_px));
  return std::get<SomeLens>(WithParameters(start, result.x.data()));
}

}  // namespace

OpenCvLens AsOpenCvLens(const CameraCalibration& camera) {
  if (const auto* same = std::get_if<OpenCvLens>(&camera.lens)) return *same;
  OpenCvLens start;
  const Vector2 center = CenterPx(camera.lens);
  start.K << FocalPx(camera.lens), 0, center.x(), 0, FocalPx(camera.lens), center.y(), 0, 0, 1;
  return FitLensTo(camera.name, SamplePicture(camera), start, "OpenCV");
}

OpenCvLens AsFiveCoefficients(const CameraCalibration& camera, const std::string& format) {
  const OpenCvLens lens = AsOpenCvLens(camera);
  if (lens.IsRational())
    throw SetupError(camera.name + ": its lens has OpenCV's eight coefficients, k4 to k6 among " +
                     "them; " + format +
                     " supports five: use mocap, pose2sim, opencv or easymocap");
  return lens;
}

double HiddenShare(const CameraCalibration& camera) {
  return 1 -
         static_cast<double>(SamplePicture(camera).pixels.size()) / ((kColumns + 1) * (kRows + 1));
}

double FoldedShare(const CameraCalibration& camera) {
  return FieldRadius(camera.lens) < kWidestField ? HiddenShare(camera) : 0;
}

double LensDifferencePx(const CameraCalibration& a, const Lens& b) {
  const Samples samples = SamplePicture(a);
  double sum = 0;
  for (std::size_t i = 0; i < samples.pixels.size(); ++i) {
    const auto pixel = PixelFromNormalized(b, samples.normalized[i]);
    sum += pixel ? (*pixel - samples.pixels[i]).squaredNorm() : 1e6;
  }
  return std::sqrt(sum / std::max<double>(1, static_cast<double>(samples.pixels.size())));
}

OpenCvLens FitOpenCvLens(const std::string& name, const OpenCvLens& start,
                         const std::vector<Vector2>& normalized,
                         const std::vector<Vector2>& pixels) {
  return FitLensTo(name, Samples{normalized, pixels}, start, "OpenCV");
}

TsaiLens AsTsaiLens(const CameraCalibration& camera) {
  if (const auto* same = std::get_if<TsaiLens>(&camera.lens)) return *same;
  TsaiLens start;
  start.pitch_mm = {0.01, 0.01};
  start.focal_mm = FocalPx(camera.lens) * 0.01;
  start.center_px = CenterPx(camera.lens);
  return FitLensTo(camera.name, SamplePicture(camera), start, "Tsai");
}

}  // namespace mocap
