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

}  // namespace

std::string EventsText(const GaitAnalysis& gait) {
  if (!gait.check) return "by position (Zeni et al. 2008); the result has no contacts";
  std::string text = "by contact; by position (Zeni et al. 2008)";
  for (std::size_t kind = 0; kind < gait.check->size(); ++kind) {
    const EventAgreement& one = (*gait.check)[kind];
    text += fmt::format("{} {} of {} {}", kind == 0 ? "" : ",", one.both, one.by_contact,
                        kind == 0 ? "foot strikes" : "foot offs");
    if (one.both > 0)
      text += fmt::format(", {:+.0f} ± {:.0f} ms", 1000 * one.mean_s, 1000 * one.spread_s);
  }
  return text;
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
