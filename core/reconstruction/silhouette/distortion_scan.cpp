#include "core/reconstruction/silhouette/distortion_scan.h"

#include <algorithm>
#include <utility>

#include "core/errors.h"
#include "core/kernels/distortions.h"
#include "core/kernels/prefetch.h"
#include "core/kernels/windows.h"

namespace mocap {
namespace {

constexpr int kPixels = WeighedPixels::kPixels;
using kernels::kBlock_px;
using kernels::kSumLines;

}  // namespace

void DistortionScan::Begin(const ExpectedPicture& expected, ImageView<const Bgr> image,
                           const std::array<float, 3>& gain, const RegionOfInterest& roi) {
  MOCAP_CHECK(image.width() == expected.width && image.height() == expected.height);
  MOCAP_CHECK(roi.width() == expected.width && roi.height() == expected.height);
  expected_ = &expected;
  roi_ = &roi;
  image_ = image;
  gain_ = gain;
  next_ = measured_ = 0;
  const int width = expected.width + kBeside;
  if (alpha_shift_.width() == width && alpha_shift_.height() == expected.height) return;
  alpha_shift_ = Image<float>(width, expected.height);
  for (auto* lines : {&lines_.cd_sq, &lines_.alpha_weight, &lines_.inverse_sigma, &lines_.cd[0],
                      &lines_.cd[1], &lines_.cd[2]})
    *lines = Image<float>(width, kSumLines);
  last_ = Image<Bgr>(kPixels, kBand_px);
  sums_.resize(static_cast<std::size_t>(width / kBlock_px * kSumLines));
}

const DistortionScan::RowPair& DistortionScan::Next() {
  const int y = std::exchange(next_, next_ + 2);
  const int last = expected_->height - 1;
  MOCAP_CHECK(y <= last);
  for (; measured_ <= std::min(y + 1 + kernels::kLargestRadius_px, last); measured_ += kBand_px)
    MeasureBand(measured_);
  for (int row = 0; row < 2; ++row) {
    const int v = std::min(y + row, last), line = v % kSumLines;
    pair_.rows[row] = {alpha_shift_.row(v) + kPad, lines_.cd_sq.row(line) + kPad,
                       lines_.alpha_weight.row(line) + kPad, lines_.inverse_sigma.row(line) + kPad};
  }
  for (int i = 0; i < kernels::kPairLines; ++i)
    pair_.sums[i] = &sums_[std::clamp(y + i - kernels::kLargestRadius_px, 0, last) % kSumLines];
  return pair_;
}

void DistortionScan::MeasureBand(int y) {
  const int rows = std::min(kBand_px, expected_->height - y);
  const int whole = expected_->width / kPixels;
  int done = 0;
  bool is_at_end = false;
  roi_->ForEachMeasured(y, [&](const PixelRun& run) {
    for (int row = 0; row < rows; ++row)
      FetchPixels(image_, y + kBand_px + row, run.begin, run.end);
    const int first = std::max(run.begin / kPixels, done);
    done = (run.end + kPixels - 1) / kPixels;
    Measure(image_.Section(first * kPixels, y, (std::min(done, whole) - first) * kPixels, rows), y,
            first);
    if (done > whole) MeasureLast(y, rows);
    is_at_end |= run.begin == 0 || run.end == expected_->width;
  });
  for (int row = 0; is_at_end && row < rows; ++row) RepeatEnds(y + row);
  // Sums beyond the ends are never used.
  roi_->ForEachMeasured(y, [&](const PixelRun& run) { SumAlong(y, rows, run); });
}

// Measures the group in which the picture ends.
void DistortionScan::MeasureLast(int y, int rows) {
  const int group = expected_->width / kPixels, left = group * kPixels;
  for (int row = 0; row < rows; ++row)
    std::copy(image_.row(y + row) + left, image_.row(y + row) + expected_->width, last_.row(row));
  Measure(last_.view().Section(0, 0, kPixels, rows), y, group);
}

void DistortionScan::Measure(ImageView<const Bgr> pixels, int y, int group) {
  const int x = group * kPixels + kPad, line = y % kSumLines;
  kernels::MeasureDistortions(
      expected_->Group(group, y), expected_->height, pixels, gain_,
      y + 2 * kBand_px <= expected_->height ? kBand_px : 0,
      {alpha_shift_.row(y) + x,
       {lines_.cd[0].row(line) + x, lines_.cd[1].row(line) + x, lines_.cd[2].row(line) + x},
       lines_.cd_sq.row(line) + x,
       lines_.alpha_weight.row(line) + x,
       lines_.inverse_sigma.row(line) + x,
       alpha_shift_.width()});
}

void DistortionScan::RepeatEnds(int y) {
  const int line = y % kSumLines;
  for (float* const values : {alpha_shift_.row(y), lines_.cd[0].row(line), lines_.cd[1].row(line),
                              lines_.cd[2].row(line)}) {
    float* const end = values + kPad + expected_->width;
    std::fill_n(values, kPad, values[kPad]);
    std::fill_n(end, kPad, end[-1]);
  }
}

void DistortionScan::SumAlong(int y, int rows, const PixelRun& run) {
  // Blocks with judged pixels lie well within the run.
  const int first = (run.begin + kBlock_px - 1) / kBlock_px;
  const int blocks = (run.end + kBlock_px - 1) / kBlock_px - first;
  const int x = first * kBlock_px + kPad, line = y % kSumLines;
  kernels::SumAlongLines(
      alpha_shift_.row(y) + x,
      {lines_.cd[0].row(line) + x, lines_.cd[1].row(line) + x, lines_.cd[2].row(line) + x},
      alpha_shift_.width(), blocks, rows, &sums_[first * kSumLines + line]);
}

}  // namespace mocap
