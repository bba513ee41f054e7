#include "tools/ask.h"

#include <poll.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "daemon/control/control_request.h"
#include "daemon/control/control_socket.h"

namespace mocap {
namespace {

using Clock = std::chrono::steady_clock;

/// A silent connection is closed after this time.
constexpr std::chrono::milliseconds kAnswerPatience{10'000};

/// Waits until standard input can be read or has ended.
bool WaitForInput(Clock::time_point deadline) {
  for (;;) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now()).count();
    if (left <= 0) return false;
    pollfd wait{STDIN_FILENO, POLLIN, 0};
    const int ready = poll(&wait, 1, static_cast<int>(left));
    if (ready > 0 || (ready < 0 && errno != EINTR)) return true;
  }
}

/// Reads standard input to its end, up to the maximum size of a request.
/// @return  empty if there is more.
std::optional<std::string> ReadRequest() {
  const Clock::time_point deadline = Clock::now() + kAnswerPatience;
  std::string request;
  std::array<char, kLongestRequest + 1> bytes;
  while (request.size() <= kLongestRequest && WaitForInput(deadline)) {
    const ssize_t count = read(STDIN_FILENO, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return request;
    request.append(bytes.data(), static_cast<std::size_t>(count));
  }
  return {};
}

ControlReply AnswerInput(const std::filesystem::path& socket) {
  const std::optional<std::string> request = ReadRequest();
  if (!request) {
    return {ControlOutcome::kWrong, "the request does not end within " +
                                        std::to_string(kLongestRequest) + " bytes and " +
                                        std::to_string(kAnswerPatience.count() / 1000) + " s"};
  }
  if (request->empty()) return {ControlOutcome::kWrong, "expected a request on standard input"};
  return ReplyOfDaemon(socket, *request);
}

}  // namespace

void AddAskCommand(CLI::App& app) {
  auto socket = std::make_shared<std::filesystem::path>();
  CLI::App* command = app.add_subcommand(
      "ask", "Pass one request from standard input to mocapd, for other computers by ssh");
  command->add_option("--socket", *socket,
                      "mocapd control socket (default: the system's, else the user's own)");
  command->footer(
      "The reply begins with a line `done`, `failed` or `wrong`.\nTo permit only this command to a "
      "key, in authorized_keys:\n\n  restrict,command=\"mocap ask\" ssh-ed25519 AAAA… studio");
  command->callback([socket] {
    const std::string reply = EncodeReply(AnswerInput(*socket));
    std::fwrite(reply.data(), 1, reply.size(), stdout);
  });
}

}  // namespace mocap
