#include "tools/witness.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "tools/witness_options.h"

namespace mocap {
namespace {

constexpr const char* kProgram = "mocap-witness";

/// Beside this program; otherwise where the shell would find it.
std::string WitnessProgram() {
  std::error_code unknown;
  const std::filesystem::path own = std::filesystem::read_symlink("/proc/self/exe", unknown);
  const std::filesystem::path beside = own.parent_path() / kProgram;
  return access(beside.c_str(), X_OK) == 0 ? beside.string() : kProgram;
}

/// The options and the positional word that a command was given.
std::vector<std::string> WordsOf(const CLI::App& command) {
  std::vector<std::string> options, positional = {"--"};
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& value : option->results()) {
      if (option->get_positional()) {
        positional.push_back(value);
      } else {
        options.push_back("--" + option->get_lnames().front() + "=" + value);
      }
    }
  }
  options.insert(options.end(), positional.begin(), positional.end());
  return options;
}

[[noreturn]] void BecomeWitness(const std::vector<std::string>& words) {
  std::vector<std::string> command = {WitnessProgram()};
  command.insert(command.end(), words.begin(), words.end());
  std::vector<char*> arguments;
  for (std::string& word : command) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  execvp(arguments.front(), arguments.data());
  if (errno == ENOENT)
    throw std::runtime_error(std::string(kProgram) +
                             " is not installed; it is in the Debian package mocapd-witness");
  throw std::runtime_error(command.front() + ": cannot be run: " + std::strerror(errno));
}

}  // namespace

void AddWitnessCommand(CLI::App& app) {
  auto options = std::make_shared<WitnessOptions>();
  CLI::App* command =
      app.add_subcommand("witness", "Find points of people by a neural network, live or in a take");
  AddWitnessOptions(*command, *options);
  // They are the program's; here they are checked, and explained where it is not installed.
  command->callback([command, options] { BecomeWitness(WordsOf(*command)); });
}

}  // namespace mocap
