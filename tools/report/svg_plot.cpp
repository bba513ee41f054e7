#include "tools/report/svg_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "drivers/printable_text.h"

namespace mocap {
namespace {

constexpr int kLeft = 58, kRight = 14, kTop = 26, kBottom = 42;
constexpr int kPixelsPerTickX = 70, kPixelsPerTickY = 36;

bool IsDrawable(const Vector2& p) { return std::isfinite(p.x()) && std::isfinite(p.y()); }

/// Range of one coordinate over all series, with a margin.
Vector2 RangeOf(std::span<const PlotSeries> series, int axis, double air) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const PlotSeries& s : series) {
    for (const Vector2& p : s.points) {
      if (!IsDrawable(p)) continue;
      low = std::min(low, p[axis]);
      high = std::max(high, p[axis]);
    }
  }
  if (low > high) return {0, 1};
  if (low == high) return {low - 0.5, high + 0.5};
  return {low - air * (high - low), high + air * (high - low)};
}

/// Maps data to picture coordinates.
class Frame {
 public:
  Frame(const PlotAxes& axes, std::span<const PlotSeries> series)
      : x_(axes.x_range.value_or(RangeOf(series, 0, axes.equal_scales ? 0.05 : 0))),
        y_(axes.y_range.value_or(RangeOf(series, 1, 0.06))),
        right_(axes.width - kRight),
        bottom_(axes.height - kBottom) {
    if (!axes.equal_scales) return;
    const double unit_x = (x_[1] - x_[0]) / (right_ - kLeft);
    const double unit_y = (y_[1] - y_[0]) / (bottom_ - kTop);
    Widen(x_, std::max(1.0, unit_y / unit_x));
    Widen(y_, std::max(1.0, unit_x / unit_y));
  }

  double X(double x) const { return kLeft + (x - x_[0]) / (x_[1] - x_[0]) * (right_ - kLeft); }
  double Y(double y) const { return bottom_ - (y - y_[0]) / (y_[1] - y_[0]) * (bottom_ - kTop); }
  const Vector2& x() const { return x_; }
  const Vector2& y() const { return y_; }
  int right() const { return right_; }
  int bottom() const { return bottom_; }

 private:
  static void Widen(Vector2& range, double factor) {
    const double middle = range.mean(), half = (range[1] - range[0]) / 2 * factor;
    range = {middle - half, middle + half};
  }

  Vector2 x_, y_;
  int right_, bottom_;
};

std::string TickText(double value) {
  // A tick near zero is zero with a rounding error.
  return fmt::format("{:.6g}", std::abs(value) < 1e-9 ? 0.0 : value);
}

std::string Grid(const PlotAxes& axes, const Frame& frame) {
  std::string svg;
  for (const auto& [from, to] : axes.shaded) {
    const double x = frame.X(std::max(from, frame.x()[0]));
    svg += fmt::format(
        "<rect class=\"shade\" x=\"{:.1f}\" y=\"{}\" width=\"{:.1f}\" height=\"{}\"/>", x, kTop,
        std::max(0.0, frame.X(std::min(to, frame.x()[1])) - x), frame.bottom() - kTop);
  }
  const int y_spacing = axes.equal_scales ? kPixelsPerTickX : kPixelsPerTickY;
  for (const double y :
       RoundTicks(frame.y()[0], frame.y()[1], (frame.bottom() - kTop) / y_spacing)) {
    svg += fmt::format(
        "<line class=\"grid\" x1=\"{0}\" x2=\"{1}\" y1=\"{2:.1f}\" y2=\"{2:.1f}\"/>"
        "<text x=\"{3}\" y=\"{4:.1f}\" text-anchor=\"end\">{5}</text>",
        kLeft, frame.right(), frame.Y(y), kLeft - 7, frame.Y(y) + 4, TickText(y));
  }
  const auto vertical = [&](double x, const std::string& text) {
    svg += fmt::format(
        "<line class=\"grid\" x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1}\" y2=\"{2}\"/>"
        "<text x=\"{0:.1f}\" y=\"{3}\" text-anchor=\"middle\">{4}</text>",
        frame.X(x), kTop, frame.bottom(), frame.bottom() + 16, EscapeHtml(text));
  };
  for (std::size_t i = 0; i < axes.x_names.size(); ++i) {
    vertical(static_cast<double>(i), axes.x_names[i]);
  }
  if (axes.x_names.empty()) {
    for (const double x :
         RoundTicks(frame.x()[0], frame.x()[1], (frame.right() - kLeft) / kPixelsPerTickX)) {
      vertical(x, TickText(x));
    }
  }
  return svg;
}

std::string Labels(const PlotAxes& axes, const Frame& frame) {
  return fmt::format(
      "<path class=\"axis\" d=\"M{0} {1}V{2}H{3}\"/>"
      "<text class=\"label\" x=\"{4}\" y=\"{5}\" text-anchor=\"middle\">{6}</text>"
      "<text class=\"label\" transform=\"translate(14 {7}) rotate(-90)\" "
      "text-anchor=\"middle\">{8}</text>",
      kLeft, kTop, frame.bottom(), frame.right(), (kLeft + frame.right()) / 2, axes.height - 6,
      EscapeHtml(axes.x_label), (kTop + frame.bottom()) / 2, EscapeHtml(axes.y_label));
}

std::string Line(const PlotSeries& s, const Frame& frame) {
  std::string path;
  bool pen_down = false;
  for (const Vector2& p : s.points) {
    if (IsDrawable(p)) {
      path += fmt::format("{}{:.1f} {:.1f}", pen_down ? 'L' : 'M', frame.X(p.x()), frame.Y(p.y()));
    }
    pen_down = IsDrawable(p);
  }
  return fmt::format("<path class=\"line c{}{}\" d=\"{}\"/>", s.color,
                     s.mark == PlotMark::kDashed ? " dashed" : "", path);
}

std::string Mark(PlotMark mark, int color, double x, double y) {
  switch (mark) {
    case PlotMark::kDots:
      return fmt::format("<circle class=\"dot c{}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4\"/>", color,
                         x, y);
    case PlotMark::kRings:
      return fmt::format("<circle class=\"ring c{}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"5.5\"/>",
                         color, x, y);
    case PlotMark::kCrosses:
      return fmt::format("<path class=\"line c{}\" d=\"M{:.1f} {:.1f}l8 8m-8 0l8 -8\"/>", color,
                         x - 4, y - 4);
    case PlotMark::kLine:
    case PlotMark::kDashed:
      return fmt::format("<path class=\"line c{}{}\" d=\"M{:.1f} {:.1f}h18\"/>", color,
                         mark == PlotMark::kDashed ? " dashed" : "", x - 9, y);
  }
  return {};
}

std::string Drawn(const PlotSeries& s, const Frame& frame) {
  if (s.mark == PlotMark::kLine || s.mark == PlotMark::kDashed) return Line(s, frame);
  std::string svg;
  for (std::size_t i = 0; i < s.points.size(); ++i) {
    if (!IsDrawable(s.points[i])) continue;
    const double x = frame.X(s.points[i].x()), y = frame.Y(s.points[i].y());
    svg += Mark(s.mark, s.color, x, y);
    if (i < s.names.size()) {
      svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{}</text>", x,
                         y - 9, EscapeHtml(s.names[i]));
    }
  }
  return svg;
}

std::string Legend(std::span<const PlotSeries> series) {
  std::string svg;
  double x = kLeft + 10;
  for (const PlotSeries& s : series) {
    if (s.label.empty()) continue;
    svg += Mark(s.mark, s.color, x, kTop - 14);
    svg += fmt::format("<text x=\"{:.1f}\" y=\"{}\">{}</text>", x + 13, kTop - 10,
                       EscapeHtml(s.label));
    x += 44 + 6.3 * static_cast<double>(s.label.size());
  }
  return svg;
}

}  // namespace

std::vector<double> RoundTicks(double low, double high, int count) {
  const double raw = (high - low) / std::max(1, count);
  if (!(raw > 0) || !std::isfinite(raw)) return {low};
  const double power = std::pow(10, std::floor(std::log10(raw)));
  const double share = raw / power;
  const double step = power * (share < 1.4 ? 1 : share < 3.2 ? 2 : share < 7.1 ? 5 : 10);
  std::vector<double> ticks;
  for (double i = std::ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; ++i) {
    ticks.push_back(i * step);
  }
  return ticks;
}

std::string EscapeHtml(std::string_view text) {
  std::string safe;
  for (const char c : Printable(text)) {
    switch (c) {
      case '&':
        safe += "&amp;";
        break;
      case '<':
        safe += "&lt;";
        break;
      case '>':
        safe += "&gt;";
        break;
      case '"':
        safe += "&quot;";
        break;
      default:
        safe += c;
    }
  }
  return safe;
}

std::string PlotSvg(const PlotAxes& axes, std::span<const PlotSeries> series) {
  const Frame frame(axes, series);
  std::string svg = fmt::format("<svg class=\"plot\" viewBox=\"0 0 {} {}\" role=\"img\">",
                                axes.width, axes.height);
  svg += Grid(axes, frame);
  for (const PlotSeries& s : series) svg += Drawn(s, frame);
  return svg + Labels(axes, frame) + Legend(series) + "</svg>\n";
}

std::string StackedSvg(std::span<const std::string> plots, int width, int height) {
  const auto total = static_cast<int>(plots.size()) * height;
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" "
      "font-family=\"sans-serif\" font-size=\"12\">\n<style>.c0{{stroke:#0072b2;fill:#0072b2}}"
      ".c1{{stroke:#d55e00;fill:#d55e00}}.c2{{stroke:#009e73;fill:#009e73}}"
      ".c3{{stroke:#cc79a7;fill:#cc79a7}}.c4{{stroke:#000;fill:#000}}"
      ".axis{{stroke:#444;fill:none}}.grid{{stroke:#ddd}}"
      ".line{{fill:none;stroke-width:2}}text{{stroke:none;fill:#222}}</style>\n"
      "<rect width=\"{0}\" height=\"{1}\" fill=\"#fff\"/>\n",
      width, total);
  int top = 0;
  for (const std::string& plot : plots) {
    svg += fmt::format("<svg y=\"{}\" width=\"{}\" height=\"{}\">{}</svg>\n", top, width, height,
                       plot);
    top += height;
  }
  return svg + "</svg>\n";
}

}  // namespace mocap
