#include "tools/gait/gait_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace mocap {
namespace {

int DecimalsOf(std::string_view unit) {
  if (unit == "mm") return 0;
  return unit == "s" || unit == "m/s" ? 2 : 1;
}

// "12 of 12 foot strikes, 9 ± 11 ms later"
std::string AgreementText(const EventAgreement& one, const char* events) {
  const MeanAndSpread& later = one.later_s;
  const std::string found = fmt::format("{} of {} {}", later.count, one.by_contact, events);
  if (later.count == 0) return found;
  return fmt::format("{}, {:.0f} ± {:.0f} ms {}", found, 1000 * std::abs(later.mean),
                     1000 * later.spread, later.mean < 0 ? "earlier" : "later");
}

}  // namespace

std::string EventsText(const GaitAnalysis& gait) {
  if (!gait.check) return "by position (Zeni et al. 2008); the result has no contacts";
  const auto& [strikes, offs] = *gait.check;
  return "by contact; by position (Zeni et al. 2008) " + AgreementText(strikes, "foot strikes") +
         ", and " + AgreementText(offs, "foot offs");
}

std::string MeasuredText(const GaitFigure& figure, const MeanAndSpread& measured) {
  const int decimals = DecimalsOf(figure.unit);
  return measured.count > 0
             ? fmt::format("{:.{}f} ± {:.{}f}", measured.mean, decimals, measured.spread, decimals)
             : "-";
}

std::string SymmetryText(double percent) {
  return std::isnan(percent) ? "-" : fmt::format("{:.1f} %", percent);
}

std::string GaitText(const GaitAnalysis& gait) {
  const auto strides = [&](Side side) {
    return std::ranges::count(gait.strides, side, &Stride::side);
  };
  if (gait.strides.empty())
    return fmt::format("no whole stride in {:.1f} s of tracking\n", gait.tracked_s);
  std::string text =
      fmt::format("strides: {} left, {} right\nevents: {}\n\n{:<16}{:<11}{:>18}{:>18}{:>12}\n",
                  strides(Side::kLeft), strides(Side::kRight), EventsText(gait), "", "", "left",
                  "right", "symmetry");
  for (std::size_t i = 0; i < kGaitFigures.size(); ++i) {
    const GaitFigure& figure = kGaitFigures[i];
    text += fmt::format("{:<16}{:<11}{:>18}{:>18}{:>12}\n", figure.name, figure.unit,
                        MeasuredText(figure, gait.summary.figures[0][i]),
                        MeasuredText(figure, gait.summary.figures[1][i]),
                        SymmetryText(gait.summary.symmetry_percent[i]));
  }
  return text;
}

}  // namespace mocap
