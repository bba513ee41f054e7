#include "daemon/run_program.h"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <new>
#include <string>

#include "core/errors.h"
#include "drivers/printable_text.h"

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

/// The program with the subcommand that was begun, as one would type it.
std::string CommandOf(const CLI::App& app) {
  std::string command = app.get_name();
  for (const CLI::App* subcommand : app.get_subcommands()) command += " " + subcommand->get_name();
  return command;
}

}  // namespace

int RunProgram(CLI::App& app, int argc, char** argv) {
  try {
    app.parse(argc, argv);
    return 0;
  } catch (const CLI::Success& help_or_version) {
    return app.exit(help_or_version);
  } catch (const CLI::ParseError& error) {
    return Fail(app, std::string(error.what()) + "; see " + CommandOf(app) + " --help",
                kWrongInput);
  } catch (const SetupError& error) {
    return Fail(app, error.what(), kWrongInput);
  } catch (const std::bad_alloc&) {
    return Fail(app,
                "there is not enough memory: smaller pictures, fewer cameras or larger voxels are "
                "wanted",
                kFailed);
  } catch (const std::exception& error) {
    return Fail(app, error.what(), kFailed);
  }
}

}  // namespace mocap
