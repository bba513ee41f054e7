// What messages tell people to type, tried on the program.
#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <cctype>
#include <filesystem>
#include <functional>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/temporary_folder.h"
#include "tools/commands.h"

namespace mocap {
namespace {

namespace fs = std::filesystem;

/// Texts of a source file. Literals that follow each other are one text.
std::vector<std::string> LiteralsIn(const std::string& source) {
  std::vector<std::string> texts;
  bool continues = false;
  for (std::size_t i = 0; i < source.size(); ++i) {
    if (source.compare(i, 2, "//") == 0) {
      i = std::min(source.find('\n', i), source.size());
    } else if (source[i] == '\'' && i > 0 && std::isalnum(source[i - 1]) == 0) {
      i += source[i + 1] == '\\' ? 3 : 2;
    } else if (source[i] == '"') {
      if (!continues) texts.emplace_back();
      for (++i; i < source.size() && source[i] != '"'; ++i) {
        const bool is_escaped = source[i] == '\\';
        if (is_escaped) ++i;
        texts.back() += is_escaped && source[i] == 'n' ? '\n' : source[i];
      }
      continues = true;
    } else if (std::isspace(source[i]) == 0) {
      continues = false;
    }
  }
  return texts;
}

/// Commands in a document: indented lines, and what stands in backquotes.
std::vector<std::string> CommandsIn(const std::string& document) {
  std::vector<std::string> commands;
  for (const std::string& mark : {std::string("\n    mocap "), std::string("`mocap ")}) {
    for (std::size_t at = document.find(mark); at != std::string::npos;
         at = document.find(mark, at + 1)) {
      const std::size_t begin = at + mark.find('m');
      commands.push_back(document.substr(begin, document.find_first_of("#`|\n", begin) - begin));
    }
  }
  return commands;
}

/// Everything that the programs, the Python package and the manual say.
std::vector<std::string> AllTexts() {
  std::vector<std::string> texts;
  for (const char* folder : {"config", "core", "daemon", "drivers", "tools"}) {
    for (const auto& entry :
         fs::recursive_directory_iterator(fs::path(MOCAP_SOURCE_DIR) / folder)) {
      const std::string kind = entry.path().extension();
      if (kind == ".cpp" || kind == ".h") {
        const std::vector<std::string> some = LiteralsIn(testing::ReadText(entry.path()));
        texts.insert(texts.end(), some.begin(), some.end());
      } else if (kind == ".py") {
        texts.push_back(testing::ReadText(entry.path()));
      }
    }
  }
  for (const auto& entry : fs::directory_iterator(fs::path(MOCAP_SOURCE_DIR) / "docs")) {
    if (entry.path().extension() != ".md") continue;
    const std::vector<std::string> some = CommandsIn(testing::ReadText(entry.path()));
    texts.insert(texts.end(), some.begin(), some.end());
  }
  return texts;
}

/// The words from a place to the end of what may be typed.
std::vector<std::string> WordsFrom(const std::string& text, std::size_t begin) {
  const std::size_t end = std::min(text.find_first_of(";,:)`'\"\n{%|<", begin), text.size());
  std::istringstream words(text.substr(begin, end - begin));
  return {std::istream_iterator<std::string>(words), {}};
}

/// What is wrong with a command in a text, whose words follow "mocap"; empty: nothing.
std::string FaultOf(CLI::App& program, const std::vector<std::string>& words) {
  const CLI::App* command = &program;
  std::size_t next = 0;
  while (next < words.size()) {
    const auto inner = command->get_subcommands(
        [&](const CLI::App* one) { return one->get_name() == words[next]; });
    if (inner.empty()) break;
    command = inner.front();
    ++next;
  }
  if (next == 0) return "there is no such command";
  if (next < words.size() && command->get_require_subcommand_min() > 0)
    return "a command is missing after " + command->get_name();
  for (; next < words.size(); ++next) {
    if (words[next].starts_with("--") && !command->get_option_no_throw(words[next]))
      return command->get_name() + " has no " + words[next];
  }
  return "";
}

TEST(Hints, EveryCommandThatAMessageNamesExistsWithItsOptions) {
  CLI::App program("", "mocap");
  AddCommands(program);
  const std::string name = "mocap ";
  int commands = 0;
  for (const std::string& text : AllTexts()) {
    for (std::size_t at = text.find(name); at != std::string::npos; at = text.find(name, at + 1)) {
      const bool is_word = at == 0 || std::isalnum(text[at - 1]) == 0;
      const std::vector<std::string> words = WordsFrom(text, at + name.size());
      if (!is_word || words.empty() || std::islower(words[0][0]) == 0) continue;
      EXPECT_EQ(FaultOf(program, words), "") << text.substr(at, 200);
      ++commands;
    }
  }
  EXPECT_GT(commands, 30);
}

void ForEachCommand(const CLI::App& command, const std::function<void(const CLI::App&)>& call) {
  call(command);
  for (const CLI::App* inner : command.get_subcommands([](const CLI::App*) { return true; }))
    ForEachCommand(*inner, call);
}

TEST(Hints, EveryOptionThatAMessageNamesIsOneOfSomeCommand) {
  CLI::App program("", "mocap");
  AddCommands(program);
  std::set<std::string> known = {"--check-config", "--version",        // Of mocapd.
                                 "--loglevel", "--pack-destination"};  // Of npm.
  ForEachCommand(program, [&known](const CLI::App& command) {
    for (const CLI::Option* option : command.get_options()) {
      for (const std::string& one : option->get_lnames()) known.insert("--" + one);
    }
  });
  int options = 0;
  for (const std::string& text : AllTexts()) {
    std::istringstream words(text);
    for (std::string word; words >> word;) {
      if (!word.starts_with("--") || word.size() < 4 || std::islower(word[2]) == 0) continue;
      const std::size_t end = word.find_first_not_of("abcdefghijklmnopqrstuvwxyz-", 2);
      EXPECT_TRUE(known.contains(word.substr(0, end))) << word << " in: " << text.substr(0, 200);
      ++options;
    }
  }
  EXPECT_GT(options, 100);
}

TEST(Hints, WhatCannotBeTypedIsFound) {
  CLI::App program("", "mocap");
  AddCommands(program);
  EXPECT_EQ(LiteralsIn("f(\"a \" // \"x\"\n  \"\\\"b\" , 'c', '\"', \"d\")"),
            (std::vector<std::string>{"a \"b", "d"}));
  EXPECT_EQ(FaultOf(program, {"learn"}), "there is no such command");
  EXPECT_EQ(FaultOf(program, {"background", "lern"}), "a command is missing after background");
  EXPECT_EQ(FaultOf(program, {"track", "TAKE", "--first-frame"}), "track has no --first-frame");
  EXPECT_EQ(FaultOf(program, {"background", "learn", "--anyway"}), "");
}

}  // namespace
}  // namespace mocap
