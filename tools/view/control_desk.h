// Requests from the page to the daemon.
#pragma once

#include <chrono>
#include <filesystem>
#include <string>

#include "tools/view/view_server.h"

namespace mocap {

/// Forwards requests of clients with the token to the daemon's control socket. Thread-safe.
class ControlDesk {
 public:
  /// After each such request, the daemon publishes pictures for some seconds.
  static constexpr std::chrono::milliseconds kLookPeriod{2000};

  /// @param socket  empty: the system's daemon, or the user's own.
  ControlDesk(std::filesystem::path socket, std::string token);

  /// Answers GET and POST /control; status 404 for anything else.
  ViewReply Answer(const ViewRequest& request) const;
  /// Requests pictures. @return  why there are none, with the remedy; empty on success.
  std::string Look() const;

 private:
  const std::filesystem::path socket_;
  const std::string token_;
};

}  // namespace mocap
