// docs/man/mocap.1 against the program: every command is explained.
#include <gtest/gtest.h>

#include <regex>
#include <string>
#include <vector>

#include "tests/support/temporary_folder.h"
#include "tools/commands.h"

namespace mocap {
namespace {

/// "record start", "record stop" and all others.
std::vector<std::string> CommandsOf(const CLI::App& app, const std::string& prefix) {
  std::vector<std::string> commands;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    const std::string name = prefix + command->get_name();
    const std::vector<std::string> below = CommandsOf(*command, name + ' ');
    commands.insert(commands.end(), below.begin(), below.end());
    if (below.empty()) commands.push_back(name);
  }
  return commands;
}

TEST(ManualPage, ExplainsEveryCommand) {
  const std::string page =
      testing::ReadText(std::filesystem::path(MOCAP_SOURCE_DIR) / "docs/man/mocap.1");
  CLI::App app;
  AddCommands(app);
  const std::vector<std::string> commands = CommandsOf(app, "");
  EXPECT_GT(commands.size(), 20u);
  for (const std::string& command : commands) {
    const std::regex explained(R"(\.It .*Ic )" + command + R"(( |\n))");
    EXPECT_TRUE(std::regex_search(page, explained)) << "mocap " << command;
  }
}

}  // namespace
}  // namespace mocap
