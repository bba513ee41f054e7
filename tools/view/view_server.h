// The web server of mocap view: pages, answers, and a WebSocket that tells what is new.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>

#include "tools/view/live_board.h"

namespace mocap {

/// A request for something that is no file of the page.
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

/// Serves one page on this machine's own address, from the thread that calls Run. Whoever is slow,
/// silent or hostile costs neither memory nor the others: requests and connections are bounded, and
/// what is refused is told on standard error, some lines a minute at most.
class ViewServer {
 public:
  /// Answers requests, in threads of its own, several at a time. Empty body and status 404 for what
  /// is not there.
  using Answer = std::function<ViewReply(const ViewRequest&)>;

  struct Options {
    std::uint16_t port = 0;  ///< 0: any. Not used where systemd has handed in a socket.
    std::map<std::string, PageFile> files;  ///< By path.
    Answer answer;
    bool is_live = false;  ///< Serves the WebSocket /live.
  };

  /// @throws SetupError  when the port cannot be used.
  explicit ViewServer(Options options);
  ~ViewServer();

  std::uint16_t port() const;
  std::size_t live_pages() const;
  /// Calls when something can be read there, from Run. @param descriptor  borrowed.
  void OnReadable(int descriptor, std::function<void()> call);
  void Every(std::chrono::milliseconds period, std::function<void()> call);
  /// Does blocking work in another thread, then calls from Run.
  void Aside(std::function<void()> work, std::function<void()> then);
  /// Tells all pages. From Run.
  void Put(std::size_t slot, LiveMessage message);

  /// Serves until Stop, SIGINT or SIGTERM.
  void Run();
  /// Any thread.
  void Stop();

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace mocap
