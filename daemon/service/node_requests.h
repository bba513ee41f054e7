// What is asked of a studio is asked of its nodes as well.
#pragma once

#include <chrono>
#include <future>
#include <string>
#include <vector>

#include "config/config.h"
#include "daemon/control/remote_control.h"

namespace mocap {

/// Reaches the nodes of a studio, all at the same time. Look: one thread; the rest: any.
class NodeRequests {
 public:
  explicit NodeRequests(const std::vector<StudioNode>& nodes);

  /// What each node answered, in their order.
  struct Answers {
    std::vector<std::string> nodes;  ///< Their names.
    std::vector<RemoteAnswer> answers;

    /// Why the first that did not do it did not: one line with its name; empty: all have.
    std::string Problem() const;
    /// What those that answered said, a line each with the node's name.
    std::string Text() const;
  };
  /// Under way; asking has begun.
  class Asked {
   public:
    Answers Wait();

   private:
    friend class NodeRequests;
    std::vector<std::string> nodes_;
    std::vector<std::future<RemoteAnswer>> futures_;
  };

  /// Asks all nodes. @param patience  with each.
  Asked Ask(const std::string& request, std::chrono::milliseconds patience) const;
  /// Tells the nodes that somebody looks, and does not wait for what they say.
  void Look();

  bool empty() const { return controls_.empty() && unreachable_.empty(); }

 private:
  std::vector<RemoteControl> controls_;
  std::vector<std::string> unreachable_;  ///< Nodes without a command.
  std::vector<std::future<RemoteAnswer>> looks_;
};

}  // namespace mocap
