#include "tools/report/certainty.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/quantile.h"
#include "tools/results/export_axes.h"

namespace mocap {
namespace {

/// Share of errors within twice the deviation of their point.
std::optional<double> ShareWithinTwo(const std::vector<PoseRow>& poses, const Accuracy& accuracy) {
  int known = 0, within = 0;
  for (const FrameError& frame : accuracy.frames) {
    const PoseRow& row = poses[static_cast<std::size_t>(frame.pose)];
    for (int i = 0; i < kScoredPointCount; ++i) {
      const double deviation_mm = row.point_std_mm[static_cast<int>(kScoredPoints[i])];
      if (std::isnan(deviation_mm)) continue;
      ++known;
      within += frame.point_mm[i] <= 2 * deviation_mm;
    }
  }
  if (known == 0) return {};
  return static_cast<double>(within) / known;
}

std::optional<CertaintyCheck> CheckOf(const std::vector<PoseRow>& poses, const Accuracy& accuracy) {
  if (accuracy.frames.empty()) return {};
  std::vector<std::pair<double, double>> fit_and_error_mm;
  for (const FrameError& frame : accuracy.frames) {
    fit_and_error_mm.emplace_back(poses[static_cast<std::size_t>(frame.pose)].residual_mm,
                                  frame.point_mm.mean());
  }
  std::ranges::sort(fit_and_error_mm);
  const std::size_t half = (fit_and_error_mm.size() + 1) / 2;
  const auto mean_mm = [&](std::size_t begin, std::size_t end) {
    double sum_mm = 0;
    for (std::size_t i = begin; i < end; ++i) sum_mm += fit_and_error_mm[i].second;
    return sum_mm / static_cast<double>(end - begin);
  };
  return CertaintyCheck{mean_mm(0, half),
                        mean_mm(fit_and_error_mm.size() - half, fit_and_error_mm.size()),
                        ShareWithinTwo(poses, accuracy), CheckProbabilities(poses, accuracy)};
}

std::string DeviationText(const Certainty& certainty) {
  std::string text = fmt::format("deviation   {:.1f} mm (median)", *certainty.median_deviation_mm);
  if (certainty.check && certainty.check->within_two_deviations) {
    text += fmt::format("; errors within twice the deviation: {:.0f} %",
                        100 * *certainty.check->within_two_deviations);
  }
  return text + '\n';
}

}  // namespace

std::optional<Certainty> MeasureCertainty(const std::vector<PoseRow>& poses,
                                          const std::optional<Accuracy>& accuracy) {
  std::vector<double> fits_mm, deviations_mm;
  for (const PoseRow& row : poses) {
    if (!IsTracked(row)) continue;
    fits_mm.push_back(row.residual_mm);
    for (const double mm : row.point_std_mm) {
      if (!std::isnan(mm)) deviations_mm.push_back(mm);
    }
  }
  if (fits_mm.empty()) return {};
  Certainty certainty{QuantileOf(fits_mm, 0.5), QuantileOf(fits_mm, 0.95), {}, {}};
  if (!deviations_mm.empty()) certainty.median_deviation_mm = QuantileOf(deviations_mm, 0.5);
  if (accuracy) certainty.check = CheckOf(poses, *accuracy);
  return certainty;
}

std::string CertaintyText(const Certainty& certainty) {
  std::string text = fmt::format("fit         {:.1f} mm (median), 95 % below {:.1f} mm",
                                 certainty.median_fit_mm, certainty.p95_fit_mm);
  const auto& check = certainty.check;
  if (check) {
    text +=
        fmt::format("; mean error {:.1f} mm in the half that fits better, {:.1f} mm in the other",
                    check->better_half_mm, check->worse_half_mm);
  }
  text += '\n';
  return certainty.median_deviation_mm ? text + DeviationText(certainty) : text;
}

std::string ProbabilityTextOf(const std::optional<Certainty>& certainty) {
  const bool is_checked = certainty && certainty->check;
  return is_checked ? ProbabilityTable(certainty->check->probabilities) : std::string();
}

}  // namespace mocap
