#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/temporary_folder.h"

namespace mocap {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> Documents() {
  const fs::path root = MOCAP_SOURCE_DIR;
  std::vector<fs::path> documents;
  for (const auto& entry : fs::directory_iterator(root)) {
    if (entry.path().extension() == ".md") documents.push_back(entry.path());
  }
  for (const auto& entry : fs::recursive_directory_iterator(root / "docs")) {
    if (entry.path().extension() == ".md") documents.push_back(entry.path());
  }
  return documents;
}

/// What stands in the round brackets of links and pictures, addresses of the network left out.
std::vector<std::string> RelativeLinksIn(const std::string& text) {
  static const std::regex kLink(R"(\]\(([^)\s]+)\))");
  static const std::regex kAddress(R"(^[a-z]+:)");
  std::vector<std::string> links;
  for (std::sregex_iterator match(text.begin(), text.end(), kLink), end; match != end; ++match) {
    const std::string link = (*match)[1];
    if (!std::regex_search(link, kAddress)) links.push_back(link);
  }
  return links;
}

/// The anchors that Markdown gives to headings: small letters, hyphens for blanks, no punctuation.
/// @param highest  level of the headings: 2 leaves out the title.
std::set<std::string> AnchorsIn(const std::string& text, std::size_t highest = 1) {
  std::set<std::string> anchors;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t level = line.find_first_not_of('#');
    if (level < highest || level == std::string::npos || line[level] != ' ') continue;
    std::string anchor;
    for (const unsigned char letter : line.substr(level + 1)) {
      if (letter == ' ') anchor += '-';
      if (std::isalnum(letter) || letter == '-' || letter == '_' || letter >= 0x80) {
        anchor += static_cast<char>(std::tolower(letter));
      }
    }
    anchors.insert(anchor);
  }
  return anchors;
}

TEST(DocumentLinks, EveryRelativeLinkLeadsToAFileAndItsHeading) {
  int links = 0;
  for (const fs::path& document : Documents()) {
    for (const std::string& link : RelativeLinksIn(testing::ReadText(document))) {
      ++links;
      const std::size_t hash = link.find('#');
      const std::string file = link.substr(0, hash);
      const fs::path target = file.empty() ? document : document.parent_path() / file;
      ASSERT_TRUE(fs::exists(target)) << document << " links to " << link;
      if (hash == std::string::npos || target.extension() != ".md") continue;
      EXPECT_TRUE(AnchorsIn(testing::ReadText(target)).contains(link.substr(hash + 1)))
          << document << " links to " << link;
    }
  }
  EXPECT_GT(links, 0);
}

TEST(DocumentLinks, EveryDecisionIsInTheIndex) {
  const fs::path folder = fs::path(MOCAP_SOURCE_DIR) / "docs/decisions";
  const std::vector<std::string> linked = RelativeLinksIn(testing::ReadText(folder / "README.md"));
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename();
    if (name == "README.md") continue;
    EXPECT_EQ(std::count(linked.begin(), linked.end(), name), 1) << name;
    const std::set<std::string> decisions = AnchorsIn(testing::ReadText(entry.path()), 2);
    EXPECT_FALSE(decisions.empty()) << name;
    for (const std::string& anchor : decisions) {
      const std::string decision = name + '#' + anchor;
      EXPECT_EQ(std::count(linked.begin(), linked.end(), decision), 1) << decision;
    }
  }
}

}  // namespace
}  // namespace mocap
