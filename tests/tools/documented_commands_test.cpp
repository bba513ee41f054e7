// The commands of the pages, run as they are written, where they need no device, no running daemon
// and no patience.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "config/load_config.h"
#include "core/errors.h"
#include "tests/support/temporary_folder.h"

namespace mocap {
namespace {

namespace fs = std::filesystem;

struct Unrun {
  std::string_view beginning;
  std::string_view reason;
};

/// Commands that only tests of their own, or people, can run.
constexpr std::array kUnrun = {
    Unrun{"mocapd --config", "runs until it is ended"},
    Unrun{"mocap view", "runs until it is ended"},
    Unrun{"mocap gige-studio", "runs until it is ended, as root"},
    Unrun{"mocap stream", "waits for a daemon"},
    Unrun{"mocap watch", "waits for a daemon"},
    Unrun{"mocap status", "asks a daemon"},
    Unrun{"mocap record", "asks a daemon"},
    Unrun{"mocap subject", "asks a daemon"},
    Unrun{"mocap reload", "asks a daemon"},
    Unrun{"mocap background", "asks a daemon, or needs cameras"},
    Unrun{"mocap doctor", "judges the machine that it runs on"},
    Unrun{"mocap cameras", "needs cameras"},
    Unrun{"mocap calibrate studio", "needs minutes, or cameras"},
    Unrun{"mocap calibrate check", "needs a calibration that a person made"},
    Unrun{"mocap calibrate health", "needs a calibration that a person made"},
    Unrun{"mocap calibrate refine", "needs a calibration that a person made"},
    Unrun{"mocap simulate --board", "is of use to `mocap calibrate` only"},
    Unrun{"mocap calibrate intrinsics carried", "needs videos of phones"},
    Unrun{"mocap calibrate extrinsics lying", "needs videos of phones"},
    Unrun{"mocap take import", "needs videos of phones"},
    Unrun{"mocap solve phones", "needs videos of phones"},
    Unrun{"mocap export filmed", "needs videos of phones"},
    Unrun{"mocap gait filmed", "needs videos of phones"},
    Unrun{"mocap export session.lcm", "needs a log of a daemon"},
    Unrun{"mocap witness", "needs a pose network"},
    Unrun{"mocap track walk --out result --keypoints", "needs a pose network"},
};

struct Command {
  fs::path page;
  std::string line;
};

std::vector<fs::path> Pages() {
  const fs::path root = MOCAP_SOURCE_DIR;
  std::vector<fs::path> pages = {root / "README.md"};
  for (const auto& entry : fs::directory_iterator(root / "docs")) {
    if (entry.path().extension() == ".md") pages.push_back(entry.path());
  }
  std::ranges::sort(pages);
  return pages;
}

/// Indented lines that begin with one of the programs, without what a comment says of them.
std::vector<Command> DocumentedCommands() {
  static const std::regex kCommand(R"(^ {4,}(mocapd? [^#]*[^# ]))");
  std::vector<Command> commands;
  for (const fs::path& page : Pages()) {
    std::istringstream lines(testing::ReadText(page));
    std::smatch match;
    for (std::string line; std::getline(lines, line);) {
      if (std::regex_search(line, match, kCommand)) commands.push_back({page, match[1]});
    }
  }
  return commands;
}

const Unrun* ReasonNotToRun(const std::string& line) {
  const auto found = std::ranges::find_if(
      kUnrun, [&line](const Unrun& unrun) { return line.starts_with(unrun.beginning); });
  return found == kUnrun.end() ? nullptr : &*found;
}

/// Takes of a second show what longer ones do.
std::string Shortened(const std::string& line) {
  if (!line.starts_with("mocap simulate ")) return line;
  return std::regex_replace(line, std::regex(R"( --seconds \S+)"), "") + " --seconds 1";
}

/// What a command says that it leaves, as "walk.bvh" or "result"; empty: nothing.
std::string OutputOf(const std::string& line) {
  std::smatch match;
  return std::regex_search(line, match, std::regex(R"( --(?:out|report) (\S+))")) ? match[1].str()
                                                                                  : "";
}

/// Of several people, a file has a person's number in its name.
bool IsThere(const fs::path& output) {
  return std::ranges::any_of(fs::directory_iterator(output.parent_path()), [&](const auto& entry) {
    const std::string name = entry.path().filename();
    return name.starts_with(output.stem().string()) && name.ends_with(output.extension().string());
  });
}

TEST(DocumentedCommands, ThatRecordMessagesRecordThoseOfEveryPrefix) {
  static const std::regex kLogger(R"(lcm-logger --channel='([^']*)')");
  std::vector<fs::path> files = Pages();
  files.push_back(fs::path(MOCAP_SOURCE_DIR) / "tools" / "demo");
  int found = 0;
  for (const fs::path& file : files) {
    const std::string text = testing::ReadText(file);
    for (std::sregex_iterator logger(text.begin(), text.end(), kLogger), end; logger != end;
         ++logger, ++found) {
      for (const char* channel : {"MOCAP_POSE", "left.MOCAP_POSE", "hall.left_MOCAP_STATUS"})
        EXPECT_TRUE(std::regex_match(channel, std::regex((*logger)[1].str()))) << file << channel;
    }
  }
  EXPECT_EQ(found, 2);
}

TEST(DocumentedCommands, ThatNeedNothingElseDoWhatTheySay) {
  const testing::TemporaryFolder temporary;
  int run = 0;
  for (const auto& [page, line] : DocumentedCommands()) {
    if (ReasonNotToRun(line) != nullptr) continue;
    const fs::path folder = temporary.path() / page.stem();
    fs::create_directories(folder);
    const std::string shell_line = "cd " + folder.string() +
                                   " && PATH=" MOCAP_BIN_DIR ":$PATH && " + Shortened(line) +
                                   " >said 2>&1";
    ASSERT_EQ(std::system(shell_line.c_str()), 0) << page << ": " << line << "\n"
                                                  << testing::ReadText(folder / "said");
    if (const std::string output = OutputOf(line); !output.empty()) {
      EXPECT_TRUE(IsThere(folder / output)) << page << ": " << line;
    }
    ++run;
  }
  EXPECT_GE(run, 8);
}

TEST(DocumentedCommands, EveryReasonNotToRunOneIsNeeded) {
  std::set<std::string_view> needed;
  for (const Command& command : DocumentedCommands()) {
    if (const Unrun* unrun = ReasonNotToRun(command.line)) needed.insert(unrun->beginning);
  }
  for (const Unrun& unrun : kUnrun)
    EXPECT_TRUE(needed.contains(unrun.beginning)) << unrun.beginning;
}

/// Lines of TOML that follow each other: tables and keys.
std::vector<std::string> Configurations(const std::string& page) {
  static const std::regex kToml(R"(^ *(\[+[a-z_]+\]+|[a-z_]+ = .*)$)");
  std::vector<std::string> found(1);
  std::istringstream lines(page);
  std::smatch match;
  for (std::string line; std::getline(lines, line);) {
    if (std::regex_search(line, match, kToml)) {
      found.back() += match[1].str() + '\n';
    } else if (!line.empty() && !found.back().empty()) {
      found.emplace_back();
    }
  }
  std::erase_if(found,
                [](const std::string& text) { return text.find("[source]") == std::string::npos; });
  return found;
}

TEST(DocumentedCommands, ConfigurationsOfThePagesAreRead) {
  const testing::TemporaryFolder folder;
  const fs::path file = folder.path() / "studio.toml";
  int read = 0;
  for (const fs::path& page : Pages()) {
    for (const std::string& text : Configurations(testing::ReadText(page))) {
      testing::WriteText(file, text);
      try {
        LoadConfig(file);
        ++read;
      } catch (const SetupError& error) {
        ADD_FAILURE() << page << ": " << error.what() << "\n" << text;
      }
    }
  }
  EXPECT_GE(read, 5);
}

}  // namespace
}  // namespace mocap
