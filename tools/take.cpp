#include "tools/take.h"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <vector>

#include "drivers/printable_text.h"
#include "tools/stop_on_signals.h"
#include "tools/take_import.h"
#include "tools/take_join.h"

namespace mocap {
namespace {

struct JoinOptions {
  std::vector<std::filesystem::path> takes;
  std::filesystem::path out;
};

void Join(const JoinOptions& options) {
  StopOnSignals();
  const JoinedTake joined = JoinTakes(options.takes, options.out);
  fmt::print("{}, {:.1f} s with all of them, {:.1f} s in all: {}\n",
             Counted(joined.cameras, "camera"), static_cast<double>(joined.common_ns) / 1e9,
             static_cast<double>(joined.all_ns) / 1e9, Printable(options.out.string()));
}

}  // namespace

void AddTakeCommand(CLI::App& app) {
  CLI::App* take = app.add_subcommand("take", "Manage recorded takes");
  take->require_subcommand(1);
  CLI::App* join = take->add_subcommand(
      "join", "Join takes that several computers recorded with their own cameras at the same time");
  auto options = std::make_shared<JoinOptions>();
  join->add_option("TAKE", options->takes, "take folders, two or more")
      ->required()
      ->expected(2, -1);
  join->add_option("--out", options->out, "output take folder")->required();
  join->callback([options] { Join(*options); });
  AddTakeImportCommand(take);
}

}  // namespace mocap
