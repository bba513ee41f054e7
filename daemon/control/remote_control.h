// The daemon of another computer is asked over a command that reaches it, such as ssh.
#pragma once

#include <chrono>
#include <future>
#include <optional>
#include <string>
#include <vector>

#include "daemon/control/control_request.h"

namespace mocap {

/// What came of asking: what that daemon replied, or why nothing came.
struct RemoteAnswer {
  std::optional<ControlReply> reply;
  std::string problem;  ///< One line, with the node's name; empty when there is a reply.
};

/// Asks the daemon of one node by a command that reads the request and prints the reply, as
/// `mocap ask` does at the other end of `ssh -T -o BatchMode=yes USER@NODE`.
///
/// Who may ask whom is the command's business: keys and known hosts are ssh's. Thread-safe.
class RemoteControl {
 public:
  /// @param node     as it is called in what is told of it.
  /// @param command  the program and its arguments; no shell reads them. @pre not empty.
  RemoteControl(std::string node, std::vector<std::string> command);

  const std::string& node() const { return node_; }

  /// Asks, and waits no longer than `patience`, after which nothing of the command is left.
  /// @pre  the request is at most kLongestRequest bytes.
  RemoteAnswer Ask(const std::string& request, std::chrono::milliseconds patience) const;
  /// The same in a thread of its own: many nodes take no longer than the slowest of them.
  std::future<RemoteAnswer> AskBeside(std::string request,
                                      std::chrono::milliseconds patience) const;

 private:
  const std::string node_;
  const std::vector<std::string> command_;
};

}  // namespace mocap
