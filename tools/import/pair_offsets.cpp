#include "tools/import/pair_offsets.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace mocap {
namespace {

/// What differs more from the other pairs is another event: as far as sound travels in a hall.
constexpr double kContradiction_s = 0.05;
/// Keeps one pair from deciding alone.
constexpr double kLeastSigma_s = 0.0005;

/// Marks what is connected with a known clock.
void Connect(std::span<const PairOffset> pairs, std::vector<ClockFit>& clocks) {
  for (bool grows = true; grows;) {
    grows = false;
    for (const PairOffset& pair : pairs) {
      if (clocks[pair.first].is_known == clocks[pair.second].is_known) continue;
      clocks[pair.first].is_known = clocks[pair.second].is_known = grows = true;
    }
  }
}

std::size_t MostConnected(std::size_t recordings, std::span<const PairOffset> pairs) {
  std::vector<int> counts(recordings);
  for (const PairOffset& pair : pairs) ++counts[pair.first], ++counts[pair.second];
  return static_cast<std::size_t>(std::ranges::max_element(counts) - counts.begin());
}

double WeightOf(const PairOffset& pair) { return 1 / std::max(pair.sigma_s, kLeastSigma_s); }

/// Solves for the free recordings that are connected: x_second - x_first = value.
/// @param value  of a pair; empty: it does not count.
template <typename Value>
void Solve(std::span<const PairOffset> pairs, const std::vector<bool>& is_free, const Value& value,
           std::vector<double>& x) {
  std::vector<int> column(x.size(), -1);
  int columns = 0;
  for (std::size_t i = 0; i < x.size(); ++i)
    if (is_free[i]) column[i] = columns++;
  if (columns == 0) return;
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(columns, columns);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(columns);
  for (const PairOffset& pair : pairs) {
    const std::optional<double> wanted = value(pair);
    if (!wanted) continue;
    const double weight = WeightOf(pair) * WeightOf(pair);
    const int a = column[pair.first], b = column[pair.second];
    const double fixed = (a < 0 ? x[pair.first] : 0) - (b < 0 ? x[pair.second] : 0);
    if (a >= 0) normal(a, a) += weight, right(a) -= weight * (*wanted + fixed);
    if (b >= 0) normal(b, b) += weight, right(b) += weight * (*wanted + fixed);
    if (a >= 0 && b >= 0) normal(a, b) -= weight, normal(b, a) -= weight;
  }
  const Eigen::VectorXd found = normal.completeOrthogonalDecomposition().solve(right);
  for (std::size_t i = 0; i < x.size(); ++i)
    if (column[i] >= 0) x[i] = found(column[i]);
}

/// What a pair says about the difference of two offsets, given the rates.
double OffsetBy(const PairOffset& pair, const std::vector<double>& rates) {
  const double first_s = pair.at_s, second_s = pair.at_s - pair.ahead_s;
  return pair.ahead_s + rates[pair.first] * first_s - rates[pair.second] * second_s;
}

struct Solution {
  std::vector<double> rates, offsets;

  double ErrorOf(const PairOffset& pair) const {
    return offsets[pair.second] - offsets[pair.first] - OffsetBy(pair, rates);
  }
};

Solution SolveAll(std::span<const PairOffset> pairs, const std::vector<ClockFit>& known,
                  const std::vector<ClockFit>& connected) {
  Solution s{std::vector<double>(known.size()), std::vector<double>(known.size())};
  std::vector<bool> is_free(known.size());
  for (std::size_t i = 0; i < known.size(); ++i) {
    is_free[i] = connected[i].is_known && !known[i].is_known;
    s.offsets[i] = known[i].offset_s, s.rates[i] = known[i].rate_ppm * 1e-6;
  }
  // A rate counts only if every connected pair tells one: otherwise its zero would be unequal.
  const bool have_rates =
      std::ranges::all_of(pairs, [](const PairOffset& pair) { return pair.rate_ppm.has_value(); });
  const auto rate = [&](const PairOffset& pair) -> std::optional<double> {
    return have_rates ? *pair.rate_ppm * 1e-6 : 0.0;
  };
  Solve(pairs, is_free, rate, s.rates);
  const auto offset = [&](const PairOffset& pair) -> std::optional<double> {
    return OffsetBy(pair, s.rates);
  };
  Solve(pairs, is_free, offset, s.offsets);
  return s;
}

/// Whether all stay connected without a pair.
bool MayGo(std::vector<PairOffset> pairs, std::size_t without, const std::vector<ClockFit>& known,
           const std::vector<ClockFit>& connected) {
  pairs.erase(pairs.begin() + static_cast<std::ptrdiff_t>(without));
  std::vector<ClockFit> clocks = known;
  Connect(pairs, clocks);
  return std::ranges::equal(clocks, connected, {}, &ClockFit::is_known, &ClockFit::is_known);
}

/// Writes what the pairs of a recording say of it.
void Judge(std::span<const PairOffset> pairs, const Solution& solution, int recording,
           ClockFit& fit) {
  double squares = 0;
  int count = 0;
  for (const PairOffset& pair : pairs) {
    if (pair.first != recording && pair.second != recording) continue;
    const double error_s = solution.ErrorOf(pair);
    squares += error_s * error_s + pair.sigma_s * pair.sigma_s;
    fit.worst_s = std::max(fit.worst_s, std::abs(error_s));
    fit.clearness = std::max(fit.clearness, pair.clearness);
    ++count;
  }
  if (count > 0) fit.sigma_s = std::sqrt(squares) / count;
}

}  // namespace

std::vector<ClockFit> FitClocks(std::vector<ClockFit> known, std::span<const PairOffset> pairs) {
  if (std::ranges::none_of(known, &ClockFit::is_known))
    known[MostConnected(known.size(), pairs)].is_known = true;
  std::vector<PairOffset> used(pairs.begin(), pairs.end());
  std::vector<ClockFit> clocks = known;
  Connect(used, clocks);
  std::erase_if(used, [&](const PairOffset& pair) { return !clocks[pair.first].is_known; });
  Solution solution = SolveAll(used, known, clocks);
  while (!used.empty()) {
    std::size_t worst = used.size();
    double most_s = kContradiction_s;
    for (std::size_t i = 0; i < used.size(); ++i) {
      const double error_s = std::abs(solution.ErrorOf(used[i]));
      if (error_s > most_s && MayGo(used, i, known, clocks)) worst = i, most_s = error_s;
    }
    if (worst == used.size()) break;
    used.erase(used.begin() + static_cast<std::ptrdiff_t>(worst));
    solution = SolveAll(used, known, clocks);
  }
  for (std::size_t i = 0; i < clocks.size(); ++i) {
    if (known[i].is_known && known[i].clearness > 0) continue;
    clocks[i].offset_s = solution.offsets[i];
    clocks[i].rate_ppm = solution.rates[i] * 1e6;
    Judge(used, solution, static_cast<int>(i), clocks[i]);
  }
  return clocks;
}

}  // namespace mocap
