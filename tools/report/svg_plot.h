// Line and point plots as small self-contained SVG. Colours come from the embedding page, through
// the CSS classes c0, c1 … (strokes and fills), `axis`, `grid` and `shade`.
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/geometry.h"

namespace mocap {

enum class PlotMark { kLine, kDashed, kDots, kRings, kCrosses };

/// A coordinate that interrupts a line.
inline constexpr double kPlotGap = std::numeric_limits<double>::quiet_NaN();

/// A curve or point cloud. A NaN interrupts the line.
struct PlotSeries {
  std::string label;  ///< In the legend; empty: omitted.
  std::vector<Vector2> points;
  int color = 0;
  PlotMark mark = PlotMark::kLine;
  std::vector<std::string> names{};  ///< Labels of the points; empty: none.
};

struct PlotAxes {
  std::string x_label, y_label;  ///< With units.
  int width = 760, height = 240;
  bool equal_scales = false;                    ///< For plans: same scale on both axes.
  std::optional<Vector2> x_range{}, y_range{};  ///< Otherwise from the data.
  std::vector<std::string> x_names{};           ///< For categories 0, 1, …: instead of numbers.
  std::vector<std::pair<double, double>> shaded{};  ///< Ranges of x, drawn behind the curves.
};

/// Draws a plot. The result is an <svg> element.
std::string PlotSvg(const PlotAxes& axes, std::span<const PlotSeries> series);

/// Stacks plots of the same size into a separate file, with colours.
std::string StackedSvg(std::span<const std::string> plots, int width, int height);

/// Ticks in steps of 1, 2 or 5 times a power of ten, about `count` within a range.
std::vector<double> RoundTicks(double low, double high, int count);

/// Makes text safe inside HTML and SVG.
std::string EscapeHtml(std::string_view text);

}  // namespace mocap
