// The local socket over which the running daemon is told what to do: one packet asks, one answers.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <thread>

#include "daemon/base/file_descriptor.h"
#include "daemon/control/control_request.h"

namespace mocap {

/// Where the socket lies: as configured, or `control` in systemd's RUNTIME_DIRECTORY, or in
/// XDG_RUNTIME_DIR/mocapd; empty where none of these is.
std::filesystem::path ControlSocketOf(const std::filesystem::path& configured);

/// Looks whether a control socket can be made there, without making one. @throws SetupError
void RequireSocketPlace(const std::filesystem::path& socket);

/// Answers requests in a thread of its own, one after the other. Whoever may write to the socket
/// may control: owner and group.
class ControlServer {
 public:
  using Handler = std::function<ControlReply(const ControlRequest&)>;

  /// @param handler  called from the server's thread; may take its time.
  /// @throws SetupError  when the socket cannot be made, or another daemon answers there.
  ControlServer(const std::filesystem::path& socket, Handler handler);
  ~ControlServer();

 private:
  void Run();
  void Answer(int client) const;

  const std::filesystem::path path_;
  const Handler handler_;
  FileDescriptor listener_;
  FileDescriptor stop_;  ///< Becomes readable when the thread shall end.
  std::thread thread_;
};

/// Asks the daemon. @param socket  empty: the system's daemon, or the user's own.
/// @throws std::runtime_error  when no daemon answers; SetupError when it may not be asked.
ControlReply AskDaemon(const std::filesystem::path& socket, const std::string& request);
/// The same; what keeps the daemon from answering is told in the reply.
ControlReply ReplyOfDaemon(const std::filesystem::path& socket, const std::string& request);

}  // namespace mocap
