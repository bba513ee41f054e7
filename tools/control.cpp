#include "tools/control.h"

#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include "config/load_config.h"
#include "core/errors.h"
#include "daemon/base/number_option.h"
#include "daemon/control/control_request.h"
#include "daemon/control/control_socket.h"
#include "drivers/printable_text.h"
#include "tools/chosen_config.h"

namespace mocap {
namespace {

/// Prints what was done before a failure.
/// @return  what failed.
std::string PrintDone(const std::string& text) {
  const std::size_t begin = text.rfind('\n') + 1;
  std::fputs(PrintableLines(text.substr(0, begin)).c_str(), stdout);
  return text.substr(begin);
}

/// Where the daemon of a configuration listens; empty for the system's, which systemd decides.
std::filesystem::path SocketOf(const std::filesystem::path& config) {
  const std::filesystem::path configured = LoadConfig(config).service.control.socket;
  std::error_code error;
  if (configured.empty() && std::filesystem::equivalent(config, SystemConfig(), error)) return "";
  const std::filesystem::path socket = ControlSocketOf(configured);
  if (!socket.empty()) return socket;
  throw SetupError(config.string() +
                   ": has no control.socket, and XDG_RUNTIME_DIR is not set; expected one of them");
}

/// Subcommands that send one request each.
class RequestCommands {
 public:
  /// @param socket  the daemon's socket; set when the command line is parsed.
  explicit RequestCommands(std::shared_ptr<std::filesystem::path> socket)
      : socket_(std::move(socket)) {}

  CLI::App* Add(CLI::App& app, const std::string& name, const std::string& help,
                const std::string& request) const {
    CLI::App* command = app.add_subcommand(name, help);
    AddSocket(*command);
    command->callback([socket = socket_, request] { AskAndPrint(*socket, request); });
    return command;
  }

  /// @param more  text that follows the name in the request.
  CLI::App* AddNamed(
      CLI::App& app, const std::string& name, const std::string& help, const std::string& request,
      const std::function<std::string()>& more = [] { return ""; }) const {
    CLI::App* command = app.add_subcommand(name, help);
    AddSocket(*command);
    auto file_name = std::make_shared<std::string>();
    command->add_option("NAME", *file_name, "name: letters, digits, `.`, `_` and `-`")
        ->required()
        ->check([](const std::string& text) {
          return IsFileName(text) ? ""
                                  : "\"" + text +
                                        "\" is not a valid name; expected letters, digits, . _ -, "
                                        "and no .partial at its end";
        });
    command->callback([socket = socket_, request, file_name, more] {
      AskAndPrint(*socket, request + ' ' + *file_name + more());
    });
    return command;
  }

  void AddSocket(CLI::App& command) const {
    CLI::Option* socket = command.add_option(
        "--socket", *socket_, "mocapd control socket (default: the system's, else the user's own)");
    command
        .add_option_function<std::string>(
            "--config", [socket = socket_](const std::string& file) { *socket = SocketOf(file); },
            "configuration of the mocapd to ask")
        ->excludes(socket);
  }

 private:
  std::shared_ptr<std::filesystem::path> socket_;
};

}  // namespace

void AskAndPrint(const std::filesystem::path& socket, const std::string& request) {
  const ControlReply reply = AskDaemon(socket, request);
  switch (reply.outcome) {
    case ControlOutcome::kDone:
      std::fputs(PrintableLines(reply.text).c_str(), stdout);
      return;
    case ControlOutcome::kFailed:
      throw std::runtime_error(PrintDone(reply.text));
    case ControlOutcome::kWrong:
      throw SetupError(PrintDone(reply.text));
  }
}

void AddControlCommands(CLI::App& app) {
  const auto socket = std::make_shared<std::filesystem::path>();
  const RequestCommands commands(socket);

  auto as_json = std::make_shared<bool>(false);
  CLI::App* status = app.add_subcommand("status", "Show the status of the running mocapd");
  commands.AddSocket(*status);
  status->add_flag("--json", *as_json, "print one JSON object");
  status->callback(
      [socket, as_json] { AskAndPrint(*socket, *as_json ? "status json" : "status"); });

  CLI::App* record = app.add_subcommand("record", "Record a take while tracking continues");
  record->require_subcommand(1);
  commands.AddNamed(*record, "start", "Start recording a take", "record start");
  commands.Add(*record, "stop", "Stop recording and complete the take", "record stop");

  CLI::App* subject =
      app.add_subcommand("subject", "Measure, save and load the sizes of the subject");
  subject->require_subcommand(1);
  commands.Add(*subject, "new", "Measure the tracked people again", "subject new");
  auto person = std::make_shared<std::optional<int>>();
  commands
      .AddNamed(*subject, "save", "Save the sizes of the subject", "subject save",
                [person] { return *person ? ' ' + std::to_string(**person) : std::string(); })
      ->add_option("--person", *person,
                   "with several people: number of the person, as in mocap status")
      ->check(NumberFrom(1, 1e9));
  commands.AddNamed(*subject, "load", "Track a subject with saved sizes", "subject load");
  commands.Add(*subject, "list", "List the saved subjects", "subject list");

  commands.Add(app, "reload", "Reload the configuration of mocapd", "reload");
}

}  // namespace mocap
