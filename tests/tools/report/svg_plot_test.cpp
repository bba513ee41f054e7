#include "tools/report/svg_plot.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <regex>

namespace mocap {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::Pointwise;

TEST(RoundTicks, AreRoundNumbersInsideTheRange) {
  EXPECT_THAT(RoundTicks(0, 119, 8), ElementsAre(0, 20, 40, 60, 80, 100));
  EXPECT_THAT(RoundTicks(-0.31, 0.29, 4), Pointwise(DoubleNear(1e-12), {-0.2, 0.0, 0.2}));
  EXPECT_THAT(RoundTicks(1230, 1270, 5), ElementsAre(1230, 1240, 1250, 1260, 1270));
}

TEST(RoundTicks, SurviveARangeOfNothing) { EXPECT_THAT(RoundTicks(5, 5, 4), ElementsAre(5)); }

TEST(EscapeHtml, DisarmsMarkup) {
  EXPECT_EQ(EscapeHtml("<a href=\"x\">&"), "&lt;a href=&quot;x&quot;&gt;&amp;");
}

TEST(PlotSvg, PutsPointsWhereTheScalesSay) {
  PlotAxes axes{"x", "y", 172, 168};  // Leaves 100 by 100 pixels inside the margins.
  axes.x_range = axes.y_range = Vector2(0, 10);
  const PlotSeries series[] = {{"", {{0, 0}, {5, 10}}, 3, PlotMark::kDots}};
  const std::string svg = PlotSvg(axes, series);
  EXPECT_THAT(svg, HasSubstr("<circle class=\"dot c3\" cx=\"58.0\" cy=\"126.0\""));
  EXPECT_THAT(svg, HasSubstr("<circle class=\"dot c3\" cx=\"108.0\" cy=\"26.0\""));
}

TEST(PlotSvg, BreaksALineWhereAValueIsMissing) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  PlotAxes axes{"x", "y", 172, 168};
  axes.x_range = axes.y_range = Vector2(0, 10);
  const PlotSeries series[] = {{"", {{0, 0}, {1, 1}, {2, nan}, {3, 3}, {4, 4}}, 0}};
  const std::string svg = PlotSvg(axes, series);
  EXPECT_THAT(svg, HasSubstr("d=\"M58.0 126.0L68.0 116.0M88.0 96.0L98.0 86.0\""));
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
}

TEST(PlotSvg, KeepsAPlansScalesEqual) {
  PlotAxes axes{"x [m]", "y [m]", 272, 168};  // 200 by 100 pixels.
  axes.equal_scales = true;
  axes.x_range = axes.y_range = Vector2(0, 10);
  const PlotSeries series[] = {{"", {{0, 0}, {1, 1}}, 0, PlotMark::kDots}};
  const std::string svg = PlotSvg(axes, series);
  std::smatch match;
  ASSERT_TRUE(std::regex_search(
      svg, match,
      std::regex("cx=\"([0-9.]+)\" cy=\"([0-9.]+)\".*cx=\"([0-9.]+)\" cy=\"([0-9.]+)\"")));
  EXPECT_NEAR(std::stod(match[3]) - std::stod(match[1]), 10, 0.11);
  EXPECT_NEAR(std::stod(match[2]) - std::stod(match[4]), 10, 0.11);
}

TEST(PlotSvg, DrawsAnEmptyPlotToo) {
  EXPECT_THAT(PlotSvg({"x", "y"}, {}), ::testing::EndsWith("</svg>\n"));
}

}  // namespace
}  // namespace mocap
