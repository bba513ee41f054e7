#include "tools/witness.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

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
  CLI::App* command =
      app.add_subcommand("witness", "Find points of the people in a take by a neural network");
  // All words are that program's, --help too.
  command->prefix_command();
  command->set_help_flag();
  command->callback([command] { BecomeWitness(command->remaining()); });
}

}  // namespace mocap
