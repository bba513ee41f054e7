// Forwards requests to a studio's nodes.
#pragma once

#include <chrono>
#include <functional>
#include <future>
#include <string>
#include <vector>

#include "config/config.h"
#include "daemon/control/remote_control.h"

namespace mocap {

/// Sends requests to all nodes of a studio at once. Look: one thread; the rest: any.
class NodeRequests {
 public:
  explicit NodeRequests(const std::vector<StudioNode>& nodes);

  /// The nodes' answers, in the order of the nodes.
  struct Answers {
    std::vector<std::string> nodes;  ///< Their names.
    std::vector<RemoteAnswer> answers;

    /// Why nodes failed: one line that names each; empty: none failed.
    std::string Problem() const;
    /// What the nodes that did it said, one line each, with the node's name.
    std::string Text() const;
  };
  /// A request in progress.
  class Asked {
   public:
    Answers Wait();

   private:
    friend class NodeRequests;
    std::vector<std::string> nodes_;
    std::vector<std::future<RemoteAnswer>> futures_;
  };

  /// Asks all nodes. @param patience  for each.
  Asked Ask(const std::string& request, std::chrono::milliseconds patience) const;
  /// Asks the nodes that did what was asked before, and those that have not answered.
  Asked AskWhoDid(const Answers& before, const std::string& request,
                  std::chrono::milliseconds patience) const;
  /// Tells the nodes that somebody watches, without waiting for their answers.
  void Look();

  bool empty() const { return controls_.empty() && unreachable_.empty(); }

 private:
  std::vector<RemoteControl> controls_;
  std::vector<std::string> unreachable_;  ///< Nodes without a command.
  std::vector<std::future<RemoteAnswer>> looks_;
};

/// Does here what the nodes are asked to do, and logs their answers.
/// @param do_here  returns its lines; may throw.
/// @return  the lines of all, the studio's first.
/// @throws SetupError, std::runtime_error  if anybody failed: the lines of the others, then one
/// that names who failed, and why.
std::string DoEverywhere(NodeRequests::Asked at_nodes, const std::function<std::string()>& do_here);

/// Cancels a take here, while the nodes are asked to do so.
/// @param cancel_here  may throw.
/// @return  one line: that nothing is recorded, or who may have kept a part of the take, and why.
std::string CancelTake(NodeRequests::Asked at_nodes, const std::function<void()>& cancel_here);

}  // namespace mocap
