// What the page may ask of the daemon.
#pragma once

#include <chrono>
#include <filesystem>
#include <string>

#include "tools/view/view_server.h"

namespace mocap {

/// Passes requests on to the daemon's control socket for whoever holds the token. Thread-safe.
class ControlDesk {
 public:
  /// The daemon publishes pictures for some seconds each time it is asked to.
  static constexpr std::chrono::milliseconds kLookPeriod{2000};

  /// @param socket  empty: the system's daemon, or the user's own.
  ControlDesk(std::filesystem::path socket, std::string token);

  /// Answers GET and POST /control; status 404 for anything else.
  ViewReply Answer(const ViewRequest& request) const;
  /// Asks for pictures. @return  why there are none and what helps; empty: there are.
  std::string Look() const;

 private:
  const std::filesystem::path socket_;
  const std::string token_;
};

}  // namespace mocap
