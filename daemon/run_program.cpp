#include "daemon/run_program.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <iostream>
#include <new>
#include <string>
#include <vector>

#include "core/errors.h"
#include "drivers/nearest_name.h"
#include "drivers/printable_text.h"
#include "drivers/quoted.h"

namespace mocap {
namespace {

constexpr int kFailed = 1;
constexpr int kWrongInput = 2;

int Fail(const CLI::App& app, std::string message, int status) {
  std::ranges::replace(message, '\n', ' ');
  std::fflush(stdout);
  std::fprintf(stderr, "%s: %s\n", app.get_name().c_str(), Printable(message).c_str());
  return status;
}

std::vector<std::string> CommandNames(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* one : app.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(one->get_name());
  return names;
}

std::vector<std::string> OptionNames(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

/// Names a word that a command does not know, and the command or option that it resembles.
std::string UnknownWord(const CLI::App& app, const std::string& word) {
  if (word.starts_with('-')) {
    const std::string option = word.substr(0, word.find('='));
    const std::string guess = WithNearestName(option, OptionNames(app), "");
    return "there is no option " + option + (guess.empty() ? "" : "; " + guess);
  }
  const std::vector<std::string> commands = CommandNames(app);
  if (commands.empty()) return Quoted(word) + " was not expected";
  return "there is no command " + Quoted(word) + "; " + ExpectedNames(word, commands);
}

/// What is wrong with a part of a command line; empty: nothing. Words that no command knows come
/// first, since they explain the rest.
std::string FaultOf(const CLI::App& app, const CLI::ParseError& error) {
  const std::vector<std::string> words = app.remaining();
  const auto word = std::ranges::find_if(words, [](const auto& one) { return one != "--"; });
  if (word != words.end()) return UnknownWord(app, *word);
  if (!app.get_subcommands().empty()) return {};
  if (app.get_require_subcommand_min() > 0)
    return "a command is missing; " + ExpectedNames("", CommandNames(app));
  return error.what();
}

/// What is wrong with a command line, and which help to read.
std::string WhatIsWrong(const CLI::App& program, const CLI::ParseError& error) {
  const CLI::App* app = &program;
  std::string command = program.get_name();
  std::string fault = FaultOf(*app, error);
  while (fault.empty() && !app->get_subcommands().empty()) {
    app = app->get_subcommands().front();
    command += " " + app->get_name();
    fault = FaultOf(*app, error);
  }
  return fault + (fault.ends_with('?') ? " See " : "; see ") + command + " --help";
}

/// Opens /dev/null for each standard file that was closed. Otherwise a file opened later would get
/// its number, and with it the printed output.
void OpenStandardFiles() {
  for (const int file : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    // open() returns the lowest free number, which is this one.
    if (fcntl(file, F_GETFD) < 0 && open("/dev/null", O_RDWR) < 0) return;
  }
}

/// Output that did not arrive is a failure.
int FinishOutput(const CLI::App& app) {
  std::cout.flush();
  errno = 0;
  const bool is_written = std::fflush(stdout) == 0 && std::ferror(stdout) == 0 && std::cout.good();
  if (is_written || errno == EPIPE) return 0;
  const std::string why = errno == 0 ? "" : std::string(": ") + std::strerror(errno);
  return Fail(app, "standard output cannot be written" + why, kFailed);
}

}  // namespace

int RunProgram(CLI::App& app, int argc, char** argv) {
  OpenStandardFiles();
  try {
    app.parse(argc, argv);
    return FinishOutput(app);
  } catch (const CLI::Success& help_or_version) {
    const int status = app.exit(help_or_version);
    return status == 0 ? FinishOutput(app) : status;
  } catch (const CLI::ParseError& error) {
    return Fail(app, WhatIsWrong(app, error), kWrongInput);
  } catch (const SetupError& error) {
    return Fail(app, error.what(), kWrongInput);
  } catch (const std::bad_alloc&) {
    return Fail(app,
                "there is not enough memory; use smaller pictures, fewer cameras or larger voxels",
                kFailed);
  } catch (const std::exception& error) {
    return Fail(app, error.what(), kFailed);
  }
}

}  // namespace mocap
