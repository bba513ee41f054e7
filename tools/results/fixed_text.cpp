#include "tools/results/fixed_text.h"

#include <fmt/format.h>

#include <cmath>

namespace mocap {

std::string FixedText(double value, int decimals) {
  if (std::isnan(value)) return "nan";
  std::string text = fmt::format("{:.{}f}", value, decimals);
  const bool is_zero = text.find_first_not_of("-0.") == std::string::npos;
  return is_zero && text[0] == '-' ? text.substr(1) : text;
}

}  // namespace mocap
