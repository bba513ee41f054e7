#include "tools/solving/butterworth.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>

#include "core/errors.h"

namespace mocap {
namespace {

constexpr int kMostOrder = 16;
constexpr double kMostHz = 1000;
// An end is continued by this many time constants of the filter.
constexpr double kContinuation = 6;

/// A section of second order, or of first order with zeros, in direct form II transposed.
struct Section {
  double b0, b1, b2, a1, a2;
};

// Sections of one pass. @param warped  tan of half the cut-off's angle.
std::vector<Section> SectionsOf(int order, double warped) {
  std::vector<Section> sections;
  const double w = warped, w2 = w * w;
  for (int k = 0; k < order / 2; ++k) {
    const double damping = 2 * std::sin((2 * k + 1) * std::numbers::pi / (2 * order));
    const double a0 = 1 + damping * w + w2;
    sections.push_back(
        {w2 / a0, 2 * w2 / a0, w2 / a0, 2 * (w2 - 1) / a0, (1 - damping * w + w2) / a0});
  }
  if (order % 2 == 1) sections.push_back({w / (1 + w), w / (1 + w), 0, (w - 1) / (w + 1), 0});
  return sections;
}

// Filters forward, from the steady state of the first value.
void Pass(const std::vector<Section>& sections, std::vector<double>& values) {
  for (const Section& s : sections) {
    const double first = values.front();
    double z2 = (s.b2 - s.a2) * first, z1 = (s.b1 - s.a1) * first + z2;
    for (double& value : values) {
      const double in = value;
      value = s.b0 * in + z1;
      z1 = s.b1 * in - s.a1 * value + z2;
      z2 = s.b2 * in - s.a2 * value;
    }
  }
}

template <typename T>
bool ReadNumber(std::string_view text, T& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size();
}

}  // namespace

std::string NamedFilter::name() const {
  return is_none() ? "none" : fmt::format("butterworth:{}:{:g}", order, cutoff_hz);
}

NamedFilter ParseFilter(std::string_view text) {
  if (text == "none") return {};
  const std::string_view kind = "butterworth:";
  NamedFilter filter;
  if (text.starts_with(kind)) {
    const std::string_view numbers = text.substr(kind.size());
    const std::size_t colon = numbers.find(':');
    const bool is_read = colon != std::string_view::npos &&
                         ReadNumber(numbers.substr(0, colon), filter.order) &&
                         ReadNumber(numbers.substr(colon + 1), filter.cutoff_hz);
    const bool is_valid = is_read && filter.order >= 2 && filter.order <= kMostOrder &&
                          filter.order % 2 == 0 && filter.cutoff_hz > 0 &&
                          filter.cutoff_hz <= kMostHz;
    if (is_valid) return filter;
  }
  throw SetupError(fmt::format(
      "--filter: is {:?}; expected none, or butterworth:ORDER:HZ with an even order up to {} and a "
      "cut-off up to {} Hz, such as butterworth:4:6",
      std::string(text), kMostOrder, kMostHz));
}

std::vector<double> ZeroLagButterworth(std::span<const double> values, const NamedFilter& filter,
                                       double rate_hz) {
  std::vector<double> result(values.begin(), values.end());
  const int order = filter.order / 2;
  if (filter.is_none() || values.size() < 2) return result;
  if (filter.cutoff_hz >= rate_hz / 2) return result;
  const double raised = std::pow(std::numbers::sqrt2 - 1, -1.0 / (2 * order));
  const double warped = std::tan(std::numbers::pi * filter.cutoff_hz / rate_hz);
  const std::vector<Section> sections = SectionsOf(order, raised * warped);
  const auto wanted = static_cast<std::size_t>(kContinuation * rate_hz / filter.cutoff_hz);
  const std::size_t beyond = std::min(values.size() - 1, wanted);
  std::vector<double> longer;
  for (std::size_t i = beyond; i > 0; --i) longer.push_back(2 * values.front() - values[i]);
  longer.insert(longer.end(), values.begin(), values.end());
  for (std::size_t i = 1; i <= beyond; ++i)
    longer.push_back(2 * values.back() - values[values.size() - 1 - i]);
  for (int direction = 0; direction < 2; ++direction) {
    Pass(sections, longer);
    std::ranges::reverse(longer);
  }
  const auto begin = longer.begin() + static_cast<std::ptrdiff_t>(beyond);
  return {begin, begin + static_cast<std::ptrdiff_t>(values.size())};
}

}  // namespace mocap
