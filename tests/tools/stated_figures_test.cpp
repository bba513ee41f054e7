// Results that a page states, against the page that has them: they cannot drift apart.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <regex>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tests/support/temporary_folder.h"

namespace mocap {
namespace {

constexpr const char* kAccuracy = "docs/accuracy.md";
constexpr const char* kChoosing = "docs/choosing-cameras.md";

/// Words of a page with figures of another one.
struct Statement {
  std::string page;
  std::string words;  ///< $1, $2 … are what `found` captures.
  std::string found;  ///< A regular expression, in the page that has the figures.
  std::string source = kAccuracy;
};

std::vector<Statement> Statements() {
  return {
      {"README.md",
       "$2 mm mean error over $1 simulated takes with six VGA cameras, $3 mm in the worst take, "
       "$4°",
       R"((\d+) takes: ([\d.]+) mm in the mean \(([\d.]+) mm the worst\).*, ([\d.]+) degrees)"},
      {"README.md", "1 px of error gives $1 mm, 5 px give $2 mm",
       R"(\| error of calibration \[px\] [^#]*?\n\| 1 \| ([\d.]+) \|[^#]*?\n\| 5 \| ([\d.]+) \|)"},
      {"README.md", "of $1 varied simulated people, $2 were never found and $3 only after 0.5 s",
       R"(\n\| 30 Hz \| (\d+) \| (\d+) \| (\d+) \|)"},
      {"README.md", "after $1 s", R"(\*Late\* is more than ([\d.]+) s\s+until found)"},
      {"README.md", "$2 of the $1 are tracked in a wrong pose for a while",
       R"(\n\| 30 Hz \| (\d+) \| \d+ \| \d+ \| \d+ \| (\d+) \|)"},
      {"README.md", "The $1 in wheelchairs have $2 mm in the mean",
       R"((\d+) people roll in\s+a wheelchair, at ([\d.]+) mm in the mean)"},
      {"README.md", "error is $1 mm with four cameras and $2 mm with eight",
       R"(\n\| cameras \| mean mm [^#]*?\n\| 4 \| ([\d.]+) \|[^#]*?\n\| 8 \| ([\d.]+) \|)"},
      {"README.md", "it is $2 mm over $1 takes ($3 mm for the worst person)",
       R"((\d+) takes of several people: ([\d.]+) mm in the mean \(([\d.]+) mm the worst person\))"},
      {"README.md", "version $1, 2026", R"(project\(mocapd VERSION ([\d.]+) )", "CMakeLists.txt"},
      {"CITATION.cff", "version: $1 type:", R"(project\(mocapd VERSION ([\d.]+) )",
       "CMakeLists.txt"},
      {"docs/paper.md", "($2 and $1 mm: [accuracy](accuracy.md))",
       R"(\n\| surface \| ([\d.]+) \|[^\n]*\n\| mikic2003 \| ([\d.]+) \|)"},
      {"docs/getting-started.md", "has the first $1 of them, at 30 and 10 Hz",
       R"(`mocap benchmark --parts variety --seeds (\d+) [^#]*\n\| 30 Hz \|[^\n]*\n\| 10 Hz \|)"},
      {"docs/getting-started.md", "simulated people of $1 to $3 mm",
       R"(\n\| walk \| (\d+) \| 3 \|[^#]*?\n\| walk \| (\d+) \| 3 \|[^#]*?\n\| walk \| (\d+) \| 3 \|)"},
      {kChoosing,
       "with $1 mm in the mean if they face each other and $3 mm at a right angle. Whole takes are "
       "useless ($2 mm and $4 mm)",
       R"(\n\| 2 cameras \| ([\d.]+) \| ([\d.]+) \|[^\n]*\n\| 2 [a-z ]+ \| ([\d.]+) \| ([\d.]+) \|)",
       kChoosing},
      {kChoosing, "still have $1 mm", R"(\n\| all along a quarter of the circle \| ([\d.]+) \|)",
       kChoosing},
      {kChoosing, "in single takes they are: $1 mm at 1.2 m, $2 mm at 1.8 m",
       R"(\n\| 1.2 m high \| [\d.]+ \| ([\d.]+) \|[^\n]*\n\| 1.8 m high \| [\d.]+ \| ([\d.]+) \|)",
       kChoosing},
      {kChoosing,
       "worse in single takes ($2 mm), pixels four times as large are useless ($1 mm in the mean)",
       R"(\n\| 160 × 120 px \| ([\d.]+) \|[^\n]*\n\| 320 × 240 px \| [\d.]+ \| ([\d.]+) \|)",
       kChoosing},
      {kChoosing, "is tracked in a wrong pose ($1 mm)",
       R"(\n\| 1280 × 960 px \| [\d.]+ \| ([\d.]+) \|)", kChoosing},
      {kChoosing, "have $2 mm at 10 Hz and $1 mm at 30 Hz",
       R"(\n\| 30 Hz \|[^\n]* ([\d.]+) \| [\d.]+ \|\n\| 10 Hz \|[^\n]* ([\d.]+) \| [\d.]+ \|)"},
      {kChoosing, "tracking a set takes $1 in one thread",
       R"(\| `TrackSets` 640×480, in one thread \| [^|]* \| ([\d.]+ ms) \|)",
       "docs/experiments/segmentation.md"},
      {kChoosing, "$1 for a silhouette", R"(\| 640 × 480 \| ([\d.]+ kB) \|)", "docs/nodes.md"},
      {kChoosing, "| $1 MB a second, ", R"(\| `huffyuv` \(default\) \| (\d+) \|)",
       "docs/operating.md"},
  };
}

std::string Page(std::string_view name) {
  return testing::ReadText(std::filesystem::path(MOCAP_SOURCE_DIR) / name);
}

/// Lines may break anywhere.
std::string OneLine(const std::string& text) {
  return std::regex_replace(text, std::regex(R"(\s+)"), " ");
}

/// The words with their figures; empty if the source has none.
std::string Stated(const Statement& statement) {
  std::smatch match;
  const std::string source = Page(statement.source);
  if (!std::regex_search(source, match, std::regex(statement.found))) return "";
  return match.format(statement.words);
}

/// What is left of a page without the words whose figures are held by a statement, and without
/// what people type.
std::string WithoutStatements(const std::string& page) {
  std::string text = OneLine(std::regex_replace(Page(page), std::regex("\n    [^\n]*"), "\n"));
  for (const Statement& statement : Statements()) {
    const std::string words = Stated(statement);
    if (statement.page != page || words.empty()) continue;
    if (const std::size_t at = text.find(words); at != std::string::npos) {
      text.erase(at, words.size());
    }
  }
  return text;
}

TEST(StatedFigures, AreThoseOfThePageThatHasThem) {
  for (const Statement& statement : Statements()) {
    const std::string words = Stated(statement);
    ASSERT_NE(words, "") << statement.source << " has nothing like " << statement.found;
    EXPECT_NE(OneLine(Page(statement.page)).find(words), std::string::npos)
        << statement.page << " does not say: " << words;
  }
}

/// The number that a pattern captures in a page.
double NumberIn(std::string_view page, const std::string& pattern) {
  std::smatch match;
  const std::string text = Page(page);
  return std::regex_search(text, match, std::regex(pattern)) ? std::stod(match[1]) : NAN;
}

TEST(StatedFigures, OfRecordingsFollowFromTheFramesOfTheCodec) {
  constexpr double kFrames = 6 * 30;
  constexpr std::string_view kOperating = "docs/operating.md",
                             kTrials = "docs/experiments/recording.md";
  for (const auto& [codec, trial] :
       {std::pair(R"(`raw`)", "raw"),
        std::pair(R"(`huffyuv` \(default\))", R"(HuffYUV \(default\))"),
        std::pair(R"(`ffv1`)", "FFV1")}) {
    const double frame_mb = NumberIn(kTrials, fmt::format(R"(\| {} \| ([\d.]+) \|)", trial));
    const double second_mb = NumberIn(kOperating, fmt::format(R"(\| {} \| (\d+) \|)", codec));
    EXPECT_NEAR(second_mb, kFrames * frame_mb, 1) << codec;
  }
  const double second_gb = 1e-3 * NumberIn(kOperating, R"(`huffyuv` \(default\) \| (\d+) \|)");
  EXPECT_NEAR(NumberIn(kOperating, R"(A minute of these six cameras\s+needs ([\d.]+) GB)"),
              60 * second_gb, 0.05);
  for (const auto& [page, pattern] :
       {std::pair(kOperating, R"(an hour ([\d.]+) GB)"),
        std::pair(std::string_view(kChoosing), R"(second, ([\d.]+) GB an hour)")}) {
    EXPECT_NEAR(NumberIn(page, pattern), 3600 * second_gb, 0.5) << page;
  }
  EXPECT_NEAR(NumberIn(kOperating, R"(1920 × 1080 write\s+about (\d+) MB a second)"),
              1e3 * second_gb * 1920 * 1080 / (640 * 480), 5);
}

TEST(StatedFigures, OfTheThreadCarveAreTheSumOfItsParts) {
  constexpr std::string_view kNodes = "docs/nodes.md", kTrials = "docs/experiments/cameras.md";
  const double few_ms = NumberIn(kTrials, R"(\n\| 24 \| [\d.]+ \| ([\d.]+) \|)") +
                        NumberIn(kTrials, R"(\n\| 24 \| [\d.]+ \| [\d.]+ \| ([\d.]+) \|)");
  const double many_ms = NumberIn(kTrials, R"(Shadows took ([\d.]+) ms with 64)") +
                         NumberIn(kTrials, R"(\n\| 64 \| [\d.]+ \| [\d.]+ \| ([\d.]+) \|)");
  EXPECT_NEAR(NumberIn(kNodes, R"(`carve` ([\d.]+) ms with 24 cameras)"), few_ms, 0.05);
  EXPECT_NEAR(NumberIn(kNodes, R"(and ([\d.]+) ms with 64)"), many_ms, 0.5);
}

TEST(StatedFigures, OfTheReadmeAreAllHeld) {
  const std::string text = WithoutStatements("README.md");
  const std::regex figure(R"((\d[\d.]*) ?(mm|px|°|degrees|ms|s|Hz|%)(?![A-Za-z]))");
  for (std::sregex_iterator match(text.begin(), text.end(), figure), end; match != end; ++match) {
    const auto at = static_cast<std::size_t>(match->position());
    ADD_FAILURE() << "no statement holds: …" << text.substr(std::max<std::size_t>(at, 60) - 60, 90);
  }
}

}  // namespace
}  // namespace mocap
