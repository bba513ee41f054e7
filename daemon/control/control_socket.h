// The local socket that controls the running daemon: one packet asks, one answers.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <string>
#include <thread>

#include "daemon/base/file_descriptor.h"
#include "daemon/control/control_request.h"

namespace mocap {

/// The socket's path: as configured, or `control` in systemd's RUNTIME_DIRECTORY, or in
/// XDG_RUNTIME_DIR/mocapd; empty if none is set.
std::filesystem::path ControlSocketOf(const std::filesystem::path& configured);

/// Checks whether a control socket can be created, without doing so. @throws SetupError
void RequireSocketPlace(const std::filesystem::path& socket);

/// Answers requests one at a time in its own thread. Owner and group may write to the socket, and
/// so may control.
class ControlServer {
 public:
  using Handler = std::function<ControlReply(const ControlRequest&)>;

  /// @param handler  called from the server's thread; may be slow.
  /// @throws SetupError  if the socket cannot be created, or another daemon answers there.
  ControlServer(const std::filesystem::path& socket, Handler handler);
  ~ControlServer();

 private:
  void Run();
  void Answer(int client) const;

  const std::filesystem::path path_;
  const Handler handler_;
  FileDescriptor listener_;
  FileDescriptor stop_;  ///< Becomes readable when the thread must end.
  std::thread thread_;
};

/// Who asks waits this long for an answer, such as that a recording has begun: the backgrounds of
/// all cameras are stored before.
constexpr std::chrono::seconds kReplyPatience{60};

/// Asks the daemon. @param socket  empty: that of the system's daemon, or the user's own.
/// @throws std::runtime_error  if no daemon answers; SetupError if access is denied.
ControlReply AskDaemon(const std::filesystem::path& socket, const std::string& request);
/// The same; the reply reports why the daemon cannot answer.
ControlReply ReplyOfDaemon(const std::filesystem::path& socket, const std::string& request);

}  // namespace mocap
