#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace mocap {
namespace {

namespace fs = std::filesystem;

// The folders that a folder may include from.
const std::map<std::string, std::set<std::string>> kDoors = {
    {"core", {"core"}},
    {"drivers", {"core", "drivers"}},
    {"config", {"core", "drivers", "config"}},
    {"daemon", {"core", "drivers", "config", "daemon"}},
    {"tools", {"core", "drivers", "config", "daemon", "tools"}}};

// Inside a folder: the rooms that a room may include from, besides itself. A folder's own files
// serve as its front ("."), or lie below its rooms.
const std::map<std::string, std::map<std::string, std::set<std::string>>> kInnerDoors = {
    {"core",
     {{"kernels", {}},
      {"body", {"kernels"}},
      {"reconstruction", {"kernels"}},
      {"calibration", {"reconstruction"}},
      {"evidence", {"body", "kernels", "reconstruction"}},
      {"objective", {"body", "evidence", "kernels", "reconstruction"}},
      {"hypotheses", {"body", "evidence", "kernels", "objective"}},
      {"proposals", {"body", "evidence", "hypotheses", "objective", "reconstruction"}},
      {"mikic2003", {"body", "reconstruction"}},
      {"evaluation", {"body"}},
      {"people", {"body", "evidence", "objective", "reconstruction"}},
      {"solving",
       {"body", "evidence", "hypotheses", "objective", "people", "proposals", "reconstruction"}}}},
    {"drivers",
     {{"pixels", {}},
      {"usb", {}},
      {"take", {}},
      {"virtual_studio", {"take"}},
      {"simulation", {"take", "virtual_studio"}},
      {"v4l2", {"pixels"}},
      {"aravis", {"pixels", "usb"}}}},
    {"daemon",
     {{"base", {}},
      {"pipeline", {}},
      {"control", {"base"}},
      {"recording", {"base", "pipeline"}},
      {"status", {"base", "pipeline", "recording"}},
      {"messages", {"base", "pipeline", "status"}},
      {"nodes", {"messages", "pipeline", "status"}},
      {"service", {"base", "control", "messages", "nodes", "pipeline", "recording", "status"}}}}};

struct Include {
  fs::path file;
  std::string header;
  bool in_quotes;
};

std::vector<fs::path> SourcesUnder(const std::string& folder,
                                   const std::set<std::string>& extensions) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(fs::path(MOCAP_SOURCE_DIR) / folder)) {
    if (extensions.contains(entry.path().extension())) files.push_back(entry.path());
  }
  return files;
}

std::vector<Include> IncludesUnder(const std::string& folder) {
  static const std::regex kInclude(R"(^\s*#include\s*([<"])([^>"]+)[>"])");
  std::vector<Include> includes;
  for (const fs::path& file : SourcesUnder(folder, {".h", ".cpp"})) {
    std::ifstream in(file);
    std::smatch match;
    for (std::string line; std::getline(in, line);) {
      if (std::regex_search(line, match, kInclude))
        includes.push_back({file, match[2], match[1] == "\""});
    }
  }
  return includes;
}

/// With their namespaces.
std::vector<std::string> TypesDefinedIn(const fs::path& header) {
  static const std::regex kNamespace(R"(^namespace ([\w:]+) \{)");
  static const std::regex kType(R"(^(?:struct|class|enum class) (\w+)(?: final)?(?: :.*)? \{)");
  std::ifstream in(header);
  std::vector<std::string> types;
  std::string scope;
  std::smatch match;
  for (std::string line; std::getline(in, line);) {
    if (std::regex_search(line, match, kNamespace)) scope = match[1];
    if (std::regex_search(line, match, kType)) types.push_back(scope + "::" + match[1].str());
  }
  return types;
}

TEST(SourceLayout, FoldersIncludeOnlyThroughTheirDoors) {
  for (const auto& [folder, doors] : kDoors) {
    const std::vector<Include> includes = IncludesUnder(folder);
    ASSERT_FALSE(includes.empty()) << folder;
    for (const Include& include : includes) {
      if (!include.in_quotes) continue;
      const std::string from = include.header.substr(0, include.header.find('/'));
      EXPECT_TRUE(doors.contains(from)) << include.file << " includes " << include.header;
    }
  }
}

TEST(SourceLayout, RoomsIncludeOnlyWhatLiesBelowThem) {
  for (const auto& [folder, rooms] : kInnerDoors) {
    for (const auto& [room, doors] : rooms) {
      const std::vector<Include> includes = IncludesUnder(folder + "/" + room);
      ASSERT_FALSE(includes.empty()) << folder << "/" << room;
      for (const Include& include : includes) {
        const fs::path header = include.header;
        const auto depth = std::distance(header.begin(), header.end());
        if (!include.in_quotes || *header.begin() != folder || depth < 3) continue;
        const std::string from = *std::next(header.begin());
        EXPECT_TRUE(from == room || doors.contains(from))
            << include.file << " includes " << include.header;
      }
    }
  }
}

/// For each folder that includes from another folder of the same parent: which ones.
std::map<fs::path, std::set<fs::path>> IncludesBetweenSiblings() {
  std::map<fs::path, std::set<fs::path>> included;
  for (const auto& [folder, doors] : kDoors) {
    for (const Include& include : IncludesUnder(folder)) {
      if (!include.in_quotes) continue;
      const fs::path from = fs::relative(include.file, MOCAP_SOURCE_DIR).parent_path();
      const fs::path to = fs::path(include.header).parent_path();
      const auto [a, b] = std::mismatch(from.begin(), from.end(), to.begin(), to.end());
      if (a == from.begin() || a == from.end() || b == to.end()) continue;
      fs::path parent;
      for (auto name = from.begin(); name != a; ++name) parent /= *name;
      included[parent / *a].insert(parent / *b);
    }
  }
  return included;
}

/// Everything that is included by `folder`, by what that includes, and so on.
std::set<fs::path> ReachedFrom(const fs::path& folder,
                               const std::map<fs::path, std::set<fs::path>>& included) {
  std::set<fs::path> reached;
  std::vector<fs::path> next = {folder};
  while (!next.empty()) {
    const auto includes = included.find(next.back());
    next.pop_back();
    if (includes == included.end()) continue;
    for (const fs::path& other : includes->second)
      if (reached.insert(other).second) next.push_back(other);
  }
  return reached;
}

TEST(SourceLayout, FoldersOfOneFolderDoNotIncludeEachOtherInACircle) {
  const auto included = IncludesBetweenSiblings();
  EXPECT_TRUE(included.contains("core/reconstruction/silhouette")) << "circles deep down count too";
  for (const auto& [folder, others] : included) {
    for (const fs::path& other : others) {
      EXPECT_FALSE(ReachedFrom(other, included).contains(folder))
          << folder << " includes " << other << ", and the other way round";
    }
  }
}

TEST(SourceLayout, CoreKnowsEigenAndTheLanguageAndItsKernelsHighwayButNoThreadsClocksFilesOrLogs) {
  const std::set<std::string> kBarred = {"thread",  "mutex",    "chrono", "condition_variable",
                                         "fstream", "iostream", "future", "filesystem",
                                         "ctime",   "random"};
  for (const Include& include : IncludesUnder("core")) {
    if (include.in_quotes) continue;
    EXPECT_FALSE(kBarred.contains(include.header)) << include.file << ": " << include.header;
    const bool is_of_the_language = include.header.find('/') == std::string::npos;
    // Vectors stay behind the kernels' door.
    const bool is_highway =
        include.header.starts_with("hwy/") && include.file.parent_path().filename() == "kernels";
    EXPECT_TRUE(is_of_the_language || include.header.starts_with("Eigen/") || is_highway)
        << include.file;
  }
}

// Clang 14, which builds the fuzzers on Debian 12, cannot compile the views of GCC 12's library.
TEST(SourceLayout, NoFileIncludesRanges) {
  for (const auto& [folder, doors] : kDoors) {
    for (const Include& include : IncludesUnder(folder)) {
      EXPECT_NE(include.header, "ranges") << include.file;
    }
  }
}

// Where two do, the linker keeps the destructor of one for the objects of both, and says nothing.
TEST(SourceLayout, NoTwoHeadersDefineATypeOfTheSameName) {
  std::map<std::string, fs::path> defined;
  for (const auto& [folder, doors] : kDoors) {
    for (const fs::path& header : SourcesUnder(folder, {".h"})) {
      for (const std::string& type : TypesDefinedIn(header)) {
        const auto [first, is_new] = defined.emplace(type, header);
        EXPECT_TRUE(is_new) << type << " is in " << first->second << " and in " << header;
      }
    }
  }
  EXPECT_TRUE(defined.contains("mocap::Frame"));
}

/// Files with a line that matches the pattern, relative to the sources.
std::set<fs::path> FilesWith(const std::regex& pattern) {
  std::set<fs::path> files;
  for (const auto& [folder, doors] : kDoors) {
    for (const fs::path& file : SourcesUnder(folder, {".h", ".cpp"})) {
      std::ifstream in(file);
      for (std::string line; std::getline(in, line);) {
        if (std::regex_search(line, pattern)) files.insert(fs::relative(file, MOCAP_SOURCE_DIR));
      }
    }
  }
  return files;
}

TEST(SourceLayout, OneHeaderConvertsDegrees) {
  EXPECT_EQ(
      FilesWith(std::regex(R"(\b180(\.0)? / (std::numbers::pi|EIGEN_PI)|(pi|PI) / 180\b|57\.29)")),
      (std::set<fs::path>{"core/degrees.h"}));
}

// A question leaves people without a remedy; only a misspelt name is guessed at ("did you mean").
TEST(SourceLayout, MessagesStateAndDoNotAsk) {
  EXPECT_EQ(FilesWith(std::regex(R"([a-z)]\?(\\n)?"|[a-z)]\? [A-Z][a-z]+ [^.]*")")),
            std::set<fs::path>{});
}

// JSON and TOML write lists of their own.
TEST(SourceLayout, OneFunctionListsNames) {
  EXPECT_EQ(FilesWith(std::regex(R"(empty\(\) \? "" : ", "\) \+ (?!TomlText|InQuotes|object))")),
            (std::set<fs::path>{"drivers/nearest_name.cpp"}));
}

}  // namespace
}  // namespace mocap
