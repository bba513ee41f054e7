#include "tools/report/report_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/support/report_data.h"

namespace mocap {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

TEST(ReportHtml, HasItsDataAndIsRecognized) {
  const std::string html = ReportHtml("walk", "20 frames", Json::array({Heading("First")}));
  EXPECT_THAT(html, StartsWith(std::string(kReportBeginnings[0])));
  const auto data = testing::ReportData(html);
  EXPECT_EQ(data["title"], "walk");
  EXPECT_EQ(data["under"], "20 frames");
  EXPECT_EQ(data["sections"][0]["text"], "First");
}

TEST(ReportHtml, NoTextEndsItsElement) {
  const std::string evil = "</script><script>alert(1)</script><!--";
  const std::string html = ReportHtml(evil, evil, Json::array({Paragraph(evil)}));
  EXPECT_THAT(html, Not(HasSubstr("alert(1)</script>")));
  EXPECT_EQ(testing::ReportData(html)["sections"][0]["text"], evil);
}

TEST(ReportHtml, BytesThatAreNoTextAreShownAsQuestionMarks) {
  const auto data = testing::ReportData(ReportHtml("a", "b", Json::array({Paragraph("\xff")})));
  EXPECT_EQ(data["sections"][0]["text"], "\ufffd");
}

TEST(ScriptOf, HasEachModuleOnceAndBeforeThoseThatImportIt) {
  const std::string script = ScriptOf("report");
  const std::size_t dom = script.find("const dom = (() => {");
  ASSERT_NE(dom, std::string::npos);
  EXPECT_LT(dom, script.find("const svg_plot = (() => {"));
  EXPECT_EQ(script.find("const dom = (() => {", dom + 1), std::string::npos);
  EXPECT_THAT(script, Not(ContainsRegex("\n(import|export) ")));
  EXPECT_THAT(script, HasSubstr("const {byId, make, setText} = dom;"));
  EXPECT_THAT(script, Not(HasSubstr("</script")));
}

TEST(Table, NamesAreTextAndOtherColumnsHaveDecimals) {
  const Json table = Table({{"camera"}, {"mm", 1, true}, {"error", 2, false, true}}, Json::array());
  EXPECT_FALSE(table["columns"][0].contains("decimals"));
  EXPECT_EQ(table["columns"][1], (Json{{"name", "mm"}, {"decimals", 1}, {"bars", true}}));
  EXPECT_EQ(table["columns"][2]["signed"], true);
  EXPECT_EQ(BarTable("point", "mm", 1, {{"head", 2.5}})["rows"], Json::array({{"head", 2.5}}));
}

TEST(NumberOrNull, NumbersAreShortAndUnknownOnesNull) {
  EXPECT_EQ(NumberOrNull(1.23456).dump(), "1.235");
  EXPECT_TRUE(NumberOrNull(std::nan("")).is_null());
  EXPECT_TRUE(NumberOrNull(std::numeric_limits<double>::infinity()).is_null());
}

}  // namespace
}  // namespace mocap
