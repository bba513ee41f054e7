// Asks the daemon of another computer through a command that reaches it, such as ssh.
#pragma once

#include <chrono>
#include <future>
#include <optional>
#include <string>
#include <vector>

#include "daemon/control/control_request.h"

namespace mocap {

/// The result of asking: the reply, or why there is none.
struct RemoteAnswer {
  std::optional<ControlReply> reply;
  std::string problem;  ///< One line, with the node's name; empty if there is a reply.
};

/// Asks a node's daemon through a command that reads the request and prints the reply, like `mocap
/// ask` at the other end of `ssh -T -o BatchMode=yes USER@NODE`.
///
/// The command decides who may ask whom: keys and known hosts are ssh's. Thread-safe.
class RemoteControl {
 public:
  /// @param node     its name in messages.
  /// @param command  the program and its arguments, without a shell. @pre not empty.
  RemoteControl(std::string node, std::vector<std::string> command);

  const std::string& node() const { return node_; }

  /// Asks, and waits no longer than `patience`. Then the command is killed.
  /// @pre  the request is at most kLongestRequest bytes.
  RemoteAnswer Ask(const std::string& request, std::chrono::milliseconds patience) const;
  /// The same in its own thread: asking many nodes takes no longer than the slowest.
  std::future<RemoteAnswer> AskBeside(std::string request,
                                      std::chrono::milliseconds patience) const;

 private:
  const std::string node_;
  const std::vector<std::string> command_;
};

}  // namespace mocap
