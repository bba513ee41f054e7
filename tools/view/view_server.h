// The web server of mocap view: pages, answers, and a WebSocket for updates.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>

#include "tools/view/live_board.h"

namespace mocap {

/// A request for something other than a file of the page.
struct ViewRequest {
  std::string method;  ///< "GET" or "POST".
  std::string path;
  std::map<std::string, std::string> query;
  std::string authorization;
  std::string body;
};

struct ViewReply {
  int status = 200;
  std::string type;
  std::string body;
};

/// A file of the page.
struct PageFile {
  std::string type;
  std::string body;
};

/// Serves one page on the loopback address, from the thread that calls Run. Slow, silent or hostile
/// clients cost neither memory nor other clients' service. Requests and connections are limited.
/// Refusals are reported on standard error, at most some lines a minute.
class ViewServer {
 public:
  /// Answers requests in separate threads, several at a time. Empty body and status 404 for unknown
  /// paths.
  using Answer = std::function<ViewReply(const ViewRequest&)>;

  struct Options {
    std::uint16_t port = 0;                 ///< 0: any. Not used with a socket from systemd.
    std::map<std::string, PageFile> files;  ///< By path.
    Answer answer;
    bool is_live = false;  ///< Whether it serves the WebSocket /live.
  };

  /// @throws SetupError  when the port cannot be used.
  explicit ViewServer(Options options);
  ~ViewServer();

  std::uint16_t port() const;
  std::size_t live_pages() const;
  /// Sets a callback, called from Run when data can be read. @param descriptor  not owned.
  void OnReadable(int descriptor, std::function<void()> call);
  void Every(std::chrono::milliseconds period, std::function<void()> call);
  /// Runs blocking work in another thread, then calls `then` from Run.
  void Aside(std::function<void()> work, std::function<void()> then);
  /// Sends a message to all pages. Call it from Run.
  void Put(std::size_t slot, LiveMessage message);

  /// Serves until Stop, SIGINT or SIGTERM.
  void Run();
  /// Callable from any thread.
  void Stop();

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace mocap
