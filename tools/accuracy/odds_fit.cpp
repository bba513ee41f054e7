#include "tools/accuracy/odds_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/quantile.h"
#include "tools/accuracy/golden_section.h"

namespace mocap {
namespace {

constexpr double kLeastFactor = 1e-4, kMostFactor = 100;
constexpr double kLogFactorTolerance = 1e-3;

// How many nats each wrong pose has more than the right one.
using Leads = std::vector<double>;

double SumWithout(const OddsFrame::Nats& nats, int term) {
  double sum = std::accumulate(nats.begin(), nats.end(), 0.0);
  if (term >= 0) sum -= nats[static_cast<std::size_t>(term)];
  return sum;
}

// @param without  a term that is left out; -1: none.
Leads LeadsOf(const OddsFrame& frame, int without) {
  const auto sum = [&](const OddsFrame::Nats& nats) { return SumWithout(nats, without); };
  const double right = sum(*std::ranges::min_element(frame.right, {}, sum));
  Leads leads;
  for (const OddsFrame::Nats& nats : frame.wrong) leads.push_back(sum(nats) - right);
  return leads;
}

std::vector<Leads> LeadsOfHalf(std::span<const OddsTake> takes, std::size_t first) {
  std::vector<Leads> frames;
  for (std::size_t t = first; t < takes.size(); t += 2)
    for (const OddsFrame& frame : takes[t]) frames.push_back(LeadsOf(frame, -1));
  return frames;
}

// -log p of the right pose. The likeliest pose counts 1, so that nothing overflows.
double NatsOfRight(const Leads& leads, double temperature) {
  const double least = std::min(0.0, std::ranges::min(leads));
  double sum = std::exp(temperature * least);
  for (const double lead : leads) sum += std::exp(temperature * (least - lead));
  return std::log(sum) - temperature * least;
}

double MeanNatsOfRight(const std::vector<Leads>& frames, double temperature) {
  double sum = 0;
  for (const Leads& leads : frames) sum += NatsOfRight(leads, temperature);
  return sum / static_cast<double>(frames.size());
}

double FitTemperature(const std::vector<Leads>& frames) {
  return std::exp(LeastBetween(
      std::log(kLeastFactor), std::log(kMostFactor), kLogFactorTolerance,
      [&](double log_factor) { return MeanNatsOfRight(frames, std::exp(log_factor)); }));
}

double RightShare(std::span<const OddsTake> takes, int without) {
  double right = 0, all = 0;
  for (const OddsTake& take : takes) {
    for (const OddsFrame& frame : take) {
      ++all;
      right += std::ranges::min(LeadsOf(frame, without)) > 0;
    }
  }
  return right / all;
}

void Calibrate(const std::vector<Leads>& frames, double temperature, MeasuredOdds& odds) {
  for (const Leads& leads : frames) {
    const double least = std::ranges::min(leads);
    // The likeliest pose is the right one, or a wrong one with the least lead.
    const double p =
        std::exp(-NatsOfRight(leads, temperature) - temperature * std::min(0.0, least));
    for (MeasuredOdds::Bin& bin : odds.bins) {
      if (p < bin.from || (p >= bin.to && bin.to < 1)) continue;
      ++bin.frames;
      bin.predicted += p;
      bin.right_share += least > 0;
    }
  }
  for (MeasuredOdds::Bin& bin : odds.bins) {
    bin.predicted /= std::max(1, bin.frames);
    bin.right_share /= std::max(1, bin.frames);
  }
}

}  // namespace

MeasuredOdds FitOdds(std::span<const OddsTake> takes) {
  const std::vector<Leads> fitted = LeadsOfHalf(takes, 0), others = LeadsOfHalf(takes, 1);
  MeasuredOdds odds;
  std::vector<double> least;
  for (const auto* half : {&fitted, &others})
    for (const Leads& leads : *half) least.push_back(std::ranges::min(leads));
  odds.frames = static_cast<int>(least.size());
  odds.median_lead_nats = MedianOf(least);
  odds.right_share = RightShare(takes, -1);
  for (std::size_t term = 0; term < kTermNames.size(); ++term)
    odds.right_share_without[term] = RightShare(takes, static_cast<int>(term));
  odds.temperature = FitTemperature(fitted);
  odds.others_nats = MeanNatsOfRight(others, odds.temperature);
  odds.own_nats = MeanNatsOfRight(others, FitTemperature(others));
  Calibrate(others, odds.temperature, odds);
  return odds;
}

std::string OddsTables(std::span<const OddsTake> takes) {
  if (LeadsOfHalf(takes, 0).empty() || LeadsOfHalf(takes, 1).empty()) return {};
  const MeasuredOdds odds = FitOdds(takes);
  std::string text = fmt::format(
      "\n## Odds of poses\n{} sets with right and wrong poses. The right one has the fewest nats "
      "in {:.1f} % of them, with a median lead of {:.1f} nats. Half of the people give the nats a "
      "factor of {:.3f}. The right pose of the others costs {:.3f} nats by it, and {:.3f} by their "
      "own.\n\n| probability of the likeliest | sets of the others | mean | right % "
      "|\n|---|---|---|---|\n",
      odds.frames, 100 * odds.right_share, odds.median_lead_nats, odds.temperature,
      odds.others_nats, odds.own_nats);
  for (const MeasuredOdds::Bin& bin : odds.bins) {
    text += fmt::format("| {:.1f} to {:.1f} | {} | {:.3f} | {:.1f} |\n", bin.from, bin.to,
                        bin.frames, bin.predicted, 100 * bin.right_share);
  }
  text += "\n| without | right % |\n|---|---|\n";
  for (std::size_t term = 0; term < kTermNames.size(); ++term) {
    text +=
        fmt::format("| {} | {:.1f} |\n", kTermNames[term], 100 * odds.right_share_without[term]);
  }
  return text;
}

}  // namespace mocap
